// SPDX-License-Identifier: MIT
// Percolation, and the cap that holds clusters to a size.
#include "relucent/base/message.h"
#include "relucent/clustering/clustering.h"

#include <QtTest>
#include <cmath>

#include "core/clustering/clustering_cases.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::transport;

class TestSizeCap : public QObject {
  Q_OBJECT

 private slots:
  void capHolds_data() {
    QTest::addColumn<int>("most");
    QTest::addColumn<double>("cut");
    QTest::addColumn<double>("softest");
    QTest::newRow("one") << 1 << 0.5 << 1.0;
    QTest::newRow("seven") << 7 << 0.5 << 1.5;
    QTest::newRow("usual") << 128 << 0.3 << 2.0;
    QTest::newRow("nothing cut before") << 64 << 0.0 << 1.5;
    QTest::newRow("larger than everything") << 4096 << 0.5 << 0.5;
  }
  void capHolds() {
    QFETCH(int, most);
    QFETCH(double, cut);
    QFETCH(double, softest);
    synthetic::Scene made = scene(softest);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = asPrinted(6.0, cut);
    settings.cap = SizeCap::always;
    settings.mostUnknowns = most;
    Clustering clustering = clustered(graph, settings, quiet);
    verifyPartition(clustering);
    for (const ClusterSize& size : clustering.sizes)
      QVERIFY(size.unknowns <= static_cast<std::uint32_t>(most));
    // A camera pixel sees less than 64 projector pixels best, so only tiny caps leave one without.
    if (most >= 64) QCOMPARE(clustering.statistics.singledOut, std::size_t{0});
    const ClusteringStatistics& s = clustering.statistics;
    QVERIFY(s.keptLight > 0 && s.cutByPatches >= 0 && s.cutByCap >= 0);
    QVERIFY(std::abs(s.keptLight + s.cutByPatches + s.cutByCap + s.farLight - 1.0) < 1e-9);
    if (cut == 0.0) QCOMPARE(s.cutByPatches, 0.0);
  }

  /// A cap that is never reached changes nothing.
  void capBeyondTheLargestClusterIsNoCap() {
    TransportMatrix transport = pixelTransport(Size{6, 5}, Size{9, 4}, 0.08, 5, false);
    ClusteringSettings settings = asPrinted(2.0, 0.5);
    Clustering free = clustered(everything(transport), settings, quiet);
    settings.cap = SizeCap::always;
    Clustering capped = clustered(everything(transport), settings, quiet);
    QVERIFY(capped.projectorCluster == free.projectorCluster && capped.cameraCluster == free.cameraCluster);
    QVERIFY(capped.transport == free.transport);
  }

  void percolationIsSaidAndCapped() {
    synthetic::Scene made = scene(3.0);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = asPrinted(8.0, 0.3);
    Clustering printed = clustered(graph, settings, quiet);
    QVERIFY(printed.statistics.percolated && !printed.statistics.capped);
    QVERIFY(QString::fromStdString(english(printed.statistics.finding)).contains("allow a cap"));
    settings.cap = SizeCap::whenPercolated;
    Clustering capped = clustered(graph, settings, quiet);
    QVERIFY(capped.statistics.capped && capped.statistics.largest <= 256);
    QVERIFY(QString::fromStdString(english(capped.statistics.finding)).contains("held to 256"));
    QCOMPARE(capped.statistics.largestBeforeCap, printed.statistics.largest);
  }
};

QTEST_GUILESS_MAIN(TestSizeCap)
#include "test_size_cap.moc"
