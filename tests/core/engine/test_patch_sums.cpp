// SPDX-License-Identifier: MIT
#include "relucent/engine/patch_sums.h"

#include <QtTest>
#include <algorithm>
#include <limits>

#include "core/engine/engine_scenes.h"
#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::transport;
using namespace relucent::synthetic;

class TestPatchSums : public QObject {
  Q_OBJECT

 private slots:
  void sumsInTheOrderOfPatches_data() {
    QTest::addColumn<QString>("scene");
    QTest::addColumn<int>("side");
    for (const std::string& scene : engineSceneNames())
      for (int side : {8, 13, 256})
        QTest::addRow("%s, patches of %d", scene.c_str(), side) << QString::fromStdString(scene) << side;
  }
  /// To the last bit what adding patch after patch gives, whoever hands over first and whatever was there.
  void sumsInTheOrderOfPatches() {
    QFETCH(QString, scene);
    QFETCH(int, side);
    const MeasuredVenue venue = engineSceneOf(scene.toStdString()).venue;
    const PackedTransport packed(venue.transport, {side});
    const std::size_t nodes = venue.transport.layout().count();
    const PatchSums patchSums(packed, nodes);
    QVERIFY(patchSums.places() <= packed.nodes().size());

    constexpr std::size_t stride = 5;
    Random random{7};
    std::vector<float> columns(stride * packed.nodes().size());
    for (float& value : columns) value = random.uniformFloat() - 0.5f;
    std::vector<float> expected(sumFloats * nodes, 0.0f);
    for (std::size_t column = 0; column < packed.nodes().size(); ++column)
      for (std::size_t c = 0; c < sumFloats; ++c)
        expected[sumFloats * packed.nodes()[column] + c] += columns[stride * column + c];

    const float left = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> sums(sumFloats * nodes, left), waiting(sumFloats * patchSums.places(), left);
    for (std::size_t patch = packed.patches().size(); patch-- > 0;)
      patchSums.addPatch(patch, columns.data() + stride * packed.patches()[patch].columnBegin, stride,
                         sums.data(), waiting.data());
    patchSums.addStored(waiting.data(), sums.data());
    QVERIFY(sums == expected);
  }

  void aSinglePatchWaitsForNobody() {
    const MeasuredVenue venue = engineSceneOf("wall").venue;
    const PackedTransport packed(venue.transport, {256});
    QCOMPARE(packed.patches().size(), std::size_t{1});
    QCOMPARE(PatchSums(packed, venue.transport.layout().count()).places(), std::size_t{0});
  }

  void withoutLeavesThereIsNothing() {
    NodeLayout layout{Rasters(Size{4, 4})};
    TransportMatrix transport(Size{3, 2}, Size{4, 4},
                              BlockSparseBuilder(layout.count(), std::vector<float>(6, 0.0f)).build());
    const PackedTransport packed(transport, {8});
    const PatchSums patchSums(packed, layout.count());
    std::vector<float> sums(sumFloats * layout.count(), 3.0f);
    patchSums.addPatch(0, nullptr, 4, sums.data(), nullptr);
    patchSums.addStored(nullptr, sums.data());
    QVERIFY(std::all_of(sums.begin(), sums.end(), [](float sum) { return sum == 0.0f; }));
  }
};

QTEST_GUILESS_MAIN(TestPatchSums)
#include "test_patch_sums.moc"
