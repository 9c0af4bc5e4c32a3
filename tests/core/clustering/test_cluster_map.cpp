// SPDX-License-Identifier: MIT
#include "relucent/clustering/cluster_map.h"

#include <QtTest>
#include <algorithm>

#include "relucent/base/random.h"
#include "relucent/clustering/clustering.h"

using namespace relucent;
using namespace relucent::clustering;

namespace {

/// Rectangles of random clusters, some of them empty.
std::vector<std::uint32_t> patchwork(Size size, int cell, std::uint32_t clusters, std::uint64_t seed) {
  std::vector<std::uint32_t> map(size.count());
  for (std::size_t i = 0; i < map.size(); ++i) {
    Pixel pixel = pixelAt(size, i);
    Random random{seed, static_cast<std::uint64_t>(pixel.x / cell),
                  static_cast<std::uint64_t>(pixel.y / cell)};
    std::uint64_t drawn = random.below(clusters + 1);
    map[i] = drawn == clusters ? noCluster : static_cast<std::uint32_t>(drawn);
  }
  return map;
}

}  // namespace

class TestClusterMap : public QObject {
  Q_OBJECT

 private slots:
  void neighboursDiffer_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("cell");
    QTest::newRow("one pixel") << 1 << 1 << 1;
    QTest::newRow("a row") << 17 << 1 << 1;
    QTest::newRow("patches") << 61 << 43 << 7;
  }
  void neighboursDiffer() {
    QFETCH(int, width);
    QFETCH(int, height);
    QFETCH(int, cell);
    Size size{width, height};
    // Every patch a cluster of its own: a plane map of cells has at most four neighbours each.
    std::vector<std::uint32_t> map(size.count());
    auto across = static_cast<std::uint32_t>((width + cell - 1) / cell);
    for (std::size_t i = 0; i < map.size(); ++i) {
      Pixel pixel = pixelAt(size, i);
      map[i] =
          static_cast<std::uint32_t>(pixel.y / cell) * across + static_cast<std::uint32_t>(pixel.x / cell);
    }
    std::size_t clusters = *std::max_element(map.begin(), map.end()) + 1;
    std::vector<std::uint8_t> colours = clusterColours(map, size, clusters, 8);
    QCOMPARE(colours.size(), clusters);
    std::vector<std::uint8_t> borders = clusterBorders(map, size);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x + 1 < width; ++x) {
        std::size_t here = indexOf(size, {x, y});
        bool other = map[here] != map[here + 1];
        QCOMPARE(colours[map[here]] != colours[map[here + 1]], other);
        QVERIFY(!other || borders[here] != 0);
      }
  }

  void tooFewColoursAreUsedAllTheSame() {
    Size size{30, 20};
    auto map = patchwork(size, 2, 12, 4);
    for (std::uint8_t colour : clusterColours(map, size, 12, 2)) QVERIFY(colour < 2);
  }

  void devicesDoNotTouch() {
    Rasters rasters = std::vector<Size>{{2, 1}, {2, 1}};
    std::vector<std::uint32_t> map{0, 0, 1, 1};
    QCOMPARE(clusterBorders(map, rasters), std::vector<std::uint8_t>({0, 0, 0, 0}));
  }

  void nothingHasNoColours() {
    QVERIFY(clusterColours({}, Rasters(), 0, 8).empty());
    QVERIFY(clusterColours({noCluster}, Size{1, 1}, 0, 8).empty());
  }
};

QTEST_GUILESS_MAIN(TestClusterMap)
#include "test_cluster_map.moc"
