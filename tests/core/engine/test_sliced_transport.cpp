// SPDX-License-Identifier: MIT
#include <QtTest>
#include <map>

#include "core/engine/engine_scenes.h"
#include "relucent/engine/opengl/sliced_transport.h"

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

using Code = std::array<std::int16_t, 3>;
/// (camera pixel, node) -> codes. Leaves with codes 0 say nothing.
using Leaves = std::multimap<std::pair<std::uint32_t, std::uint32_t>, Code>;

Leaves leavesOf(const PackedTransport& packed) {
  Leaves all;
  for (const TransportPatch& patch : packed.patches())
    for (std::uint32_t row = patch.rowBegin; row < patch.rowEnd; ++row)
      for (std::uint32_t i = packed.leafStart()[row]; i < packed.leafStart()[row + 1]; ++i)
        all.emplace(
            std::pair{packed.pixels()[row], packed.nodes()[patch.columnBegin + packed.leaves()[i].column]},
            packed.leaves()[i].code);
  return all;
}

/// visit(run, base, leaf) for everything but what was filled up.
template <typename Visit>
void eachLeaf(const LeafSlices& slices, const Visit& visit) {
  for (std::size_t slice = 0; slice < slices.count(); ++slice)
    for (std::uint32_t k = slices.slices[slice].leaf; k < slices.slices[slice + 1].leaf; ++k)
      for (std::uint32_t lane = 0; lane < LeafSlices::lanes; ++lane) {
        const PackedLeaf& leaf = slices.leaves[LeafSlices::lanes * k + lane];
        if (leaf.code == Code{}) continue;
        visit(static_cast<std::uint32_t>(LeafSlices::lanes * slice) + lane, slices.slices[slice].base, leaf);
      }
}

}  // namespace

class TestSlicedTransport : public QObject {
  Q_OBJECT

 private slots:
  void holdsEveryLeafTwice_data() {
    QTest::addColumn<QString>("scene");
    QTest::addColumn<int>("patchSide");
    for (const std::string& scene : engineSceneNames())
      for (int side : {8, 64})
        QTest::addRow("%s, %d", scene.c_str(), side) << QString::fromStdString(scene) << side;
  }
  /// The same leaves by camera pixels and by nodes, and nothing else.
  void holdsEveryLeafTwice() {
    QFETCH(QString, scene);
    QFETCH(int, patchSide);
    EngineScene made = engineSceneOf(scene.toStdString());
    const PackedTransport packed(made.venue.transport, patchSide);
    const std::size_t nodes = made.venue.transport.layout().count();
    const SlicedTransport sliced = slicedTransport(packed, nodes);
    const Leaves expected = leavesOf(packed);

    Leaves forward;
    eachLeaf(sliced.forward, [&](std::uint32_t row, std::uint32_t base, const PackedLeaf& leaf) {
      forward.emplace(std::pair{sliced.rows[row].pixel, packed.nodes()[base + leaf.column]}, leaf.code);
    });
    QVERIFY(forward == expected);

    std::vector<std::uint32_t> nodeOfSegment(LeafSlices::lanes * sliced.backward.count());
    for (std::uint32_t node = 0; node < nodes; ++node)
      for (std::uint32_t i = sliced.nodeStart[node]; i < sliced.nodeStart[node + 1]; ++i)
        nodeOfSegment[sliced.segments[i]] = node;
    Leaves backward;
    eachLeaf(sliced.backward, [&](std::uint32_t segment, std::uint32_t base, const PackedLeaf& leaf) {
      backward.emplace(std::pair{sliced.rows[base + leaf.column].pixel, nodeOfSegment[segment]}, leaf.code);
    });
    QVERIFY(backward == expected);
  }

  /// Every camera pixel has one row, with its mixing; those without leaves too.
  void rows() {
    EngineScene made = engineSceneOf("several devices");
    const PackedTransport packed(made.venue.transport, 8);
    const SlicedTransport sliced = slicedTransport(packed, made.venue.transport.layout().count());
    std::map<std::uint32_t, std::array<float, 9>> mixing;
    for (const SlicedTransport::Row& row : sliced.rows)
      if (row.pixel != SlicedTransport::noPixel) QVERIFY(mixing.emplace(row.pixel, row.mixing).second);
    QCOMPARE(mixing.size(), made.venue.usable.size());
    for (std::size_t row = 0; row < packed.pixels().size(); ++row)
      QVERIFY(std::equal(mixing[packed.pixels()[row]].begin(), mixing[packed.pixels()[row]].end(),
                         packed.mixing().begin() + static_cast<std::ptrdiff_t>(9 * row)));
  }

  /// A node that every camera pixel sees is cut into segments that no invocation works on for long.
  void longNodes() {
    const Rasters cameras(Size{120, 100}), projectors(Size{8, 8});
    const NodeLayout layout(projectors);
    BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
    const std::size_t all = layout.index({0, 3, 0, 0});
    for (std::size_t row = 0; row < cameras.count(); ++row)
      builder.add(row, all, (0.5f * ColourBlock::Identity()).eval());
    const PackedTransport packed(TransportMatrix(cameras, projectors, builder.build()), 64);
    const SlicedTransport sliced = slicedTransport(packed, layout.count());
    QCOMPARE(sliced.longNodes, std::vector<std::uint32_t>{static_cast<std::uint32_t>(all)});
    // 4 patches, each with one segment that is not full at the most.
    const std::size_t segments = sliced.nodeStart[all + 1] - sliced.nodeStart[all];
    QVERIFY(segments >= 12000 / SlicedTransport::longestSegment &&
            segments <= 12000 / SlicedTransport::longestSegment + 4);
    std::size_t held = 0;
    eachLeaf(sliced.backward, [&](auto, auto, const PackedLeaf&) { ++held; });
    QCOMPARE(held, std::size_t{12000});
  }

  void empty() {
    const SlicedTransport sliced = slicedTransport(PackedTransport(), 5);
    QCOMPARE(sliced.forward.count(), std::size_t{0});
    QCOMPARE(sliced.backward.count(), std::size_t{0});
    QCOMPARE(sliced.nodeStart, std::vector<std::uint32_t>(6, 0));
  }
};

QTEST_GUILESS_MAIN(TestSlicedTransport)
#include "test_sliced_transport.moc"
