// SPDX-License-Identifier: MIT
#include "relucent/transport/statistics.h"

#include <tbb/global_control.h>

#include <QtTest>
#include <cmath>
#include <limits>
#include <numeric>

#include "random_blocks.h"
#include "relucent/base/error.h"
#include "relucent/transport/cut_estimate.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

/// Leaves at every level, nested ones among them.
TransportMatrix randomTransport(Rasters cameras, Rasters projectors, double density, std::uint64_t seed) {
  NodeLayout layout(projectors);
  return {cameras, projectors, randomBlocks(cameras.count(), layout.count(), density, seed, -0.1f).sparse};
}

float strengthOf(const TransportMatrix& transport, std::size_t row, std::size_t entry) {
  Block block = transport.layout().block(transport.layout().node(transport.ownLeaves().column(entry)));
  return transport.ownLeaves().block(row, entry).cwiseAbs().maxCoeff() / static_cast<float>(block.count());
}

template <typename Visit>
void visitLeaves(const TransportMatrix& transport, const Visit& visit) {
  for (std::size_t row = 0; row < transport.ownLeaves().rows(); ++row)
    for (std::size_t e = transport.ownLeaves().rowBegin(row); e < transport.ownLeaves().rowBegin(row + 1);
         ++e)
      visit(row, e);
}

}  // namespace

class TestStatistics : public QObject {
  Q_OBJECT

 private slots:
  void settings_data() {
    QTest::addColumn<double>("absolute");
    QTest::addColumn<double>("share");
    QTest::addColumn<double>("energy");
    QTest::newRow("nothing dropped") << 0.0 << 0.0 << 1.0;
    QTest::newRow("a value") << 0.02 << 0.0 << 1.0;
    QTest::newRow("share of the row") << 0.0 << 0.2 << 1.0;
    QTest::newRow("share of the energy") << 0.0 << 0.0 << 0.9;
    QTest::newRow("half of the energy") << 0.0 << 0.0 << 0.5;
    QTest::newRow("no energy") << 0.0 << 0.0 << 0.0;
    QTest::newRow("above everything") << 1e9 << 0.0 << 1.0;
    QTest::newRow("all of them") << 0.01 << 0.1 << 0.8;
  }
  static ThresholdSettings settings() {
    QFETCH(double, absolute);
    QFETCH(double, share);
    QFETCH(double, energy);
    return {static_cast<float>(absolute), static_cast<float>(share), energy};
  }

  /// What is announced is what `thresholded` leaves.
  void announcesTheThreshold_data() { settings_data(); }
  void announcesTheThreshold() {
    TransportMatrix transport = randomTransport(Size{9, 5}, std::vector<Size>{{13, 7}, {3, 2}}, 0.3, 4);
    TransportStatistics announced = statisticsOf(transport, settings());
    TransportMatrix cut = thresholded(transport, settings(), transport.floodlight());
    QCOMPARE(announced.leaves, cut.ownLeaves().blocks());
    QCOMPARE(announced.bytes, cut.ownLeaves().bytes());
    QCOMPARE(announced.connections, statisticsOf(cut).connections);
    std::uint64_t counted = 0;
    for (std::uint64_t bin : announced.histogram.leaves) counted += bin;
    QCOMPARE(counted, announced.leaves);
  }

  void keepsAtLeastTheEnergyAskedFor_data() { settings_data(); }
  void keepsAtLeastTheEnergyAskedFor() {
    TransportMatrix transport = randomTransport(Size{9, 5}, Size{13, 7}, 0.3, 5);
    ThresholdSettings asked = settings();
    asked.absolute = asked.shareOfRowMax = 0.0f;
    std::vector<float> limit = thresholdLimits(transport, asked);
    double all = 0, kept = 0, stronger = 0;
    visitLeaves(transport, [&](std::size_t row, std::size_t entry) {
      double light = transport.ownLeaves().block(row, entry).cwiseAbs().sum();
      float strength = strengthOf(transport, row, entry);
      all += light;
      // The limit is rounded down by at most 2^-7 of itself.
      kept += strength >= limit[row] ? light : 0.0;
      stronger += strength > limit[row] * 1.008f ? light : 0.0;
    });
    QVERIFY(kept >= asked.energyKept * all * (1 - 1e-6));
    if (asked.energyKept > 0.3 && asked.energyKept < 1.0) QVERIFY(stronger <= asked.energyKept * all);
    QVERIFY(std::abs(statisticsOf(transport, asked).energyKept - kept / all) < 1e-5);
  }

