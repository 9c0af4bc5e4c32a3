// SPDX-License-Identifier: MIT
#include "relucent/engine/packed_transport.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/engine/engine_scenes.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

using Blocks = std::map<std::uint32_t, ColourBlock>;

/// Adds leaves with a mixing to blocks by nodes of the layout.
void write(const PackedTransport& packed, const TransportPatch& patch, const std::vector<PackedLeaf>& leaves,
           const ColourBlock& mixing, Blocks& to) {
  for (const PackedLeaf& leaf : leaves) {
    if (leaf.column >= patch.columnEnd - patch.columnBegin) continue;  // it fills up
    const Eigen::Vector3f code(leaf.code[0], leaf.code[1], leaf.code[2]);
    ColourBlock& block =
        to.try_emplace(packed.nodes()[patch.columnBegin + leaf.column], ColourBlock::Zero()).first->second;
    block += mixing * code.asDiagonal();
  }
}

/// Row r of a packed T written out: nodes of the layout -> 3x3 blocks.
Blocks writtenOut(const PackedTransport& packed, const TransportPatch& patch, std::size_t number) {
  const PackedRow& row = packed.rows()[number];
  Blocks blocks;
  write(packed, patch, packed.leavesOf(row), packed.ownMixing(row), blocks);
  for (std::uint32_t g = row.group; g != PackedGroup::none; g = packed.groups()[g].parent) {
    const PackedGroup& group = packed.groups()[g];
    write(packed, patch, packed.leavesOf(group), group.scale * packed.sharedMixing(row), blocks);
  }
  return blocks;
}

/// The light of single projector pixels.
std::vector<ColourBlock> spread(const NodeLayout& layout, const Blocks& blocks) {
  std::vector<ColourBlock> pixels(layout.projectors().count(), ColourBlock::Zero());
  for (const auto& [index, light] : blocks) {
    const Node node = layout.node(index);
    const Block block = layout.block(node);
    const auto projector = static_cast<std::size_t>(node.projector);
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x)
        pixels[layout.projectors().offset(projector) +
               indexOf(layout.projectors().size(projector), {x, y})] +=
            light / static_cast<float>(block.count());
  }
  return pixels;
}

/// Relative Frobenius distance of what single pixels send.
double apart(const NodeLayout& layout, const Blocks& blocks, const Blocks& reference) {
  const std::vector<ColourBlock> a = spread(layout, blocks), b = spread(layout, reference);
  double error = 0.0, whole = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    error += static_cast<double>((a[j] - b[j]).squaredNorm());
    whole += static_cast<double>(b[j].squaredNorm());
  }
  return whole > 0.0 ? std::sqrt(error / whole) : std::sqrt(error);
}

