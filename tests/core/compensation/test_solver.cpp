// SPDX-License-Identifier: MIT
#include "compensation/solver.h"

#include <tbb/global_control.h>

#include <Eigen/Cholesky>
#include <QtTest>
#include <cmath>

#include "base/error.h"
#include "core/inverse/synthetic_transport.h"

using namespace relucent;
using namespace relucent::synthetic;

namespace {

Progress quiet;

using Algorithm = SolverSettings::Algorithm;

/// A problem that owns its parts.
struct Case {
  TransportMatrix transport;
  Stack wanted;
  std::vector<float> weight;
  std::vector<std::uint8_t> free;
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
  Case made{TransportMatrix(camera, projector, builder.build()), Stack(3 * camera.count()),
            std::vector<float>(camera.count()), std::vector<std::uint8_t>(projector.count(), 1)};
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
            std::vector<std::uint8_t>(s.projector.count(), 1)};
  Random random({seed, 3});
  for (float& value : made.wanted) value *= static_cast<float>(1.2 * random.uniform());
  for (std::size_t i = 0; i < made.weight.size(); ++i) made.weight[i] = scene.usable[i] ? 1.0f : 0.0f;
  for (std::size_t j = 0; j < made.free.size(); j += 11) made.free[j] = 0;
  return made;
}

/// T as a dense matrix of 3 rows and columns a pixel.
Eigen::MatrixXd dense(const TransportMatrix& transport) {
  std::size_t columns = 3 * transport.projectors().count();
  Eigen::MatrixXd t(3 * transport.cameras().count(), columns);
  for (std::size_t j = 0; j < columns; ++j) {
    Stack one(columns, 0.0f);
    one[j] = 1.0f;
    Stack column = transport.apply(one);
    for (std::size_t i = 0; i < column.size(); ++i)
      t(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = column[i];
  }
  return t;
}

/// The optimum by another way altogether, in double precision.
double denseObjective(const Case& c) {
  Eigen::MatrixXd t = dense(c.transport);
  Eigen::VectorXd b(t.rows());
  for (Eigen::Index i = 0; i < t.rows(); ++i) {
    double root = std::sqrt(static_cast<double>(c.weight[static_cast<std::size_t>(i) / 3]));
    t.row(i) *= root;
    b[i] = root * static_cast<double>(c.wanted[static_cast<std::size_t>(i)]);
  }
  // Coordinate descent to machine precision: slow, and certain for a strictly convex function on a box.
  Eigen::VectorXd x = Eigen::VectorXd::Zero(t.cols()), residual = -b;
  for (int sweep = 0; sweep < 20000; ++sweep) {
    for (Eigen::Index j = 0; j < t.cols(); ++j) {
      double next = std::clamp(x[j] - t.col(j).dot(residual) / t.col(j).squaredNorm(), 0.0, 1.0);
      residual += (next - x[j]) * t.col(j);
      x[j] = next;
    }
  }
  return 0.5 * residual.squaredNorm();
}

}  // namespace

class TestSolver : public QObject {
  Q_OBJECT