  void neverAddsEnergy_data() { settings_data(); }
  void neverAddsEnergy() {
    TransportMatrix transport = randomTransport(Size{9, 5}, Size{13, 7}, 0.3, 6);
    TransportStatistics before = statisticsOf(transport), after = statisticsOf(transport, settings());
    QVERIFY(after.energy <= before.energy && after.energyKept <= 1.0);
    QVERIFY(after.leaves <= before.leaves && after.bytes <= before.bytes);
  }

  void rowNormsAreThoseOfThePixels_data() {
    QTest::addColumn<double>("density");
    QTest::newRow("empty") << 0.0;
    QTest::newRow("sparse") << 0.02;
    QTest::newRow("nested") << 0.5;
    QTest::newRow("every node") << 1.0;
  }
  void rowNormsAreThoseOfThePixels() {
    QFETCH(double, density);
    TransportMatrix transport = randomTransport(Size{5, 3}, std::vector<Size>{{9, 5}, {1, 3}}, density, 7);
    const NodeLayout& layout = transport.layout();
    std::vector<std::uint8_t> nested;
    std::vector<double> norms = squaredRowNorms(transport, NodeTable(layout), &nested);
    std::size_t pixels = layout.projectors().count();
    for (std::size_t row = 0; row < norms.size(); ++row) {
      std::vector<Eigen::Matrix3d> dense(pixels, Eigen::Matrix3d::Zero());
      std::vector<int> over(pixels, 0);
      for (std::size_t e = transport.ownLeaves().rowBegin(row); e < transport.ownLeaves().rowBegin(row + 1);
           ++e) {
        Node node = layout.node(transport.ownLeaves().column(e));
        Block block = layout.block(node);
        auto device = static_cast<std::size_t>(node.projector);
        for (int y = block.y0; y < block.y1; ++y)
          for (int x = block.x0; x < block.x1; ++x) {
            std::size_t pixel =
                layout.projectors().offset(device) + indexOf(layout.projectors().size(device), {x, y});
            dense[pixel] += transport.ownLeaves().block(row, e).cast<double>() / block.count();
            ++over[pixel];
          }
      }
      double expected = 0;
      for (const auto& block : dense) expected += block.squaredNorm();
      // Doubles, some hundred terms of either sign.
      QVERIFY2(std::abs(norms[row] - expected) <= 1e-5 * expected,
               qPrintable(QString("%1: %2, %3").arg(row).arg(norms[row]).arg(expected)));
      QCOMPARE(nested[row] != 0, *std::max_element(over.begin(), over.end()) > 1);
    }
  }