constexpr float exactly = 0.0f;  // a tolerance

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
    PackedTransport packed(venue.transport, {side});
    std::vector<std::uint32_t> pixels;
    for (const PackedRow& row : packed.rows()) pixels.push_back(row.pixel);
    std::sort(pixels.begin(), pixels.end());
    QCOMPARE(pixels.size(), venue.usable.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) QCOMPARE(pixels[i], static_cast<std::uint32_t>(i));
    std::size_t held = 0;
    for (const TransportPatch& patch : packed.patches()) {
      // No leaf is there twice, and what fills up stands behind all others.
      auto differ = [&](const std::vector<PackedLeaf>& leaves) {
        const auto fills = [&](const PackedLeaf& leaf) {
          return leaf.column == patch.columnEnd - patch.columnBegin &&
                 leaf.code == std::array<std::int16_t, 3>{};
        };
        const auto filling = std::find_if(leaves.begin(), leaves.end(), fills);
        std::set<std::uint16_t> columns;
        for (auto leaf = leaves.begin(); leaf != filling; ++leaf) columns.insert(leaf->column);
        held += columns.size();
        return columns.size() == static_cast<std::size_t>(filling - leaves.begin()) &&
               std::all_of(filling, leaves.end(), fills);
      };
      for (std::uint32_t r = patch.rowBegin; r < patch.rowEnd; ++r)
        QVERIFY(differ(packed.leavesOf(packed.rows()[r])));
      for (std::uint32_t g = patch.groupBegin; g < patch.groupEnd; ++g)
        QVERIFY(differ(packed.leavesOf(packed.groups()[g])));
    }
    QVERIFY(held <= venue.transport.flattened().storedLeaves());
    QCOMPARE(packed.patches().back().rowEnd, static_cast<std::uint32_t>(pixels.size()));
    QCOMPARE(packed.patches().back().groupEnd, static_cast<std::uint32_t>(packed.groups().size()));
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
    PackedTransport packed(venue.transport, {16, exactly});
    std::vector<ColourBlock> sums = venue.transport.rowSums();
    for (const TransportPatch& patch : packed.patches()) {
      for (std::size_t row = patch.rowBegin; row < patch.rowEnd; ++row) {
        auto blocks = writtenOut(packed, patch, row);
        std::size_t pixel = packed.rows()[row].pixel;
        ColourBlock sum = ColourBlock::Zero();
        float largest = 0.0f;
        for (const auto& [node, block] : blocks) {
          sum += block;
          largest = std::max(largest, block.cwiseAbs().maxCoeff());
        }
        // Half a code a leaf, all of the same sign at worst; the same for the codes of T itself.
        float rounding = static_cast<float>(blocks.size() + 1) * (largest + 1e-6f) / 32767.0f;
        QVERIFY((sum - sums[pixel]).cwiseAbs().maxCoeff() <= rounding);
        if (scene.startsWith("several")) continue;
        const LeafRow leaves = venue.transport.row(pixel);
        Blocks whole;
        for (std::size_t entry = 0; entry < leaves.size(); ++entry)
          whole.emplace(leaves.column(entry), leaves.block(entry));
        // Far light is some codes of T bright, so that its mixing is rounded, and the brightest leaf is cut
        // off.
        const double error = apart(venue.transport.layout(), blocks, whole);
        QVERIFY2(error <= 1e-2, qPrintable(QString("row %1: %2").arg(row).arg(error)));
      }
    }
  }

  void splitsWhatTouchesTooMuch() {
    // 300 x 300 projector pixels are more than 16 bits number; two rows see half of them each.
    Size projector{300, 300};
    NodeLayout layout{Rasters(projector)};
    BlockSparseBuilder builder(layout.count(), {1.0f, 1.0f, 1.0f});
    // No two pixels are alike, so that no wider node stands for some of them.
    auto unlike = [](std::size_t j) { return 1.0f - 1e-6f * static_cast<float>(j * 7919 % 90001); };
    for (std::size_t j = 0; j < projector.count(); ++j)
      builder.add(j % 2, j, ColourBlock::Constant(0.5f * unlike(j)));
    // And the third sees all of them: the brightest stay, and their sum is what it was.
    for (std::size_t j = 0; j < projector.count(); ++j)
      builder.add(2, j, ColourBlock::Identity() * ((j < 60000 ? 0.5f : 0.25f) * unlike(j)));
    TransportMatrix transport(Size{3, 1}, projector, builder.build());
    PackedTransport packed(transport, {64, exactly});
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
    PackedTransport packed(transport, {8});
    QCOMPARE(packed.leaves().size(), std::size_t{0});
    QCOMPARE(packed.rows().size(), std::size_t{6});
    for (const PackedRow& row : packed.rows()) {
      QCOMPARE(packed.ownMixing(row), ColourBlock(ColourBlock::Zero()));
      QCOMPARE(packed.sharedMixing(row), ColourBlock(ColourBlock::Zero()));
    }
  }
};

QTEST_GUILESS_MAIN(TestPackedTransport)
#include "test_packed_transport.moc"
