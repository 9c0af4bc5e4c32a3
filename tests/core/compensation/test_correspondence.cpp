// SPDX-License-Identifier: MIT
#include "relucent/compensation/correspondence.h"

#include <QtTest>
#include <algorithm>

#include "core/inverse/synthetic_transport.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

Progress quiet;

struct Light {
  std::size_t row;
  Node node;
  float light;  // per projector pixel of the block
};

/// A camera of 4 pixels before a projector of 128 x 96 (a reach of 4 pixels).
TransportMatrix venueOf(const std::vector<Light>& lights) {
  constexpr std::size_t rows = 4;
  NodeLayout layout{Size{128, 96}};
  std::vector<float> most(rows, 0.0f);
  auto sum = [&](const Light& l) { return l.light * static_cast<float>(layout.block(l.node).count()); };
  for (const Light& l : lights) most[l.row] = std::max(most[l.row], sum(l));
  BlockSparseBuilder builder(layout.count(), most);
  for (const Light& l : lights)
    builder.add(l.row, layout.index(l.node), (sum(l) * ColourBlock::Identity()).eval());
  return TransportMatrix(Size{4, 1}, Size{128, 96}, builder.build());
}

std::int32_t of(const TransportMatrix& transport, Pixel pixel, CameraMask usable = {1, 1, 1, 1}) {
  return brightestCorrespondence(transport, usable, {})[indexOf({128, 96}, pixel)];
}

}  // namespace

class TestCorrespondence : public QObject {
  Q_OBJECT

 private slots:
  void theBrightestCameraPixelWins() {
    TransportMatrix t = venueOf({{1, {0, 0, 40, 40}, 0.5f}, {2, {0, 0, 40, 40}, 0.8f}});
    QCOMPARE(of(t, {40, 40}), 2);
    QCOMPARE(of(t, {40, 40}, {1, 1, 0, 1}), 1);
    QCOMPARE(of(t, {41, 40}), -1);
  }

  /// The same pixels whatever order the cores come in.
  void ofEqualsTheFirstRowWins() {
    TransportMatrix t =
        venueOf({{1, {0, 0, 40, 40}, 0.5f}, {2, {0, 0, 40, 40}, 0.5f}, {3, {0, 0, 40, 40}, 0.5f}});
    QCOMPARE(of(t, {40, 40}), 1);
    QCOMPARE(of(t, {40, 40}, {1, 0, 1, 1}), 2);
  }

  /// A white square that the camera does not see must not be projected: its glow is no place for content.
  void glowHasNoPlace_data() {
    QTest::addColumn<int>("level");
    QTest::addColumn<int>("x");
    QTest::addColumn<int>("expected");
    QTest::newRow("beside the place") << 0 << 43 << 0;
    QTest::newRow("a place elsewhere") << 0 << 80 << -1;
    QTest::newRow("a wide block") << 3 << 5 << -1;
  }
  void glowHasNoPlace() {
    QFETCH(int, level);
    QFETCH(int, x);
    QFETCH(int, expected);
    TransportMatrix t = venueOf({{0, {0, 0, 40, 40}, 1.0f}, {0, {0, level, x, 40 >> level}, 0.2f}});
    QCOMPARE(of(t, {40, 40}), 0);
    QCOMPARE(of(t, {(x << level) + 1 - (level == 0), 40}), expected);
  }

  void faintLightHasNoPlace() {
    TransportMatrix t =
        venueOf({{0, {0, 0, 40, 40}, 1.0f}, {0, {0, 0, 41, 40}, 0.02f}, {0, {0, 0, 42, 40}, 0.005f}});
    QCOMPARE(of(t, {41, 40}), 0);
    QCOMPARE(of(t, {42, 40}), -1);
  }

  void agreesWithALiteralSearch_data() {
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 4; ++seed) QTest::addRow("seed %d", seed) << seed;
  }
  /// Among the leaves of directPart(), which is tested by itself.
  void agreesWithALiteralSearch() {
    QFETCH(int, seed);
    SceneSettings s;
    s.seed = static_cast<std::uint64_t>(seed);
    Scene scene = makeScene(s);
    const TransportMatrix& t = scene.transport;
    CameraMask usable(t.cameras().count());
    for (std::size_t i = 0; i < usable.size(); ++i) usable[i] = i % 7 != static_cast<std::size_t>(seed);

    TransportMatrix direct = directPart(t, {}, quiet);
    std::vector<float> best(t.projectors().count(), 0.0f);
    std::vector<std::int32_t> expected(best.size(), -1);
    const BlockSparse& leaves = direct.ownLeaves();
    auto light = [&](std::size_t row, std::size_t entry) {
      return leaves.block(row, entry).sum() /
             static_cast<float>(t.layout().block(t.layout().node(leaves.column(entry))).count());
    };
    for (std::size_t row = 0; row < leaves.rows(); ++row) {
      if (!usable[row]) continue;
      float most = 0.0f;
      for (std::size_t e = leaves.rowBegin(row); e < leaves.rowBegin(row + 1); ++e)
        most = std::max(most, light(row, e));
      for (std::size_t e = leaves.rowBegin(row); e < leaves.rowBegin(row + 1); ++e) {
        if (light(row, e) < 0.01f * most) continue;
        Block block = t.layout().block(t.layout().node(leaves.column(e)));
        for (int y = block.y0; y < block.y1; ++y)
          for (int x = block.x0; x < block.x1; ++x)
            if (std::size_t j = indexOf(t.projectors().size(0), {x, y}); light(row, e) > best[j]) {
              best[j] = light(row, e);
              expected[j] = static_cast<std::int32_t>(row);
            }
      }
    }
    QVERIFY(std::count(expected.begin(), expected.end(), -1) <
            static_cast<std::ptrdiff_t>(expected.size() / 2));
    QCOMPARE(brightestCorrespondence(t, usable, {}), expected);
  }

  void onlyContentIsFree() {
    Target target;
    target.inside = {0, 1};
    QCOMPARE(contentPixels({-1, 0, 1, 1}, target), (std::vector<std::uint8_t>{0, 0, 1, 1}));
  }
};

QTEST_GUILESS_MAIN(TestCorrespondence)
#include "test_correspondence.moc"
