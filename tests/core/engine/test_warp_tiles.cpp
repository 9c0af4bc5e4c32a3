// SPDX-License-Identifier: MIT
#include "relucent/engine/warp_tiles.h"

#include <QtTest>
#include <set>

#include "core/inverse/synthetic_transport.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::synthetic;

class TestWarpTiles : public QObject {
  Q_OBJECT

 private slots:
  void holdsTheWarp_data() {
    QTest::addColumn<QSize>("content");
    QTest::addColumn<QSize>("view");
    QTest::newRow("larger content") << QSize(192, 108) << QSize(70, 45);
    QTest::newRow("much larger") << QSize(1500, 900) << QSize(40, 33);
    QTest::newRow("smaller content") << QSize(9, 7) << QSize(70, 45);
    QTest::newRow("a pixel") << QSize(1, 1) << QSize(8, 5);
  }
  /// Every camera pixel that the content reaches is there once, with the weights that it has in the warp, in
  /// a tile whose part of the content holds all that it reads; what fills up weighs nothing, and is there to
  /// read.
  void holdsTheWarp() {
    QFETCH(QSize, content);
    QFETCH(QSize, view);
    const Size size{content.width(), content.height()}, camera{view.width(), view.height()};
    const ContentWarp warp(size, {uprightCorners(1, 1, camera.width - 3, camera.height - 2), {}}, camera);
    // The second camera sees nothing of the content.
    const WarpTiles tiles(warp, Rasters({camera, {5, 3}}));
    std::set<std::uint32_t> seen;
    for (const WarpTiles::Tile& tile : tiles.tiles) {
      QVERIFY(tile.x >= 0 && tile.y >= 0 && tile.x + static_cast<int>(tile.width) <= size.width &&
              tile.y + static_cast<int>(tile.height) <= size.height);
      QVERIFY(std::size_t{tile.width} * tile.height <= tiles.mostPixels);
      QCOMPARE(tile.begin % WarpTiles::together, 0u);
      for (std::uint32_t i = tile.end; i % WarpTiles::together != 0; ++i)
        QCOMPARE(tiles.footprints[i].pixel, tiles.footprints[tile.begin].pixel);
      for (std::uint32_t i = tile.begin; i < tile.end; ++i) {
        const WarpTiles::Footprint& at = tiles.footprints[i];
        const ContentWarp::Footprint& from = warp.footprints()[at.pixel];
        QVERIFY(seen.insert(at.pixel).second);
        QCOMPARE(at.scale, from.scale);
        QCOMPARE(at.lines, from.height);
        const std::uint16_t *weight = tiles.weights.data() + WarpTiles::together * at.weight,
                            *expected = warp.weights().data() + from.weight;
        for (std::uint32_t y = 0; y < at.lines; ++y)
          for (std::uint32_t x = 0; x < WarpTiles::together * at.across; ++x, ++weight) {
            const std::uint32_t place = at.first + y * tile.width + x;
            QVERIFY(place < tiles.mostPixels + WarpTiles::together);
            if (x >= from.width) {
              QCOMPARE(*weight, std::uint16_t{0});
              continue;
            }
            QCOMPARE(*weight, *expected++);
            QCOMPARE(static_cast<int>(place % tile.width) + tile.x, from.x + static_cast<int>(x));
            QCOMPARE(static_cast<int>(place / tile.width) + tile.y, from.y + static_cast<int>(y));
          }
      }
    }
    std::size_t inside = 0;
    for (std::size_t pixel = 0; pixel < camera.count(); ++pixel) inside += warp.inside(pixel) ? 1 : 0;
    QVERIFY(inside > 0);
    QCOMPARE(seen.size(), inside);
  }
};

QTEST_GUILESS_MAIN(TestWarpTiles)
#include "test_warp_tiles.moc"
