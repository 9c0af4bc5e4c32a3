// SPDX-License-Identifier: MIT
#include "relucent/compensation/solver.h"

#include <tbb/global_control.h>

#include <QtTest>
#include <cmath>

#include "core/compensation/scipy_reference.h"
#include "core/inverse/synthetic_transport.h"
#include "relucent/base/error.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::transport;
using namespace relucent::reference;
using namespace relucent::synthetic;

namespace {

Progress quiet;

using Algorithm = SolverSettings::Algorithm;

constexpr Algorithm allAlgorithms[] = {Algorithm::fista, Algorithm::barzilaiBorwein,
                                       Algorithm::steepestDescent, Algorithm::dense};

/// A problem that owns its parts.
struct Case {
  TransportMatrix transport;
  CameraStack wanted;
  std::vector<float> weight;
  ProjectorMask free;
  ConstrainedProblem problem() const { return {transport, wanted, weight, free}; }
};

/// A small dense T with wanted light partly beyond what it can do.
Case smallCase(std::uint64_t seed) {
  Size projector{2, 2}, camera{3, 2};
  NodeLayout layout{Rasters(projector)};
  BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 1.0f));
  Random random({seed});
  for (std::size_t row = 0; row < camera.count(); ++row) {
    for (std::size_t node = 0; node < projector.count(); ++node) {
      ColourBlock block;
      for (int i = 0; i < 9; ++i)
        block.data()[i] = static_cast<float>(random.uniform() * (i % 4 == 0 ? 1.0 : 0.2));
      builder.add(row, node, block);
    }
  }
  Case made{TransportMatrix(camera, projector, builder.build()), CameraStack(3 * camera.count()),
            std::vector<float>(camera.count()), ProjectorMask(projector.count(), 1)};
  for (float& value : made.wanted) value = static_cast<float>(3.0 * random.uniform() - 0.3);
  for (float& value : made.weight) value = static_cast<float>(0.2 + random.uniform());
  return made;
}

Case sceneCase(std::uint64_t seed) {
  SceneSettings s;
  s.seed = seed;
  s.projector = {32, 24};
  s.camera = {20, 15};
  Scene scene = makeScene(s);
  Case made{scene.transport, scene.transport.floodlight(), std::vector<float>(scene.usable.size()),
            ProjectorMask(s.projector.count(), 1)};
  Random random({seed, 3});
  for (float& value : made.wanted) value *= static_cast<float>(1.2 * random.uniform());
  for (std::size_t i = 0; i < made.weight.size(); ++i) made.weight[i] = scene.usable[i] ? 1.0f : 0.0f;
  for (std::size_t j = 0; j < made.free.size(); j += 11) made.free[j] = 0;
  return made;
}

/// The light transport of a case that SciPy solved, to the last bit: codes on rows whose largest value is
/// one.
Case scipyCase(const BoxCase& solved) {
  auto sizeOf = [&](const char* key) {
    std::vector<double> size = numbers(solved.json[key]);
    return Size{static_cast<int>(size[0]), static_cast<int>(size[1])};
  };
  Size camera = sizeOf("camera"), projector = sizeOf("projector");
  NodeLayout layout{Rasters(projector)};
  BlockSparseWriter writer(layout.count(), std::vector<float>(camera.count(), 1.0f), 0);
  for (std::size_t row = 0; row < camera.count(); ++row) {
    for (std::size_t node = 0; node < projector.count(); ++node) {
      BlockSparseWriter::Code code;
      for (std::size_t k = 0; k < 9; ++k)
        code[k] = static_cast<std::int16_t>(solved.codes(static_cast<Eigen::Index>(3 * row + k / 3),
                                                         static_cast<Eigen::Index>(3 * node + k % 3)));
      writer.add(node, code);
    }
    writer.endRow();
  }
  Case made{TransportMatrix(camera, projector, writer.build()), {}, {}, ProjectorMask(projector.count(), 1)};
  for (double value : solved.b) made.wanted.push_back(static_cast<float>(value));
  for (double value : numbers(solved.json["weight"])) made.weight.push_back(static_cast<float>(value));
  return made;
}

}  // namespace

class TestSolver : public QObject {
  Q_OBJECT

