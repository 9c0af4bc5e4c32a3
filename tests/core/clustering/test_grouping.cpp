// SPDX-License-Identifier: MIT
// The first half of clustering, which sliders ask for again and again.
#include "relucent/clustering/grouping.h"

#include <tbb/global_control.h>

#include "relucent/base/parallel.h"  // TBB has functions of the names that Qt's keywords have

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/clustering/clustering_cases.h"
#include "relucent/clustering/disjoint_sets.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::transport;

namespace {

/// A set is a list; joining pours one into the other.
class PlainSets {
 public:
  explicit PlainSets(std::size_t size) : set_(size) { std::iota(set_.begin(), set_.end(), 0u); }
  void join(std::uint32_t a, std::uint32_t b) {
    std::uint32_t from = std::max(set_[a], set_[b]), to = std::min(set_[a], set_[b]);
    std::replace(set_.begin(), set_.end(), from, to);
  }
  std::uint32_t lowest(std::uint32_t element) const { return set_[element]; }

 private:
  std::vector<std::uint32_t> set_;
};

/// The cap as clustered() says it: all connections ranked, joined one by one.
std::vector<std::uint32_t> cappedAsPrinted(const ConnectionGraph& graph, const Grouping& free,
                                           std::ptrdiff_t most) {
  auto pixels = static_cast<std::uint32_t>(graph.transport().projectors().count());
  auto rows = static_cast<std::uint32_t>(graph.rows());
  using Ranked = std::tuple<float, std::uint32_t, std::uint32_t>;  // descending strength, row, pixel
  std::vector<std::pair<float, std::uint32_t>> brightest(pixels, {0.0f, 0});
  auto forKept = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < rows; ++i)
      for (std::size_t k = 0; k < graph.row(i).size(); ++k)
        if (free.kept[graph.placeOf(i) + k]) visit(i, graph.row(i)[k]);
  };
  forKept([&](std::uint32_t i, const Connection& connection) {
    auto& best = brightest[connection.pixel];
    if (connection.luminance > best.first) best = {connection.luminance, i};
  });
  std::vector<Ranked> ranked;
  forKept([&](std::uint32_t i, const Connection& connection) {
    float highest = graph.row(i).front().luminance;
    ranked.emplace_back(
        -connection.luminance / (std::sqrt(highest) * std::sqrt(brightest[connection.pixel].first)), i,
        connection.pixel);
  });
  std::sort(ranked.begin(), ranked.end());

  // Camera pixels come behind the projector pixels and add nothing to a set's size.
  PlainSets sets(pixels + rows);
  std::vector<std::ptrdiff_t> unknowns(pixels + rows, 0);
  std::fill_n(unknowns.begin(), pixels, 1);
  auto join = [&](std::uint32_t i, std::uint32_t pixel) {
    std::uint32_t a = sets.lowest(pixels + i), b = sets.lowest(pixel);
    if (a == b || unknowns[a] + unknowns[b] > most) return;
    unknowns[std::min(a, b)] = unknowns[a] + unknowns[b];
    sets.join(a, b);
  };
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
    if (brightest[pixel].first > 0.0f) join(brightest[pixel].second, pixel);
  for (const auto& [strength, i, pixel] : ranked) join(i, pixel);
  std::vector<std::uint32_t> lowest(pixels, noCluster);
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
    if (brightest[pixel].first > 0.0f) lowest[pixel] = sets.lowest(pixel);
  return lowest;
}

/// Clusters as the lowest projector pixel of each.
std::vector<std::uint32_t> lowestOf(const std::vector<std::uint32_t>& clusters) {
  std::vector<std::uint32_t> first, lowest(clusters.size(), noCluster);
  for (std::uint32_t pixel = 0; pixel < clusters.size(); ++pixel) {
    if (clusters[pixel] == noCluster) continue;
    if (clusters[pixel] == first.size()) first.push_back(pixel);
    lowest[pixel] = first.at(clusters[pixel]);
  }
  return lowest;
}

ClusteringSettings settingsOf(double radius, double cut, int most) {
  ClusteringSettings settings = asPrinted(radius, cut);
  if (most == 0) return settings;
  settings.cap = SizeCap::always;
  settings.mostUnknowns = most;
  return settings;
}

void compareStatistics(const ClusteringStatistics& a, const ClusteringStatistics& b) {
  QCOMPARE(a.kept, b.kept);
  QCOMPARE(a.reinserted, b.reinserted);
  QCOMPARE(a.litProjectorPixels, b.litProjectorPixels);
  QCOMPARE(a.litCameraPixels, b.litCameraPixels);
  QCOMPARE(a.singledOut, b.singledOut);
  QCOMPARE(a.largest, b.largest);
  QCOMPARE(a.largestBeforeCap, b.largestBeforeCap);
  QCOMPARE(a.medianUnknowns, b.medianUnknowns);
  // Bits, not a few of them.
  QVERIFY(a.meanUnknowns == b.meanUnknowns && a.keptLight == b.keptLight);
  QVERIFY(a.cutByPatches == b.cutByPatches && a.cutByCap == b.cutByCap && a.farLight == b.farLight);
  QCOMPARE(a.capped, b.capped);
  QVERIFY(a.finding == b.finding);
}

void compare(const Grouping& a, const Grouping& b) {
  QVERIFY(a.cameraCluster == b.cameraCluster && a.projectorCluster == b.projectorCluster);
  QVERIFY(a.sizes == b.sizes);
  QVERIFY(a.kept == b.kept);
  compareStatistics(a.statistics, b.statistics);
}

}  // namespace

class TestGrouping : public QObject {
  Q_OBJECT

