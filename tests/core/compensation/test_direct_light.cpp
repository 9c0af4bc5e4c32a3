// SPDX-License-Identifier: MIT
#include "relucent/compensation/direct_light.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/base/error.h"
#include "relucent/transport/difference.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

Progress quiet;

/// Squares of `side` pixels, every other one lit.
ProjectorStack checkerboard(Size size, int side, int shiftX, int shiftY) {
  ProjectorStack pattern(3 * size.count(), 0.0f);
  for (std::size_t j = 0; j < size.count(); ++j) {
    Pixel pixel = pixelAt(size, j);
    bool lit = (((pixel.x + shiftX) / side + (pixel.y + shiftY) / side) % 2) == 0;
    for (std::size_t c = 0; c < 3; ++c) pattern[3 * j + c] = lit ? 1.0f : 0.0f;
  }
  return pattern;
}

/// One camera pixel of white blocks: {node, light while the whole block is lit}.
TransportMatrix onePixel(Rasters projectors, const std::vector<std::pair<Node, float>>& blocks) {
  NodeLayout layout{projectors};
  float most = 0.0f;
  for (const auto& [node, light] : blocks) most = std::max(most, std::abs(light));
  BlockSparseBuilder builder(layout.count(), {most});
  for (const auto& [node, light] : blocks)
    builder.add(0, layout.index(node), (light * ColourBlock::Identity()).eval());
  return TransportMatrix(Size{1, 1}, std::move(projectors), builder.build());
}

std::vector<std::size_t> directNodes(const TransportMatrix& transport) {
  TransportMatrix direct = directPart(transport, {}, quiet);
  std::vector<std::size_t> nodes;
  for (std::size_t entry = 0; entry < direct.ownLeaves().blocks(); ++entry)
    nodes.push_back(direct.ownLeaves().column(entry));
  return nodes;
}

}  // namespace

class TestDirectLight : public QObject {
  Q_OBJECT

 private slots:
  /// Nothing is lost, changed or made.
  void directIsPartOfTheWhole() {
    Scene scene = makeScene({});
    TransportMatrix direct = directPart(scene.transport, {}, quiet);
    const BlockSparse &all = scene.transport.ownLeaves(), &kept = direct.ownLeaves();
    QVERIFY(kept.blocks() > 0 && kept.blocks() < all.blocks());
    for (std::size_t row = 0; row < all.rows(); ++row) {
      std::size_t entry = all.rowBegin(row);
      for (std::size_t k = kept.rowBegin(row); k < kept.rowBegin(row + 1); ++k) {
        while (entry < all.rowBegin(row + 1) && all.column(entry) < kept.column(k)) ++entry;
        QVERIFY(entry < all.rowBegin(row + 1));
        QCOMPARE(all.column(entry), kept.column(k));
        QVERIFY(all.code(entry) == kept.code(k));
      }
    }
    DirectLightSettings everything;
    everything.reach = 1.0;
    QVERIFY(directPart(scene.transport, everything, quiet).ownLeaves() == all);
  }

  void nearAndNarrowIsDirect_data() {
    QTest::addColumn<int>("level");
    QTest::addColumn<int>("x");
    QTest::addColumn<bool>("direct");
    // A projector of 128 pixels: a reach of 4.
    QTest::newRow("beside it") << 0 << 41 << true;
    QTest::newRow("as far as the reach") << 0 << 44 << true;
    QTest::newRow("further") << 0 << 45 << false;
    QTest::newRow("two pixels wide") << 1 << 21 << true;
    QTest::newRow("wider than the reach") << 3 << 5 << false;
    QTest::newRow("everywhere") << 7 << 0 << false;
  }
  void nearAndNarrowIsDirect() {
    QFETCH(int, level);
    QFETCH(int, x);
    QFETCH(bool, direct);
    int y = 40 >> level;
    TransportMatrix transport = onePixel(Size{128, 96}, {{{0, 0, 40, 40}, 1.0f}, {{0, level, x, y}, 0.5f}});
    QCOMPARE(directNodes(transport).size(), direct ? std::size_t{2} : std::size_t{1});
  }