  void sameForEveryNumberOfThreads() {
    TransportMatrix transport = randomTransport(Size{31, 17}, Size{23, 9}, 0.3, 8);
    auto run = [&](std::size_t threads) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return std::pair{statisticsOf(transport, {0.0f, 0.0f, 0.8}).energy,
                       squaredRowNorms(transport, NodeTable(transport.layout()))};
    };
    QVERIFY(run(1) == run(2));
  }

  void wrongSettingsAreRefused_data() {
    QTest::addColumn<float>("absolute");
    QTest::addColumn<float>("share");
    QTest::addColumn<double>("energy");
    float nan = std::numeric_limits<float>::quiet_NaN();
    QTest::newRow("negative value") << -1.0f << 0.0f << 1.0;
    QTest::newRow("more than the row") << 0.0f << 1.1f << 1.0;
    QTest::newRow("more than all energy") << 0.0f << 0.0f << 1.1;
    QTest::newRow("not a number") << nan << nan << static_cast<double>(nan);
  }
  void wrongSettingsAreRefused() {
    QFETCH(float, absolute);
    QFETCH(float, share);
    QFETCH(double, energy);
    TransportMatrix transport = randomTransport(Size{2, 1}, Size{2, 2}, 1.0, 9);
    QVERIFY(!problems(ThresholdSettings{absolute, share, energy}).empty());
    QVERIFY_EXCEPTION_THROWN(thresholded(transport, {absolute, share, energy}, transport.floodlight()),
                             Error);
  }

  void theSuggestedCutLeavesOutNoMoreThanAllowed_data() {
    QTest::addColumn<double>("share");
    for (double share : {0.5, 0.9, 0.995, 1.0}) QTest::newRow(qPrintable(QString::number(share))) << share;
  }
  void theSuggestedCutLeavesOutNoMoreThanAllowed() {
    QFETCH(double, share);
    StrengthHistogram histogram;
    histogram.energy[10] = 1.0;
    histogram.energy[11] = 3.0;
    histogram.energy[14] = 96.0;
    double cut = cutKeeping(histogram, share), below = 0.0;
    for (std::size_t bin = 0; bin < StrengthHistogram::bins; ++bin)
      if (strengthOfBin(bin) < cut) below += histogram.energy[bin] / 100.0;
    QVERIFY(below <= 1.0 - share + 1e-12);
    QCOMPARE(cutKeeping(StrengthHistogram(), share), 0.0);
    if (share == 0.9) QCOMPARE(cut, strengthOfBin(14));
    if (share == 1.0) QCOMPARE(cut, 0.0);
  }

  void theEstimateIsTheCountAtTheEdgeOfABin() {
    const TransportMatrix transport = randomTransport(Size{6, 5}, Size{8, 8}, 0.6, 3);
    const TransportStatistics whole = statisticsOf(transport);
    for (std::size_t bin = 0; bin < StrengthHistogram::bins; bin += 3) {
      const double cut = strengthOfBin(bin);
      std::uint64_t above = 0;
      for (std::size_t i = bin; i < StrengthHistogram::bins; ++i) above += whole.histogram.leaves[i];
      const TransportStatistics estimate = estimatedAfterCut(whole, cut);
      // An edge may fall a rounding into its bin.
      QVERIFY(std::abs(static_cast<double>(estimate.leaves) - static_cast<double>(above)) <= 1.0);
    }
    QCOMPARE(estimatedAfterCut(whole, 0.0).leaves, whole.leaves);
    QCOMPARE(estimatedAfterCut(whole, 0.0).energyKept, 1.0);
  }

  /// Law: bars that are called connections add up to what is said of connections, whatever leaves they are
  /// in, in all and after a cut.
  void theHistogramCountsConnections() {
    const TransportMatrix transport = randomTransport(Size{6, 5}, Size{8, 8}, 0.6, 3);
    for (const float cut : {0.0f, 0.3f}) {
      ThresholdSettings settings;
      settings.absolute = cut;
      const TransportStatistics kept = statisticsOf(transport, settings);
      const auto& bars = kept.histogram.connections;
      QCOMPARE(std::accumulate(bars.begin(), bars.end(), std::uint64_t{0}), kept.connections);
      QVERIFY(cut > 0.0f || kept.connections > kept.leaves);  // some leaves are larger than a pixel
    }
  }

  void ofAHigherCutLessIsEstimated() {
    const TransportStatistics whole = statisticsOf(randomTransport(Size{6, 5}, Size{8, 8}, 0.6, 4));
    double energy = 1.0;
    for (double cut = 1e-6; cut < 1e2; cut *= 1.3) {
      const TransportStatistics kept = estimatedAfterCut(whole, cut);
      QVERIFY(kept.energyKept <= energy && kept.energyKept >= 0.0);
      QVERIFY(kept.leaves <= whole.leaves && kept.bytes <= whole.bytes);
      QVERIFY(kept.connections <= whole.connections);
      energy = kept.energyKept;
    }
  }
};

QTEST_APPLESS_MAIN(TestStatistics)
#include "test_statistics.moc"