 private slots:
  void disjointSetsAreThoseOfAPlainReference_data() {
    QTest::addColumn<int>("joins");
    QTest::newRow("none") << 0;
    QTest::newRow("some") << 300;
    QTest::newRow("nearly all") << 3000;
  }
  void disjointSetsAreThoseOfAPlainReference() {
    QFETCH(int, joins);
    constexpr std::uint32_t size = 1000;
    DisjointSets sets;
    sets.reset(7);
    sets.join(2, 5);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Random random{seed};
      std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(static_cast<std::size_t>(joins));
      for (auto& [a, b] : pairs) {
        a = static_cast<std::uint32_t>(random.below(size));
        b = static_cast<std::uint32_t>(random.below(size));
      }
      sets.reset(size);
      parallelFor(0, pairs.size(), 1, [&](std::size_t i) { sets.join(pairs[i].first, pairs[i].second); });
      PlainSets plain(size);
      for (const auto& [a, b] : pairs) plain.join(a, b);
      for (std::uint32_t element = 0; element < size; ++element)
        QCOMPARE(sets.find(element), plain.lowest(element));
    }
  }

  void groupsAreThoseOfTheWholeAlgorithm_data() {
    QTest::addColumn<double>("softest");
    QTest::addColumn<double>("radius");
    QTest::addColumn<double>("cut");
    QTest::addColumn<int>("most");
    for (double softest : {0.5, 1.5, 3.0})
      for (double cut : {0.0, 0.3, 0.6})
        for (int most : {0, 1, 9, 128, 4096})
          QTest::addRow("softest %.1f, cut %.1f, most %d", softest, cut, most)
              << softest << (cut > 0.5 ? 3.0 : 8.0) << cut << most;
  }
  /// Whatever was grouped before, and for every number of threads.
  void groupsAreThoseOfTheWholeAlgorithm() {
    QFETCH(double, softest);
    QFETCH(double, radius);
    QFETCH(double, cut);
    QFETCH(int, most);
    synthetic::Scene made = scene(softest, 3);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = settingsOf(radius, cut, most);
    Clustering whole = clustered(graph, settings, quiet);
    verifyPartition(whole);

    Grouper grouper(graph);
    Grouping fresh = grouper.group(settings, quiet);
    QVERIFY(fresh.cameraCluster == whole.cameraCluster && fresh.projectorCluster == whole.projectorCluster);
    QVERIFY(fresh.sizes == whole.sizes);
    compareStatistics(fresh.statistics, whole.statistics);
    for (std::size_t threads : {1, 2, 5}) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      compare(Grouper(graph).group(settings, quiet), fresh);
      GroupingError error = errorOf(graph, fresh, settings, quiet);
      QVERIFY(error.error == whole.error);
      QCOMPARE(error.statistics.errorMedian, whole.statistics.errorMedian);
      QCOMPARE(error.statistics.errorP95, whole.statistics.errorP95);
      // Another cap, another cut, other limits, and back.
      ClusteringSettings dim = settings;
      dim.leastShare = 0.2;
      for (const ClusteringSettings& between :
           {settingsOf(radius, cut, 17), settingsOf(2.0, 0.5, most), settingsOf(radius, cut, 0), dim}) {
        grouper.group(between, quiet);
        compare(grouper.group(settings, quiet), fresh);
      }
    }
  }

  void theCapIsThatOfAPlainReference_data() {
    QTest::addColumn<int>("most");
    QTest::addColumn<bool>("ties");
    for (int most : {1, 2, 5, 20, 64})
      for (bool ties : {false, true}) QTest::addRow("%d%s", most, ties ? " with ties" : "") << most << ties;
  }
  void theCapIsThatOfAPlainReference() {
    QFETCH(int, most);
    QFETCH(bool, ties);
    for (std::uint64_t seed = 0; seed < 6; ++seed)
      for (double cut : {0.0, 0.4}) {
        TransportMatrix transport = pixelTransport(Size{12, 10}, Size{14, 9}, 0.1, seed, ties);
        ConnectionGraph graph = everything(transport);
        Grouper grouper(graph);
        Grouping free = grouper.group(settingsOf(3.0, cut, 0), quiet);
        const Grouping& capped = grouper.group(settingsOf(3.0, cut, most), quiet);
        QVERIFY(lowestOf(capped.projectorCluster) == cappedAsPrinted(graph, free, most));
      }
  }

  /// With strengths over many orders, so that every level of ranks has some.
  void theCapOfASceneIsThatOfAPlainReference() {
    synthetic::Scene made = scene(1.5, 4);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    Grouper grouper(graph);
    Grouping free = grouper.group(settingsOf(6.0, 0.0, 0), quiet);
    for (int most : {12, 200}) {
      const Grouping& capped = grouper.group(settingsOf(6.0, 0.0, most), quiet);
      QVERIFY(lowestOf(capped.projectorCluster) == cappedAsPrinted(graph, free, most));
    }
  }

  void cancelledItCanBeAskedAgain() {
    synthetic::Scene made = scene(2.0);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = settingsOf(6.0, 0.4, 40), other = settingsOf(4.0, 0.2, 30);
    Grouping fresh = Grouper(graph).group(settings, quiet);
    Grouper grouper(graph);
    for (const ClusteringSettings& asked : {settings, other}) {
      Stopped stopped;
      QVERIFY_EXCEPTION_THROWN(grouper.group(asked, stopped), Cancelled);
      compare(grouper.group(settings, quiet), fresh);
    }
    Stopped stopped;
    QVERIFY_EXCEPTION_THROWN(errorOf(graph, fresh, settings, stopped), Cancelled);
  }
};

QTEST_GUILESS_MAIN(TestGrouping)
#include "test_grouping.moc"
