// SPDX-License-Identifier: MIT
#include "relucent/inverse/cluster_inverse.h"

#include <tbb/global_control.h>

#include <Eigen/LU>
#include <QtTest>
#include <cmath>
#include <limits>

#include "core/inverse/synthetic_transport.h"
#include "relucent/base/error.h"
#include "relucent/inverse/cluster_solver.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::inverse;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

Progress quiet;

// Weights are rounded to 1/32767 of a cluster's largest, rows of T~ to 1/32767 of theirs: some tens of such
// errors add up.
constexpr float fixedPoint = 3e-3f;

Scene defocused(double softest, std::uint64_t seed = 1) {
  SceneSettings settings;
  settings.softest = softest;
  settings.seed = seed;
  return makeScene(settings);
}

Clustering clusteredScene(const Scene& scene, int most = 40) {
  ConnectionGraph graph(scene.transport, scene.usable, {}, quiet);
  ClusteringSettings settings;
  settings.patchCut = 0.3;
  settings.cap = SizeCap::always;
  settings.mostUnknowns = most;
  return clustered(graph, settings, quiet);
}

/// A camera that sees groups of three projector pixels through well-conditioned mixings of place and colour,
/// with two camera pixels more than there are unknowns.
Scene smallGroups(Size projector, std::uint64_t seed) {
  Size camera{(static_cast<int>(projector.count()) + 2) / 3 * 5, 1};
  NodeLayout layout{Rasters(projector)};
  BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 2.0f));
  for (std::size_t i = 0; i < camera.count(); ++i) {
    std::size_t first = i / 5 * 3;
    Random random({seed, i});
    for (std::size_t k = 0; k < 3 && first + k < projector.count(); ++k) {
      ColourBlock block;
      block << 0.8f, 0.1f, 0.02f, 0.1f, 0.7f, 0.1f, 0.02f, 0.1f, 0.9f;
      float bright = i % 5 % 3 == k ? 1.5f : 0.1f + 0.3f * random.uniformFloat();
      builder.add(i, first + k, (bright * block).eval());
    }
  }
  return {TransportMatrix(camera, projector, builder.build()), CameraStack(3 * camera.count(), 0.0f),
          CameraMask(camera.count(), 1)};
}

Clustering everythingKept(const Scene& scene) {
  ConnectionGraph graph(scene.transport, scene.usable, {0.0, 0}, quiet);
  ClusteringSettings settings;
  settings.patchCut = 0.0;
  settings.cap = SizeCap::never;
  return clustered(graph, settings, quiet);
}

ClusterInverseSettings withColour(bool full) {
  ClusterInverseSettings settings;
  settings.colour = full ? ClusterColour::full : ClusterColour::shared;
  return settings;
}

Eigen::MatrixXf randomBlock(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random({seed, 9});
  return Eigen::MatrixXf::NullaryExpr(rows, columns, [&](Eigen::Index r, Eigen::Index c) {
    return 0.3f * random.uniformFloat() + (r % columns == c ? 1.0f : 0.0f);
  });
}

void colours() {
  QTest::addColumn<bool>("full");
  QTest::newRow("shared") << false;
  QTest::newRow("full") << true;
}

}  // namespace

class TestClusterInverse : public QObject {
  Q_OBJECT

 private slots:
  /// T+ T is close to the identity where clusters are well conditioned.
  void undoesWellConditionedClusters_data() { colours(); }
  void undoesWellConditionedClusters() {
    QFETCH(bool, full);
    for (Size size : {Size{12, 4}, Size{7, 5}, Size{1, 1}, Size{2, 1}}) {
      Scene scene = smallGroups(size, 4);
      Clustering clustering = everythingKept(scene);
      QCOMPARE(clustering.sizes.size(), (size.count() + 2) / 3);
      for (ClusterSolver solver : {ClusterSolver::ridge, ClusterSolver::truncatedSvd}) {
        ClusterInverseSettings settings = withColour(full);
        settings.solver = solver;
        settings.ridge = 1e-6;
        settings.truncation = 0.0;
        ClusterInverse inverse = computeClusterInverse(clustering, scene.usable, settings, quiet);
        ProjectorStack p(randomStack(3 * size.count(), 5));
        // Unmixing, shared only, is regularised with 0.03^2 of the mixing's energy: up to a percent.
        double allowed = full ? static_cast<double>(fixedPoint) : 0.01;
        QVERIFY(relativeError(inverse.apply(scene.transport.apply(p)), p) < allowed);
      }
    }
  }