  /// The iterative algorithms; the dense one has no use for scenes.
  void algorithms() {
    QTest::addColumn<int>("algorithm");
    QTest::addColumn<int>("seed");
    for (Algorithm algorithm : {Algorithm::fista, Algorithm::barzilaiBorwein, Algorithm::steepestDescent})
      for (int seed = 1; seed <= 3; ++seed)
        QTest::addRow("%s, seed %d", std::string(nameOf(algorithm)).c_str(), seed)
            << static_cast<int>(algorithm) << seed;
  }
  SolverSettings exact(int algorithm) {
    SolverSettings settings;
    settings.algorithm = static_cast<Algorithm>(algorithm);
    settings.mostIterations = 5000;
    settings.tolerance = 1e-5;
    return settings;
  }

 private slots:
  void agreesWithScipy_data() {
    QTest::addColumn<int>("algorithm");
    QTest::addColumn<int>("index");
    std::vector<BoxCase> cases = boxCases("transport");
    QVERIFY(!cases.empty());
    for (Algorithm algorithm : allAlgorithms)
      for (std::size_t i = 0; i < cases.size(); ++i)
        QTest::addRow("%s, %s", nameOf(algorithm).data(), qPrintable(cases[i].name))
            << static_cast<int>(algorithm) << static_cast<int>(i);
  }
  void agreesWithScipy() {
    QFETCH(int, algorithm);
    QFETCH(int, index);
    BoxCase solved = boxCases("transport")[static_cast<std::size_t>(index)];
    Case c = scipyCase(solved);
    ProjectorStack start(static_cast<std::size_t>(solved.x.size()), 0.5f);
    SolveResult result = solveConstrained(c.problem(), start, exact(algorithm), quiet);
    QVERIFY2(result.converged, qPrintable(QString::number(result.projectedGradient)));
    // Single precision of T p, and a projected gradient of 1e-5.
    double best = solved.objective;
    QVERIFY2(std::abs(result.objective - best) < 1e-5 * (1.0 + best),
             qPrintable(QString("%1 instead of %2").arg(result.objective).arg(best)));
    if (!solved.unique) return;
    for (std::size_t j = 0; j < result.x.size(); ++j) {
      double expected = solved.x[static_cast<Eigen::Index>(j)];
      // These matrices are conditioned well enough for a projected gradient of 1e-5 to be within this.
      QVERIFY2(std::abs(static_cast<double>(result.x[j]) - expected) < 2e-3,
               qPrintable(QString("%1 instead of %2").arg(static_cast<double>(result.x[j])).arg(expected)));
    }
  }

  void nothingToSolveHasAResult_data() {
    QTest::addColumn<int>("algorithm");
    for (Algorithm algorithm : allAlgorithms)
      QTest::newRow(nameOf(algorithm).data()) << static_cast<int>(algorithm);
  }
  void nothingToSolveHasAResult() {
    QFETCH(int, algorithm);
    SolverSettings settings = exact(algorithm);
    ProjectorStack start(12, 0.5f);

    Case nothingFree = smallCase(1);
    nothingFree.free.assign(4, 0);
    SolveResult dark = solveConstrained(nothingFree.problem(), start, settings, quiet);
    QVERIFY(dark.x == Stack(12, 0.0f));
    QCOMPARE(dark.projectedGradient, 0.0);

    Case nothingWeighted = smallCase(1);
    nothingWeighted.weight.assign(6, 0.0f);
    SolveResult free = solveConstrained(nothingWeighted.problem(), start, settings, quiet);
    QCOMPARE(free.objective, 0.0);

    Case noLight = smallCase(1);
    BlockSparseBuilder empty(noLight.transport.ownLeaves().columns(), std::vector<float>(6, 0.0f));
    noLight.transport =
        TransportMatrix(noLight.transport.cameras(), noLight.transport.projectors(), empty.build());
    SolveResult unseen = solveConstrained(noLight.problem(), start, settings, quiet);
    for (float value : unseen.x) QVERIFY(value >= 0.0f && value <= 1.0f);

    // The way out of the box and into it again: a start beyond the limits, some of it not free.
    Case partly = smallCase(2);
    partly.free[1] = 0;
    SolveResult clamped = solveConstrained(partly.problem(), ProjectorStack(12, 7.0f), settings, quiet);
    QVERIFY(clamped.converged);
    for (std::size_t j = 3; j < 6; ++j) QCOMPARE(clamped.x[j], 0.0f);
  }

