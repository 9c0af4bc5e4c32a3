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
/// What sends back to a leaf: a camera pixel, or a group, for which its first camera pixel stands.
struct Receiver {
  std::uint32_t pixel = 0;
  std::uint32_t ofGroup = 0;  // camera pixels of the group; 0: one alone
  auto operator<=>(const Receiver&) const = default;
};
/// (receiver, node) -> codes. Leaves with codes 0 say nothing.
using Leaves = std::multimap<std::pair<Receiver, std::uint32_t>, Code>;

Receiver receiverOf(const PackedTransport& packed, std::uint32_t rowBegin, std::uint32_t rowEnd) {
  return {packed.rows()[rowBegin].pixel, rowEnd - rowBegin};
}

Leaves leavesOf(const PackedTransport& packed) {
  Leaves all;
  for (const TransportPatch& patch : packed.patches()) {
    auto add = [&](const Receiver& receiver, const std::vector<PackedLeaf>& leaves) {
      for (const PackedLeaf& leaf : leaves)
        if (leaf.code != Code{})
          all.emplace(std::pair{receiver, packed.nodes()[patch.columnBegin + leaf.column]}, leaf.code);
    };
    for (std::uint32_t g = patch.groupBegin; g < patch.groupEnd; ++g) {
      const PackedGroup& group = packed.groups()[g];
      add(receiverOf(packed, group.rowBegin, group.rowEnd), packed.leavesOf(group));
    }
    for (std::uint32_t r = patch.rowBegin; r < patch.rowEnd; ++r) {
      const PackedRow& row = packed.rows()[r];
      add({row.pixel, 0}, packed.leavesOf(row));
    }
  }
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
    const PackedTransport packed(made.venue.transport, {patchSide});
    const std::size_t nodes = made.venue.transport.layout().count();
    const SlicedTransport sliced = slicedTransport(packed, nodes);
    const Leaves expected = leavesOf(packed);

    Leaves forward;
    std::map<std::uint32_t, Receiver> receivers;  // by the place where it goes back
    auto add = [&](const Receiver& receiver, std::uint32_t base, const PackedLeaf& leaf) {
      forward.emplace(std::pair{receiver, packed.nodes()[base + leaf.column]}, leaf.code);
    };
    for (const SlicedTransport::Group& group : sliced.groups)
      if (group.back != SlicedTransport::none)
        QVERIFY(receivers.emplace(group.back, receiverOf(packed, group.rowBegin, group.rowEnd)).second);
    for (const SlicedTransport::Row& row : sliced.rows) {
      if (row.pixel == SlicedTransport::none) continue;
      QVERIFY(receivers.emplace(row.back, Receiver{row.pixel, 0}).second);
    }
    eachLeaf(sliced.forward, [&](std::uint32_t slot, std::uint32_t base, const PackedLeaf& leaf) {
      add({sliced.rows[slot].pixel, 0}, base, leaf);
    });
    eachLeaf(sliced.groupForward, [&](std::uint32_t slot, std::uint32_t base, const PackedLeaf& leaf) {
      add(receiverOf(packed, sliced.groups[slot].rowBegin, sliced.groups[slot].rowEnd), base, leaf);
    });
    QVERIFY(forward == expected);

    std::vector<std::uint32_t> nodeOfSegment(LeafSlices::lanes * sliced.backward.count());
    for (std::uint32_t node = 0; node < nodes; ++node)
      for (std::uint32_t i = sliced.nodeStart[node]; i < sliced.nodeStart[node + 1]; ++i)
        nodeOfSegment[sliced.segments[i]] = node;
    Leaves backward;
    eachLeaf(sliced.backward, [&](std::uint32_t segment, std::uint32_t base, const PackedLeaf& leaf) {
      backward.emplace(std::pair{receivers.at(base + leaf.column), nodeOfSegment[segment]}, leaf.code);
    });
    QVERIFY(backward == expected);
  }

  /// Every camera pixel has one row, with its mixings and its group; those without leaves too.
  void rows() {
    EngineScene made = engineSceneOf("several devices");
    const PackedTransport packed(made.venue.transport, {8});
    const SlicedTransport sliced = slicedTransport(packed, made.venue.transport.layout().count());
    std::map<std::uint32_t, SlicedTransport::Row> rows;
    for (const SlicedTransport::Row& row : sliced.rows)
      if (row.pixel != SlicedTransport::none) QVERIFY(rows.emplace(row.pixel, row).second);
    QCOMPARE(rows.size(), made.venue.usable.size());
    QVERIFY(!packed.groups().empty());
    for (std::size_t r = 0; r < packed.rows().size(); ++r) {
      const PackedRow& packedRow = packed.rows()[r];
      const SlicedTransport::Row& row = rows.at(packedRow.pixel);
      QCOMPARE(ColourBlock(Eigen::Map<const ColourBlock>(row.own.data())), packed.ownMixing(packedRow));
      QCOMPARE(ColourBlock(Eigen::Map<const ColourBlock>(row.shared.data())), packed.sharedMixing(packedRow));
      QCOMPARE(sliced.groupBack[r], row.back + 1);
      std::uint32_t slot = row.group, group = packedRow.group;
      for (; group != PackedGroup::none;
           group = packed.groups()[group].parent, slot = sliced.groups[slot].parent) {
        QVERIFY(slot != SlicedTransport::none);
        QCOMPARE(sliced.groups[slot].rowBegin, packed.groups()[group].rowBegin);
        QCOMPARE(sliced.groups[slot].rowEnd, packed.groups()[group].rowEnd);
        QCOMPARE(sliced.groups[slot].scale, packed.groups()[group].scale);
      }
      QCOMPARE(slot, SlicedTransport::none);
    }
  }

  /// A node that every camera pixel sees is cut into segments that no invocation works on for long.
  void longNodes() {
    const Rasters cameras(Size{120, 100}), projectors(Size{8, 8});
    const NodeLayout layout(projectors);
    BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
    const std::size_t all = 5;  // light of single pixels is nobody's but a camera pixel's own
    for (std::size_t row = 0; row < cameras.count(); ++row)
      builder.add(row, all, (0.5f * ColourBlock::Identity()).eval());
    const PackedTransport packed(TransportMatrix(cameras, projectors, builder.build()), {64});
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