  /// Bright per pixel, not in sum: a wide leaf may carry more light than the direct one.
  void lightOverAWideAreaIsNotDirect() {
    TransportMatrix transport = onePixel(Size{128, 96}, {{{0, 0, 40, 40}, 1.0f}, {{0, 6, 1, 1}, 10.0f}});
    QCOMPARE(directNodes(transport), std::vector<std::size_t>{transport.layout().index({0, 0, 40, 40})});
    TransportMatrix shadow = onePixel(Size{128, 96}, {{{0, 6, 1, 1}, 10.0f}});
    QVERIFY(directNodes(shadow).empty());
  }

  /// Measured in blocks of 8 px: wider than the reach among single pixels, which is 4.
  void ofCoarseBlocksTheBrightestIsDirect() {
    TransportMatrix blocks = onePixel(Size{128, 96}, {{{0, 3, 5, 5}, 10.0f}, {{0, 3, 12, 5}, 1.0f}});
    QCOMPARE(directNodes(blocks), std::vector<std::size_t>{blocks.layout().index({0, 3, 5, 5})});
  }

  /// Two projectors light a place each on its own; one that is in shadow there sends indirect light.
  void everyProjectorHasItsOwnDirectLight() {
    Rasters two{std::vector<Size>{{32, 24}, {40, 30}}};
    QCOMPARE(directNodes(onePixel(two, {{{0, 0, 5, 5}, 1.0f}, {{1, 0, 20, 9}, 0.6f}})).size(),
             std::size_t{2});
    QCOMPARE(directNodes(onePixel(two, {{{0, 0, 5, 5}, 1.0f}, {{1, 0, 20, 9}, 0.05f}})).size(),
             std::size_t{1});
  }