  void denseRefusesWhatIsTooLarge() {
    Case c = sceneCase(1);
    QVERIFY_EXCEPTION_THROWN(solveConstrained(c.problem(), ProjectorStack(3 * c.free.size(), 0.0f),
                                              defaultsOf(Algorithm::dense), quiet),
                             Error);
  }

  void denseTakesPartOfAScene() {
    Case c = sceneCase(2);
    for (std::size_t j = 0; j < c.free.size(); ++j) c.free[j] = j % 32 < 8 && j / 32 < 8;
    ProjectorStack start(3 * c.free.size(), 0.0f);
    SolveResult dense = solveConstrained(c.problem(), start, defaultsOf(Algorithm::dense), quiet);
    SolveResult fista = solveConstrained(c.problem(), start, exact(0), quiet);
    QVERIFY(dense.converged);
    // f counts the pixels too that these few cannot light: the tolerance is relative to a large number.
    QVERIFY2(dense.objective <= fista.objective * (1.0 + 1e-6),
             qPrintable(QString("%1 %2").arg(dense.objective, 0, 'g', 9).arg(fista.objective, 0, 'g', 9)));
    QVERIFY(std::abs(dense.objective - fista.objective) < 1e-4 * fista.objective);
  }

  void everyAlgorithmHasAName() {
    for (Algorithm algorithm : allAlgorithms) {
      QVERIFY(valueNamed<SolverSettings::Algorithm>(nameOf(algorithm)) == algorithm);
      QVERIFY(defaultsOf(algorithm).algorithm == algorithm);
      QVERIFY(problems(defaultsOf(algorithm)).empty());
    }
    QVERIFY(!valueNamed<SolverSettings::Algorithm>("magic"));
  }