  void ridgeTendsToTheTruncatedSvd_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::newRow("tall") << 9 << 5;
    QTest::newRow("wide") << 4 << 7;
    QTest::newRow("square") << 6 << 6;
    QTest::newRow("row") << 1 << 5;
    QTest::newRow("column") << 5 << 1;
    QTest::newRow("single") << 1 << 1;
  }
  void ridgeTendsToTheTruncatedSvd() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    Eigen::MatrixXf block = randomBlock(rows, columns, 3);
    ClusterInverseSettings ridge, svd;
    svd.solver = ClusterSolver::truncatedSvd;
    svd.truncation = 0.0;
    ridge.whiteFlood = svd.whiteFlood = false;
    Eigen::MatrixXf exact = clusterPseudoInverse(block, 0.0, svd);
    double last = std::numeric_limits<double>::infinity();
    for (double lambda : {1e-1, 1e-3, 1e-5}) {
      ridge.ridge = lambda;
      double apart =
          static_cast<double>((clusterPseudoInverse(block, lambda, ridge) - exact).norm() / exact.norm());
      QVERIFY(apart < last);
      last = apart;
    }
    // lambda over the smallest squared singular value of such blocks, which is above 0.02.
    QVERIFY2(last < 5e-4, qPrintable(QString::number(last)));
    // Moore and Penrose.
    QVERIFY((block * exact * block - block).norm() < 1e-4f * block.norm());
    QVERIFY((exact * block * exact - exact).norm() < 1e-4f * exact.norm());
  }

  void ridgeIsTheFormula() {
    for (auto [rows, columns] : {std::pair{9, 5}, {5, 9}}) {
      Eigen::MatrixXf block = randomBlock(rows, columns, 8);
      Eigen::MatrixXd a = block.cast<double>();
      Eigen::MatrixXd gram = a.transpose() * a;
      gram.diagonal().array() += 0.4;
      Eigen::MatrixXd expected = gram.inverse() * a.transpose();
      for (double ridge : {0.25, 1e-3}) {  // single and double floats
        ClusterInverseSettings settings;
        settings.ridge = ridge;
        settings.whiteFlood = false;
        Eigen::MatrixXd got = clusterPseudoInverse(block, 0.4, settings).cast<double>();
        QVERIFY((got - expected).norm() < 1e-5 * expected.norm());
      }
    }
  }

  void floodGivesWhite_data() {
    QTest::addColumn<bool>("full");
    QTest::addColumn<bool>("svd");
    QTest::addColumn<double>("softest");
    QTest::newRow("shared") << false << false << 1.5;
    QTest::newRow("full") << true << false << 1.5;
    QTest::newRow("shared, svd") << false << true << 1.5;
    QTest::newRow("full, svd") << true << true << 1.0;
    QTest::newRow("strong defocus") << false << false << 3.0;
  }
  void floodGivesWhite() {
    QFETCH(bool, full);
    QFETCH(bool, svd);
    QFETCH(double, softest);
    Scene scene = defocused(softest);
    Clustering clustering = clusteredScene(scene);
    ClusterInverseSettings settings = withColour(full);
    if (svd) settings.solver = ClusterSolver::truncatedSvd;
    ClusterInverse inverse = computeClusterInverse(clustering, scene.usable, settings, quiet);
    ProjectorStack white = inverse.apply(scene.transport.floodlight());
    std::size_t seen = 0;
    for (std::size_t i = 0; i < white.size(); ++i) {
      std::uint32_t cluster = clustering.projectorCluster[i / 3];
      bool lit = cluster != noCluster && clustering.sizes[cluster].rows > 0;
      seen += lit;
      if (!lit) QCOMPARE(white[i], 0.0f);
      // Shared: beside rounding, what the regularised unmixing leaves of white, and channels that differ.
      float allowed = full ? 20 * fixedPoint : 0.06f;
      if (lit)
        QVERIFY2(std::abs(white[i] - 1.0f) < allowed, qPrintable(QString("%1: %2").arg(i).arg(white[i])));
    }
    QVERIFY(seen > white.size() / 2);
  }

  void isLinearAndItsMatrix_data() { colours(); }
  void isLinearAndItsMatrix() {
    QFETCH(bool, full);
    Scene scene = defocused(1.2, 3);
    ClusterInverse inverse =
        computeClusterInverse(clusteredScene(scene), scene.usable, withColour(full), quiet);
    CameraStack r = randomStack<CameraStack>(3 * scene.transport.cameras().count(), 1), doubled = r;
    for (float& value : doubled) value *= 2.0f;
    ProjectorStack p = inverse.apply(r), twice = inverse.apply(doubled);
    for (std::size_t i = 0; i < p.size(); ++i) QCOMPARE(twice[i], 2.0f * p[i]);
    QVERIFY(relativeError(inverse.matrix().multiply(r), p) < 1e-4);  // rounded to 16 bits once more
    QVERIFY(inverse.bytes() > 0);
  }

  /// T+ stays within clusters: light asked for in one cluster changes no other.
  void clustersAreIndependent() {
    Scene scene = defocused(1.5, 5);
    Clustering clustering = clusteredScene(scene, 12);
    ClusterInverse inverse = computeClusterInverse(clustering, scene.usable, {}, quiet);
    CameraStack r(3 * scene.transport.cameras().count(), 0.0f);
    std::size_t row = 0;
    while (clustering.cameraCluster[row] == noCluster) ++row;
    r[3 * row] = r[3 * row + 1] = r[3 * row + 2] = 1.0f;
    ProjectorStack p = inverse.apply(r);
    double lit = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      lit += std::abs(p[i]);
      if (clustering.projectorCluster[i / 3] != clustering.cameraCluster[row]) QCOMPARE(p[i], 0.0f);
    }
    QVERIFY(lit > 0.0);
  }

  /// Law of light: a scene twice as bright needs half the drive.
  void brighterScenesNeedLess_data() { colours(); }
  void brighterScenesNeedLess() {
    QFETCH(bool, full);
    Scene scene = defocused(1.2, 6), bright = scene;
    const TransportMatrix& t = scene.transport;
    bright.transport = TransportMatrix(t.cameras(), t.projectors(),
                                       t.ownLeaves().withRowsScaled(Stack(3 * t.cameras().count(), 2.0f)));
    CameraStack r = randomStack<CameraStack>(3 * t.cameras().count(), 2);
    ProjectorStack p =
        computeClusterInverse(clusteredScene(scene), scene.usable, withColour(full), quiet).apply(r);
    ProjectorStack q =
        computeClusterInverse(clusteredScene(bright), scene.usable, withColour(full), quiet).apply(r);
    for (float& value : q) value *= 2.0f;
    QVERIFY(relativeError(q, p) < 1e-5);
  }

  /// The inverse is worth having: through T, pictures come out nearer than from the plain average of what
  /// sees a pixel, which is what an overwhelming ridge leaves.
  void sharpensBeyondTheAverage_data() { colours(); }
  void sharpensBeyondTheAverage() {
    QFETCH(bool, full);
    Scene scene = defocused(0.9, 2);
    Clustering clustering = clusteredScene(scene, 128);
    ProjectorStack p(randomStack(3 * scene.transport.projectors().count(), 7));
    for (float& value : p) value = 0.3f + 0.4f * value;
    CameraStack wanted = scene.transport.apply(p);
    auto errorWith = [&](double ridge) {
      ClusterInverseSettings settings = withColour(full);
      settings.ridge = ridge;
      return relativeError(
          scene.transport.apply(
              computeClusterInverse(clustering, scene.usable, settings, quiet).apply(wanted)),
          wanted);
    };
    QVERIFY(errorWith(0.25) < errorWith(100.0));
  }

  void sameForEveryNumberOfThreads_data() { colours(); }
  void sameForEveryNumberOfThreads() {
    QFETCH(bool, full);
    Scene scene = defocused(1.5, 8);
    Clustering clustering = clusteredScene(scene);
    auto run = [&](std::size_t threads) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return computeClusterInverse(clustering, scene.usable, withColour(full), quiet);
    };
    ClusterInverse one = run(1), two = run(2);
    QVERIFY(one == two);
    CameraStack r = randomStack<CameraStack>(3 * scene.transport.cameras().count(), 3);
    QVERIFY(one.apply(r) == two.apply(r));
  }

  void extremesHaveDefinedResults_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("full");
    for (const char* kind : {"black", "unusable", "single pixels", "not a number", "saturated"})
      for (bool full : {false, true})
        QTest::newRow(qPrintable(QString("%1 %2").arg(kind).arg(full))) << kind << full;
  }
  void extremesHaveDefinedResults() {
    QFETCH(QString, kind);
    QFETCH(bool, full);
    Size size = kind == "single pixels" ? Size{1, 1} : Size{4, 3};
    NodeLayout layout{Rasters(size)};
    float bad = std::numeric_limits<float>::quiet_NaN();
    BlockSparseWriter writer(layout.count(),
                             std::vector<float>(size.count(), kind == "not a number" ? bad : 1.0f), 0);
    for (std::size_t i = 0; i < size.count(); ++i) {
      BlockSparseWriter::Code code{};
      code.fill(32767);
      if (kind != "black")
        for (std::size_t j = 0; j < size.count(); ++j) writer.add(j, code);
      writer.endRow();
    }
    Scene scene{TransportMatrix(size, size, writer.build()), {}, {}};
    scene.usable.assign(size.count(), kind == "unusable" ? 0 : 1);
    Clustering clustering = clustered(ConnectionGraph(scene.transport, scene.usable, {}, quiet), {}, quiet);
    for (ClusterSolver solver : {ClusterSolver::ridge, ClusterSolver::truncatedSvd}) {
      ClusterInverseSettings settings = withColour(full);
      settings.solver = solver;
      ClusterInverse inverse = computeClusterInverse(clustering, scene.usable, settings, quiet);
      ProjectorStack p = inverse.apply(CameraStack(3 * size.count(), 0.5f));
      bool lit = kind == "single pixels" || kind == "saturated";
      // Rows all alike are singular: the least-squares answer is finite, and positive.
      for (float value : p) QVERIFY(std::isfinite(value) && (lit ? value > 0.0f : value == 0.0f));
      QCOMPARE(inverse.matrix().rows(), size.count());
    }
  }

  void camerasThatMustNotBeReliedOnAreLeftOut() {
    Scene scene = smallGroups({6, 1}, 2);
    Clustering clustering = everythingKept(scene);
    scene.usable[0] = scene.usable[7] = 0;
    ClusterInverse inverse = computeClusterInverse(clustering, scene.usable, {}, quiet);
    CameraStack r(3 * scene.usable.size(), 0.0f);
    r[0] = r[3 * 7 + 1] = 1000.0f;
    for (float value : inverse.apply(r)) QCOMPARE(value, 0.0f);
  }

  void tooLargeClustersAreRefused() {
    Size size{128, 80};
    NodeLayout layout{Rasters(size)};
    BlockSparseBuilder builder(layout.count(), std::vector<float>(size.count(), 1.0f));
    for (std::size_t i = 0; i < size.count(); ++i)  // a chain through all pixels
      for (std::size_t j = i; j < std::min(i + 2, size.count()); ++j)
        builder.add(i, j, ColourBlock::Identity());
    Scene scene{TransportMatrix(size, size, builder.build()), {}, {}};
    scene.usable.assign(size.count(), 1);
    Clustering chain = everythingKept(scene);
    QVERIFY(chain.statistics.percolated);
    QVERIFY_EXCEPTION_THROWN(computeClusterInverse(chain, scene.usable, {}, quiet), Error);
    ConnectionGraph graph(scene.transport, scene.usable, {}, quiet);
    Clustering capped = clustered(graph, {}, quiet);
    QVERIFY(capped.statistics.largest <= 256);
    QCOMPARE(computeClusterInverse(capped, scene.usable, {}, quiet).projectors().count(), size.count());
  }

  void wrongSettingsAreRefused() {
    Scene scene = smallGroups({3, 1}, 1);
    Clustering clustering = everythingKept(scene);
    for (double wrong : {-1.0, 101.0, std::numeric_limits<double>::quiet_NaN()}) {
      ClusterInverseSettings settings;
      settings.ridge = wrong;
      QVERIFY_EXCEPTION_THROWN(computeClusterInverse(clustering, scene.usable, settings, quiet), Error);
      settings = {};
      settings.truncation = wrong;
      QVERIFY_EXCEPTION_THROWN(computeClusterInverse(clustering, scene.usable, settings, quiet), Error);
    }
    QVERIFY_EXCEPTION_THROWN(computeClusterInverse(clustering, {1}, {}, quiet), std::logic_error);
    ClusterInverse inverse = computeClusterInverse(clustering, scene.usable, {}, quiet);
    QVERIFY_EXCEPTION_THROWN(inverse.apply(CameraStack(3)), std::logic_error);
  }
};

QTEST_GUILESS_MAIN(TestClusterInverse)
#include "test_cluster_inverse.moc"
