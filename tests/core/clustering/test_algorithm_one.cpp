// SPDX-License-Identifier: MIT
// Algorithm 1 against its literal transcription, and what its cuts do to the light.
#include "relucent/clustering/clustering.h"

#include <QtTest>
#include <cmath>
#include <set>

#include "core/clustering/algorithm_as_printed.h"
#include "core/clustering/clustering_cases.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::transport;

class TestAlgorithmOne : public QObject {
  Q_OBJECT

 private slots:
  void isAlgorithmOneAsPrinted_data() {
    QTest::addColumn<int>("projectors");
    QTest::addColumn<double>("density");
    QTest::addColumn<double>("radius");
    QTest::addColumn<double>("cut");
    QTest::addColumn<bool>("ties");
    QTest::newRow("the paper's") << 1 << 0.2 << 5.0 << 0.5 << false;
    QTest::newRow("weak cut") << 1 << 0.2 << 2.0 << 0.3 << false;
    QTest::newRow("strong cut") << 1 << 0.3 << 3.0 << 0.7 << false;
    QTest::newRow("sparse") << 1 << 0.04 << 2.5 << 0.5 << false;
    QTest::newRow("dense") << 1 << 0.9 << 4.0 << 0.6 << false;
    QTest::newRow("equals") << 1 << 0.3 << 2.0 << 0.5 << true;
    QTest::newRow("equals at the limit") << 1 << 0.5 << 3.0 << 1.0 / 3.0 << true;
    QTest::newRow("nothing cut") << 1 << 0.1 << 3.0 << 0.0 << true;
    QTest::newRow("every pixel a patch") << 1 << 0.1 << 0.0 << 0.5 << false;
    QTest::newRow("two projectors") << 2 << 0.2 << 100.0 << 0.5 << true;
    QTest::newRow("empty") << 1 << 0.0 << 5.0 << 0.5 << false;
  }
  void isAlgorithmOneAsPrinted() {
    QFETCH(int, projectors);
    QFETCH(double, density);
    QFETCH(double, radius);
    QFETCH(double, cut);
    QFETCH(bool, ties);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      std::vector<Size> sizes{{9 - static_cast<int>(seed % 4), 4}};
      if (projectors > 1) sizes.push_back({3, 5});
      TransportMatrix transport =
          pixelTransport(Size{5, 1 + static_cast<int>(seed % 5)}, sizes, density, seed, ties);
      AsPrinted printed(transport, radius, cut);
      Clustering ours = clustered(everything(transport), asPrinted(radius, cut), quiet);
      const BlockSparse& kept = ours.transport.ownLeaves();
      for (std::size_t i = 0; i < kept.rows(); ++i) {
        std::set<std::size_t> here;
        for (std::size_t e = kept.rowBegin(i); e < kept.rowBegin(i + 1); ++e) here.insert(kept.column(e));
        for (std::size_t j = 0; j < transport.projectors().count(); ++j)
          QVERIFY2(printed.connected(i, j) == here.contains(j),
                   qPrintable(QString("seed %1, connection (%2, %3)").arg(seed).arg(i).arg(j)));
      }
      QVERIFY(ours.projectorCluster == printed.projectorClusters());
      verifyPartition(ours);
    }
  }

  void rowsAreScaledToTheFloodlight_data() {
    QTest::addColumn<bool>("patches");
    QTest::addColumn<double>("cut");
    QTest::newRow("patches") << true << 0.5;
    QTest::newRow("patches, strong cut") << true << 0.9;
    QTest::newRow("rows") << false << 0.5;
  }
  void rowsAreScaledToTheFloodlight() {
    QFETCH(bool, patches);
    QFETCH(double, cut);
    synthetic::Scene made = scene(1.0);
    ClusteringSettings settings = asPrinted(4.0, cut);
    settings.rescaling = patches ? Rescaling::patches : Rescaling::rows;
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    Clustering clustering = clustered(graph, settings, quiet);
    CameraStack flood = made.transport.floodlight(), sums = clustering.transport.floodlight();
    for (std::size_t i = 0; i < flood.size(); ++i) {
      if (!made.usable[i / 3]) continue;
      QVERIFY2(std::abs(sums[i] - flood[i]) <= rounding * flood[i], qPrintable(QString::number(i)));
    }
  }

  /// A row of two patches, of which the wider loses more to the cut: each gets its own light back.
  void patchesKeepTheirShareOfTheLight() {
    NodeLayout layout{Rasters(Size{20, 1})};
    BlockSparseBuilder builder(layout.count(), {1.0f});
    ColourBlock one = ColourBlock::Identity();
    for (std::size_t j : {0, 1, 2})
      builder.add(0, j, (j == 1 ? 0.8f : 0.3f) * one);  // 1.4, of which 0.8 stays
    builder.add(0, 15, 0.6f * one);
    TransportMatrix transport(Size{1, 1}, Size{20, 1}, builder.build());
    // The cut-off pixels come back, as nobody else sees them: a second row that does.
    BlockSparseBuilder two(layout.count(), {1.0f, 1.0f});
    for (std::size_t j : {0, 1, 2}) two.add(0, j, (j == 1 ? 0.8f : 0.3f) * one);
    two.add(0, 15, 0.6f * one);
    for (std::size_t j : {0, 2}) two.add(1, j, 0.9f * one);
    TransportMatrix seen(Size{2, 1}, Size{20, 1}, two.build());
    ConnectionGraph graph = everything(seen);
    for (Rescaling rescaling : {Rescaling::patches, Rescaling::rows}) {
      ClusteringSettings settings = asPrinted(3.0, 0.5);
      settings.rescaling = rescaling;
      BlockSparse kept = clustered(graph, settings, quiet).transport.ownLeaves();
      QCOMPARE(kept.rowBegin(1), std::size_t{2});
      double wide = rescaling == Rescaling::patches ? 1.4 : 2.0 * 0.8 / 1.4;
      QVERIFY(std::abs(kept.block(0, 0)(0, 0) - wide) < rounding);
      QVERIFY(std::abs(kept.block(0, 1)(1, 1) - (2.0 - wide)) < rounding);
    }
  }
};

QTEST_GUILESS_MAIN(TestAlgorithmOne)
#include "test_algorithm_one.moc"