  void agreesWithShiftedCheckerboards_data() {
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 3; ++seed) QTest::addRow("seed %d", seed) << seed;
  }
  /// Nayar et al. 2006: of all shifts of a fine checkerboard the brightest shows direct light and half the
  /// global, the darkest half the global alone.
  void agreesWithShiftedCheckerboards() {
    QFETCH(int, seed);
    SceneSettings s;
    s.projector = {128, 96};
    s.camera = {64, 48};
    s.seed = static_cast<std::uint64_t>(seed);
    s.softest = 0.6;
    s.margin = 0.0;
    s.farField = 0.3;
    Scene scene = makeScene(s);
    constexpr int side = 8;
    Stack brightest(3 * s.camera.count(), 0.0f), darkest(3 * s.camera.count(), 1e9f);
    for (int y = 0; y < 2 * side; y += 2) {
      for (int x = 0; x < 2 * side; x += 2) {
        CameraStack lit = scene.transport.apply(checkerboard(s.projector, side, x, y));
        for (std::size_t i = 0; i < lit.size(); ++i) {
          brightest[i] = std::max(brightest[i], lit[i]);
          darkest[i] = std::min(darkest[i], lit[i]);
        }
      }
    }
    CameraStack direct = directPart(scene.transport, {}, quiet).floodlight();
    double error = 0.0, share = 0.0, count = 0.0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
      if (!scene.usable[i / 3]) continue;
      double separated = static_cast<double>(brightest[i] - darkest[i]), flood = brightest[i] + darkest[i];
      error += std::abs(static_cast<double>(direct[i]) - separated) / flood;
      share += separated / flood;
      count += 1.0;
    }
    qInfo() << "direct share" << share / count << "mean difference" << error / count;
    QVERIFY(share / count < 0.9);
    // The checkerboard's squares are blurred by the camera's pixels, and mirrored light near its mirror is
    // counted as direct here: a few percent of the flood image.
    QVERIFY2(error / count < 0.05, qPrintable(QString::number(error / count)));
  }

  /// Somebody who knows of no indirect light puts all of it down to direct light.
  void defocusCarriesAllLight() {
    Scene scene = makeScene({});
    CameraStack flood = scene.transport.floodlight();
    TransportMatrix defocus = defocusOnly(scene.transport, {}, quiet);
    Stack through = defocus.floodlight();
    for (std::size_t i = 0; i < flood.size(); ++i) {
      if (defocus.ownLeaves().rowBegin(i / 3) == defocus.ownLeaves().rowBegin(i / 3 + 1)) continue;
      // Scaled rows are rounded to their codes again: 2e-5 of the row's largest, for each of some dozens.
      QVERIFY2(std::abs(through[i] - flood[i]) <= 2e-3f * flood[i],
               qPrintable(QString("%1 %2").arg(through[i]).arg(flood[i])));
    }
  }

  /// Law: of rows that changed alone it is what it is of all of them.
  void isTheSameWhenOnlyChangedRowsAreLookedAt() {
    const TransportMatrix after = makeScene({}).transport;
    const NodeLayout& layout = after.layout();
    const TransportMatrix before =
        after.filtered([&](std::size_t row, const LeafRow& leaves, std::vector<std::uint8_t>& keep) {
          for (std::size_t entry = 0; entry < leaves.size(); ++entry)
            keep[entry] = layout.node(leaves.column(entry)).level > 0 || row % 3 != 0 ? 1 : 0;
        });
    const CameraMask lit = directlyLit(directLooks(before, {}, quiet)),
                     expected = directlyLit(directLooks(after, {}, quiet));
    QVERIFY(lit != expected);
    QVERIFY(renewedDirectlyLit(lit, before, after, differingRows(after, before)) == expected);
  }

  /// Law: where one row is finer than any was before, light of blocks is no longer direct in rows that stay.
  void isTheSameWhenOneRowIsFiner() {
    const auto twoPixels = [](const Node& second) {
      const NodeLayout layout{Rasters(Size{64, 48})};
      BlockSparseBuilder builder(layout.count(), {1.0f, 1.0f});
      builder.add(0, layout.index({0, 3, 2, 2}), ColourBlock::Identity());
      builder.add(1, layout.index(second), ColourBlock::Identity());
      return TransportMatrix(Size{2, 1}, Rasters(Size{64, 48}), builder.build());
    };
    const TransportMatrix before = twoPixels({0, 3, 4, 4}), after = twoPixels({0, 0, 33, 33});
    const CameraMask lit = directlyLit(directLooks(before, {}, quiet)),
                     changed = differingRows(after, before);
    QVERIFY(lit[0] && !changed[0] && changed[1]);
    QVERIFY(renewedDirectlyLit(lit, before, after, changed) == directlyLit(directLooks(after, {}, quiet)));
  }

  void emptyTransportHasNoDirectLight() {
    NodeLayout layout{Rasters(Size{7, 5})};
    BlockSparseBuilder builder(layout.count(), std::vector<float>(6, 0.0f));
    TransportMatrix dark(Size{3, 2}, Size{7, 5}, builder.build());
    QCOMPARE(directPart(dark, {}, quiet).ownLeaves().blocks(), std::size_t{0});
    QVERIFY(defocusOnly(dark, {}, quiet).floodlight() == Stack(18, 0.0f));
    QCOMPARE(directNodes(onePixel(Size{1, 1}, {{{0, 0, 0, 0}, 0.5f}})).size(), std::size_t{1});
  }

  void stopsWhenAskedAndChecksSettings() {
    Stopped cancelled;
    QVERIFY_EXCEPTION_THROWN(directPart(makeScene({}).transport, {}, cancelled), Cancelled);
    QVERIFY(problems(DirectLightSettings{}).empty());
    QCOMPARE(problems(DirectLightSettings{0.0}).size(), std::size_t{1});
    QCOMPARE(problems(DirectLightSettings{std::nan("")}).size(), std::size_t{1});
  }
};

QTEST_APPLESS_MAIN(TestDirectLight)
#include "test_direct_light.moc"
