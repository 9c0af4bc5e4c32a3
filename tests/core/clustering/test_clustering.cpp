// SPDX-License-Identifier: MIT
#include "relucent/clustering/clustering.h"

#include <tbb/global_control.h>

#include <QtTest>
#include <cmath>
#include <limits>

#include "core/clustering/clustering_cases.h"
#include "core/transport/expanded.h"
#include "core/transport/random_blocks.h"
#include "relucent/base/error.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::transport;

class TestClustering : public QObject {
  Q_OBJECT

 private slots:
  /// |T_i - T~_i| / |T_i| on T expanded to all its pixels, far field included.
  void errorMapIsThePapersByBruteForce_data() {
    QTest::addColumn<double>("density");
    QTest::addColumn<bool>("capped");
    QTest::addColumn<int>("level");
    QTest::newRow("nested leaves of every level") << 0.3 << false << 30;
    QTest::newRow("sparse") << 0.03 << false << 30;
    QTest::newRow("far field on wide leaves") << 0.3 << false << 1;
    QTest::newRow("capped") << 0.2 << true << 2;
  }
  void errorMapIsThePapersByBruteForce() {
    QFETCH(double, density);
    QFETCH(bool, capped);
    QFETCH(int, level);
    Rasters projectors = std::vector<Size>{{11, 6}, {3, 2}};
    NodeLayout layout(projectors);
    TransportMatrix transport(Size{7, 4}, projectors,
                              randomBlocks(28, layout.count(), density, 31, -0.1f).sparse);
    ClusteringSettings settings = asPrinted(2.0, 0.4);
    if (capped) settings.cap = SizeCap::always;
    settings.mostUnknowns = 7;
    ConnectionGraph graph(transport, all(transport), {0.05, level}, quiet);
    Clustering clustering = clustered(graph, settings, quiet);
    verifyPartition(clustering);
    Eigen::MatrixXd whole = expanded(transport), apart = whole - expanded(clustering.transport);
    for (Eigen::Index i = 0; i < 28; ++i) {
      double norm = whole.middleRows<3>(3 * i).norm();
      double expected = norm > 0.0 ? apart.middleRows<3>(3 * i).norm() / norm : 0.0;
      double error = static_cast<double>(clustering.error[static_cast<std::size_t>(i)]);
      QVERIFY2(std::abs(error - expected) < rounding * (1.0 + expected),
               qPrintable(QString("%1: %2, %3").arg(i).arg(error).arg(expected)));
    }
  }

  void nothingCutIsNoError() {
    TransportMatrix transport = pixelTransport(Size{6, 5}, Size{9, 4}, 0.2, 3, false);
    Clustering clustering = clustered(everything(transport), asPrinted(5.0, 0.0), quiet);
    QVERIFY((expanded(transport) - expanded(clustering.transport)).norm() <
            rounding * expanded(transport).norm());
    QCOMPARE(clustering.statistics.kept, clustering.statistics.connections);
    QVERIFY(std::abs(clustering.statistics.keptLight - 1.0) < 1e-5);
  }

  void strongerThresholdsKeepLess() {
    synthetic::Scene made = scene(1.5);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = asPrinted(6.0, 0.3);
    std::size_t before = graph.connections();
    for (double share : {0.0, 0.05, 0.3}) {
      settings.leastShare = share;
      Clustering clustering = clustered(graph, settings, quiet);
      verifyPartition(clustering);
      QVERIFY(clustering.statistics.kept <= before);
      before = clustering.statistics.kept;
    }
    settings.leastLuminance = 1e9f;  // the brightest of every row stays
    Clustering brightest = clustered(graph, settings, quiet);
    QCOMPARE(brightest.statistics.kept, brightest.statistics.litCameraPixels);
  }

