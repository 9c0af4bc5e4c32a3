// SPDX-License-Identifier: MIT
#include "relucent/engine/packed_transport.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/engine/engine_scenes.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

/// Row r of a packed T written out: nodes of the layout -> 3x3 blocks.
std::map<std::uint32_t, ColourBlock> writtenOut(const PackedTransport& packed, const TransportPatch& patch,
                                                std::size_t row) {
  std::map<std::uint32_t, ColourBlock> blocks;
  ColourBlock mixing = Eigen::Map<const ColourBlock>(&packed.mixing()[9 * row]);
  for (std::size_t i = packed.leafStart()[row]; i < packed.leafStart()[row + 1]; ++i) {
    const PackedLeaf& leaf = packed.leaves()[i];
    Eigen::Vector3f code(leaf.code[0], leaf.code[1], leaf.code[2]);
    blocks[packed.nodes()[patch.columnBegin + leaf.column]] = mixing * code.asDiagonal();
  }
  return blocks;
}

}  // namespace

class TestPackedTransport : public QObject {
  Q_OBJECT

 private slots:
  void holdsEveryRowOnce_data() {
    QTest::addColumn<QString>("scene");
    QTest::addColumn<int>("side");
    for (const std::string& scene : engineSceneNames())
      for (int side : {8, 13, 256})
        QTest::addRow("%s, patches of %d", scene.c_str(), side) << QString::fromStdString(scene) << side;
  }
  void holdsEveryRowOnce() {
    QFETCH(QString, scene);
    QFETCH(int, side);
    MeasuredVenue venue = engineSceneOf(scene.toStdString()).venue;
    PackedTransport packed(venue.transport, side);
    std::vector<std::uint32_t> pixels = packed.pixels();
    std::sort(pixels.begin(), pixels.end());
    QCOMPARE(pixels.size(), venue.usable.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) QCOMPARE(pixels[i], static_cast<std::uint32_t>(i));
    QCOMPARE(packed.leafStart().back(), static_cast<std::uint32_t>(packed.leaves().size()));
    QVERIFY(packed.leaves().size() <= venue.transport.leaves().blocks());
    QCOMPARE(packed.patches().back().rowEnd, static_cast<std::uint32_t>(pixels.size()));
    QCOMPARE(packed.patches().back().columnEnd, static_cast<std::uint32_t>(packed.nodes().size()));
  }

  void keepsTheFloodImage_data() {
    QTest::addColumn<QString>("scene");
    for (const std::string& scene : engineSceneNames())
      QTest::addRow("%s", scene.c_str()) << QString::fromStdString(scene);
  }
  /// The factors of a row sum to one: every row of the packed T sums to what the row of T sums to. And where
  /// all light of a row has the same mixing, the row is what it was.
  void keepsTheFloodImage() {
    QFETCH(QString, scene);
    MeasuredVenue venue = engineSceneOf(scene.toStdString()).venue;
    PackedTransport packed(venue.transport, 16);
    std::vector<ColourBlock> sums = venue.transport.rowSums();
    const BlockSparse& leaves = venue.transport.leaves();
    for (const TransportPatch& patch : packed.patches()) {
      for (std::size_t row = patch.rowBegin; row < patch.rowEnd; ++row) {
        auto blocks = writtenOut(packed, patch, row);
        std::size_t pixel = packed.pixels()[row];
        ColourBlock sum = ColourBlock::Zero();
        float largest = 0.0f;
        for (const auto& [node, block] : blocks) {
          sum += block;
          largest = std::max(largest, block.cwiseAbs().maxCoeff());
        }
        // Half a code a leaf, all of the same sign at worst; the same for the codes of T itself.
        float rounding = static_cast<float>(blocks.size() + 1) * (largest + 1e-6f) / 32767.0f;
        QVERIFY((sum - sums[pixel]).cwiseAbs().maxCoeff() <= rounding);
        if (scene == "several devices") continue;
        double apart = 0.0, whole = 0.0;
        for (std::size_t entry = leaves.rowBegin(pixel); entry < leaves.rowBegin(pixel + 1); ++entry) {
          ColourBlock block = leaves.block(pixel, entry);
          whole += static_cast<double>(block.squaredNorm());
          auto found = blocks.find(leaves.column(entry));
          if (found != blocks.end()) block -= found->second;
          apart += static_cast<double>(block.squaredNorm());
        }
        // Far light is some codes of T bright, so that its mixing is rounded, and the row's mean with it.
        QVERIFY(apart <= std::pow(5e-3, 2) * whole);
      }
    }
  }

  void splitsWhatTouchesTooMuch() {
    // 300 x 300 projector pixels are more than 16 bits number; two rows see half of them each.
    Size projector{300, 300};
    NodeLayout layout{Rasters(projector)};
    BlockSparseBuilder builder(layout.count(), {1.0f, 1.0f, 1.0f});
    for (std::size_t j = 0; j < projector.count(); ++j) builder.add(j % 2, j, ColourBlock::Constant(0.5f));
    // And the third sees all of them: the brightest stay, and their sum is what it was.
    for (std::size_t j = 0; j < projector.count(); ++j)
      builder.add(2, j, ColourBlock::Identity() * (j < 60000 ? 0.5f : 0.25f));
    TransportMatrix transport(Size{3, 1}, projector, builder.build());
    PackedTransport packed(transport, 64);
    QVERIFY(packed.patches().size() >= 3);
    QVERIFY(packed.mostColumns() <= 65535);
    auto all = writtenOut(packed, packed.patches().back(), 2);
    QCOMPARE(all.size(), std::size_t{65535});
    ColourBlock sum = ColourBlock::Zero();
    for (const auto& [node, block] : all) sum += block;
    ColourBlock expected = transport.rowSums()[2];
    QVERIFY((sum - expected).norm() <= 1e-3f * expected.norm());
    for (std::uint32_t j = 0; j < 60000; ++j) QVERIFY(all.contains(j));
  }

  void emptyRows() {
    NodeLayout layout{Rasters(Size{4, 4})};
    TransportMatrix transport(Size{3, 2}, Size{4, 4},
                              BlockSparseBuilder(layout.count(), std::vector<float>(6, 0.0f)).build());
    PackedTransport packed(transport, 8);
    QCOMPARE(packed.leaves().size(), std::size_t{0});
    QCOMPARE(packed.leafStart().size(), std::size_t{7});
    QVERIFY(std::all_of(packed.mixing().begin(), packed.mixing().end(), [](float m) { return m == 0.0f; }));
  }
};

QTEST_GUILESS_MAIN(TestPackedTransport)
#include "test_packed_transport.moc"