  /// The paper's five steps: each goes down, and they get the larger part of what there is to gain.
  void fiveStepsOfDescentGetMostOfIt() {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Case c = sceneCase(seed);
      ProjectorStack start(3 * c.free.size(), 0.0f);
      SolverSettings settings = defaultsOf(Algorithm::steepestDescent);
      QCOMPARE(settings.mostIterations, 5);
      std::vector<double> f;
      for (settings.mostIterations = 1; settings.mostIterations <= 5; ++settings.mostIterations)
        f.push_back(solveConstrained(c.problem(), start, settings, quiet).objective);
      for (std::size_t i = 1; i < f.size(); ++i) QVERIFY(f[i] < f[i - 1]);
      CameraStack lit = c.transport.apply(start);
      double black = 0.0;
      for (std::size_t i = 0; i < lit.size(); ++i) black += 0.5 * c.weight[i / 3] * std::pow(c.wanted[i], 2);
      double best = solveConstrained(c.problem(), start, exact(0), quiet).objective;
      QVERIFY2(black - f.back() > 0.8 * (black - best),
               qPrintable(QString("%1 of %2").arg(black - f.back()).arg(black - best)));
    }
  }

  void meetsTheOptimalityConditions_data() { algorithms(); }
  /// KKT: the gradient vanishes where a value is free to move, points outward where it is at a limit.
  void meetsTheOptimalityConditions() {
    QFETCH(int, algorithm);
    QFETCH(int, seed);
    Case c = sceneCase(static_cast<std::uint64_t>(seed));
    SolverSettings settings = exact(algorithm);
    settings.tolerance = 1e-4;
    SolveResult result =
        solveConstrained(c.problem(), ProjectorStack(3 * c.free.size(), 0.0f), settings, quiet);
    QVERIFY(result.converged);
    QVERIFY2(result.projectedGradient < 3 * settings.tolerance,
             qPrintable(QString::number(result.projectedGradient)));
    ProjectorStack g = gradient(c.problem(), result.x), scale = diagonalPreconditioner(c.problem());
    for (std::size_t j = 0; j < g.size(); ++j) {
      double step = static_cast<double>(g[j]) * static_cast<double>(scale[j]);
      QVERIFY(result.x[j] >= 0.0f && result.x[j] <= 1.0f);
      if (!c.free[j / 3]) QCOMPARE(result.x[j], 0.0f);
      // The norm is a mean over some thousand values: a single one may exceed it by the root of their number.
      double limit = 100 * settings.tolerance;
      if (result.x[j] > 0.02f) QVERIFY2(step < limit, qPrintable(QString::number(step)));
      if (result.x[j] < 0.98f) QVERIFY2(step > -limit, qPrintable(QString::number(step)));
    }
  }

  void iterativeAlgorithmsAgree() {
    Case c = sceneCase(4);
    SolverSettings settings = exact(0);
    settings.tolerance = 1e-4;
    ProjectorStack start(3 * c.free.size(), 0.3f);
    double fista = solveConstrained(c.problem(), start, settings, quiet).objective;
    settings.algorithm = Algorithm::barzilaiBorwein;
    double spectral = solveConstrained(c.problem(), start, settings, quiet).objective;
    settings.algorithm = Algorithm::steepestDescent;
    double descent = solveConstrained(c.problem(), start, settings, quiet).objective;
    QString values = QString("%1 %2 %3").arg(fista).arg(spectral).arg(descent);
    QVERIFY2(std::abs(fista - spectral) < 1e-3 * fista, qPrintable(values));
    QVERIFY2(std::abs(fista - descent) < 1e-3 * fista, qPrintable(values));
  }

  void neverEndsWorseThanItBegan() {
    Case c = sceneCase(5);
    SolverSettings settings = exact(0);
    SolveResult best =
        solveConstrained(c.problem(), ProjectorStack(3 * c.free.size(), 0.0f), settings, quiet);
    settings.mostIterations = 1;
    SolveResult again = solveConstrained(c.problem(), best.x, settings, quiet);
    QVERIFY(again.objective <= best.objective * (1 + 1e-6));
  }

  void noisyTransportConverges_data() { algorithms(); }
  /// Measured T has negative entries, for which the bound of one on a step no longer holds.
  void noisyTransportConverges() {
    QFETCH(int, algorithm);
    QFETCH(int, seed);
    Case c = sceneCase(static_cast<std::uint64_t>(seed));
    c.transport = measured(c.transport, 0.3, 0.02, static_cast<std::uint64_t>(seed));
    SolverSettings settings = exact(algorithm);
    settings.tolerance = 3e-4;
    QVERIFY(
        solveConstrained(c.problem(), ProjectorStack(3 * c.free.size(), 0.0f), settings, quiet).converged);
  }

  void sameBitsForEveryNumberOfThreads() {
    Case c = sceneCase(6);
    SolverSettings settings;
    ProjectorStack start(3 * c.free.size(), 0.5f);
    Stack many = solveConstrained(c.problem(), start, settings, quiet).x;
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    QVERIFY(solveConstrained(c.problem(), start, settings, quiet).x == many);
  }

  void saysWhatIsNotFinite_data() { nothingToSolveHasAResult_data(); }
  void saysWhatIsNotFinite() {
    QFETCH(int, algorithm);
    SolverSettings settings = exact(algorithm);
    Case c = smallCase(7);
    c.wanted[4] = std::nanf("");
    QVERIFY_EXCEPTION_THROWN(solveConstrained(c.problem(), ProjectorStack(12, 0.5f), settings, quiet), Error);
    Case weights = smallCase(7);
    weights.weight[2] = std::nanf("");
    QVERIFY_EXCEPTION_THROWN(solveConstrained(weights.problem(), ProjectorStack(12, 0.5f), settings, quiet),
                             Error);
    Case fine = smallCase(7);
    QVERIFY_EXCEPTION_THROWN(
        solveConstrained(fine.problem(), ProjectorStack(12, std::nanf("")), settings, quiet), Error);
  }

  void stopsWhenAsked_data() { nothingToSolveHasAResult_data(); }
  void stopsWhenAsked() {
    QFETCH(int, algorithm);
    Case c = smallCase(8);
    ProjectorStack start(12, 0.5f);
    SolverSettings settings = defaultsOf(static_cast<Algorithm>(algorithm));
    Stopped kept(StopRequest::Kind::keep);
    SolveResult early = solveConstrained(c.problem(), start, settings, kept);
    QCOMPARE(early.iterations, 0);
    QCOMPARE(early.x[3], 0.5f);
    Stopped cancelled;
    QVERIFY_EXCEPTION_THROWN(solveConstrained(c.problem(), start, settings, cancelled), Cancelled);
  }

  void checksSettings() {
    QVERIFY(problems(SolverSettings{}).empty());
    QCOMPARE(problems(SolverSettings{Algorithm::fista, 0, -1.0}).size(), std::size_t{2});
  }
};

QTEST_APPLESS_MAIN(TestSolver)
#include "test_solver.moc"