  void sameForEveryNumberOfThreads() {
    synthetic::Scene made = scene(2.0, 7);
    auto run = [&](std::size_t threads, SizeCap cap) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      ConnectionGraph graph(made.transport, made.usable, {}, quiet);
      ClusteringSettings settings = asPrinted(6.0, 0.4);
      settings.cap = cap;
      settings.mostUnknowns = 40;
      return clustered(graph, settings, quiet);
    };
    for (SizeCap cap : {SizeCap::never, SizeCap::always}) {
      Clustering one = run(1, cap), two = run(2, cap);
      QVERIFY(one.cameraCluster == two.cameraCluster && one.projectorCluster == two.projectorCluster);
      QVERIFY(one.transport == two.transport && one.error == two.error);
      QCOMPARE(one.statistics.keptLight, two.statistics.keptLight);
    }
  }

  void extremesHaveDefinedResults_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"black", "unusable", "single pixels", "negative", "not a number", "saturated"})
      QTest::newRow(kind) << kind;
  }
  void extremesHaveDefinedResults() {
    QFETCH(QString, kind);
    Size size = kind == "single pixels" ? Size{1, 1} : Size{4, 3};
    NodeLayout layout{Rasters(size)};
    float full = kind == "not a number" ? std::numeric_limits<float>::quiet_NaN() : 1.0f;
    BlockSparseWriter writer(layout.count(), std::vector<float>(size.count(), full), 0);
    for (std::size_t i = 0; i < size.count(); ++i) {
      BlockSparseWriter::Code code{};
      code.fill(kind == "negative" ? -1000 : 32767);
      if (kind != "black")
        for (std::size_t j = 0; j < size.count(); ++j) writer.add(j, code);
      writer.endRow();
    }
    TransportMatrix transport(size, size, writer.build());
    CameraMask usable(size.count(), kind == "unusable" ? 0 : 1);
    Clustering clustering = clustered(ConnectionGraph(transport, usable, {}, quiet), {}, quiet);
    verifyPartition(clustering);
    bool lit = kind == "single pixels" || kind == "saturated";
    QCOMPARE(clustering.sizes.size(), std::size_t{lit ? 1u : 0u});
    for (float error : clustering.error) QCOMPARE(error, kind == "black" || lit ? 0.0f : 1.0f);
  }

  /// Light of nothing but wide leaves makes no connections; it is all far light.
  void wideLeavesCarryNone() {
    NodeLayout layout{Rasters(Size{64, 64})};
    BlockSparseBuilder builder(layout.count(), {1.0f, 1.0f});
    for (std::size_t row : {0, 1}) builder.add(row, layout.index({0, 4, 1, 1}), ColourBlock::Identity());
    TransportMatrix transport(Size{2, 1}, Size{64, 64}, builder.build());
    Clustering clustering = clustered(ConnectionGraph(transport, {1, 1}, {}, quiet), {}, quiet);
    QCOMPARE(clustering.sizes.size(), std::size_t{0});
    QCOMPARE(clustering.statistics.farLight, 1.0);
    QCOMPARE(clustering.error[0], 1.0f);
    ConnectionGraphSettings wide;
    wide.coarsestLevel = 4;
    QCOMPARE(ConnectionGraph(transport, {1, 1}, wide, quiet).connections(), std::size_t{512});
  }

  void wrongSettingsAreRefused() {
    TransportMatrix transport = pixelTransport(Size{2, 1}, Size{2, 1}, 1.0, 1, false);
    ConnectionGraph graph = everything(transport);
    double nan = std::numeric_limits<double>::quiet_NaN();
    for (double cut : {1.0, -0.1, nan})
      QVERIFY_EXCEPTION_THROWN(clustered(graph, asPrinted(5.0, cut), quiet), Error);
    for (double radius : {-1.0, nan})
      QVERIFY_EXCEPTION_THROWN(clustered(graph, asPrinted(radius, 0.5), quiet), Error);
    ClusteringSettings settings;
    settings.mostUnknowns = 0;
    QVERIFY_EXCEPTION_THROWN(clustered(graph, settings, quiet), Error);
    QVERIFY_EXCEPTION_THROWN(ConnectionGraph(transport, {1, 1}, {2.0, 3}, quiet), Error);
    QVERIFY_EXCEPTION_THROWN(ConnectionGraph(transport, {1}, {}, quiet), std::logic_error);
  }

  void canBeCancelled() {
    TransportMatrix transport = pixelTransport(Size{2, 1}, Size{2, 1}, 1.0, 1, false);
    Stopped stopped;
    QVERIFY_EXCEPTION_THROWN(ConnectionGraph(transport, {1, 1}, {}, stopped), Cancelled);
    ConnectionGraph graph = everything(transport);
    QVERIFY_EXCEPTION_THROWN(clustered(graph, {}, stopped), Cancelled);
  }
};

QTEST_GUILESS_MAIN(TestClustering)
#include "test_clustering.moc"