  void algorithms() {
    QTest::addColumn<int>("algorithm");
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 3; ++seed) {
      QTest::addRow("fista, seed %d", seed) << static_cast<int>(Algorithm::fista) << seed;
      QTest::addRow("Barzilai-Borwein, seed %d", seed)
          << static_cast<int>(Algorithm::barzilaiBorwein) << seed;
    }
  }
  SolverSettings exact(int algorithm) {
    SolverSettings settings;
    settings.algorithm = static_cast<Algorithm>(algorithm);
    settings.mostIterations = 5000;
    settings.tolerance = 1e-5;
    return settings;
  }

 private slots:
  void agreesWithCoordinateDescent_data() { algorithms(); }
  void agreesWithCoordinateDescent() {
    QFETCH(int, algorithm);
    QFETCH(int, seed);
    Case c = smallCase(static_cast<std::uint64_t>(seed));
    SolveResult result = solveConstrained(c.problem(), Stack(12, 0.5f), exact(algorithm), quiet);
    double best = denseObjective(c);
    QVERIFY(result.converged);
    // Single precision of T p, and a projected gradient of 1e-5.
    QVERIFY2(std::abs(result.objective - best) < 1e-5 * (1.0 + best),
             qPrintable(QString("%1 instead of %2").arg(result.objective).arg(best)));
  }

  void meetsTheOptimalityConditions_data() { algorithms(); }
  /// KKT: the gradient vanishes where a value is free to move, points outward where it is at a limit.
  void meetsTheOptimalityConditions() {
    QFETCH(int, algorithm);
    QFETCH(int, seed);
    Case c = sceneCase(static_cast<std::uint64_t>(seed));
    SolverSettings settings = exact(algorithm);
    settings.tolerance = 1e-4;
    SolveResult result = solveConstrained(c.problem(), Stack(3 * c.free.size(), 0.0f), settings, quiet);
    QVERIFY(result.converged);
    QVERIFY2(result.projectedGradient < 3 * settings.tolerance,
             qPrintable(QString::number(result.projectedGradient)));
    Stack g = gradient(c.problem(), result.x), scale = diagonalPreconditioner(c.problem());
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

  void bothAlgorithmsAgree() {
    Case c = sceneCase(4);
    SolverSettings settings = exact(0);
    settings.tolerance = 1e-4;
    Stack start(3 * c.free.size(), 0.3f);
    double fista = solveConstrained(c.problem(), start, settings, quiet).objective;
    settings.algorithm = Algorithm::barzilaiBorwein;
    double spectral = solveConstrained(c.problem(), start, settings, quiet).objective;
    QVERIFY2(std::abs(fista - spectral) < 1e-3 * fista,
             qPrintable(QString("%1 %2").arg(fista).arg(spectral)));
  }

  void neverEndsWorseThanItBegan() {
    Case c = sceneCase(5);
    SolverSettings settings = exact(0);
    SolveResult best = solveConstrained(c.problem(), Stack(3 * c.free.size(), 0.0f), settings, quiet);
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
    QVERIFY(solveConstrained(c.problem(), Stack(3 * c.free.size(), 0.0f), settings, quiet).converged);
  }

  void sameBitsForEveryNumberOfThreads() {
    Case c = sceneCase(6);
    SolverSettings settings;
    Stack start(3 * c.free.size(), 0.5f);
    Stack many = solveConstrained(c.problem(), start, settings, quiet).x;
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    QVERIFY(solveConstrained(c.problem(), start, settings, quiet).x == many);
  }

  void saysWhatIsNotFinite() {
    Case c = smallCase(7);
    c.wanted[4] = std::nanf("");
    QVERIFY_EXCEPTION_THROWN(solveConstrained(c.problem(), Stack(12, 0.5f), {}, quiet), Error);
  }

  void stopsWhenAsked() {
    struct Sink : ProgressSink {
      void progressed(double, std::string_view) override {}
    } sink;
    Case c = sceneCase(8);
    Stack start(3 * c.free.size(), 0.5f);
    StopRequest keep;
    keep.ask(StopRequest::Kind::keep);
    Progress kept(sink, keep);
    SolveResult early = solveConstrained(c.problem(), start, {}, kept);
    QCOMPARE(early.iterations, 0);
    QCOMPARE(early.x[3], 0.5f);
    StopRequest cancel;
    cancel.ask(StopRequest::Kind::cancel);
    Progress cancelled(sink, cancel);
    QVERIFY_EXCEPTION_THROWN(solveConstrained(c.problem(), start, {}, cancelled), Cancelled);
  }

  void checksSettings() {
    QVERIFY(problems(SolverSettings{}).empty());
    QCOMPARE(problems(SolverSettings{Algorithm::fista, 0, -1.0}).size(), std::size_t{2});
  }
};

QTEST_APPLESS_MAIN(TestSolver)
#include "test_solver.moc"
