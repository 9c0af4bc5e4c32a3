// SPDX-License-Identifier: MIT
#include "relucent/transport/shared_light.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/engine/engine_scenes.h"
#include "relucent/transport/row_light.h"

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

constexpr std::size_t pixels = SharedLight::pixels;
constexpr float rounding = 1e-5f;  // of sums of floats around 1

using Rows = std::vector<std::vector<NodeShare>>;

/// What every projector pixel has of the light, spread evenly over nodes.
std::vector<Channels> spread(const NodeLayout& layout, const std::vector<NodeShare>& leaves) {
  std::vector<Channels> light(layout.projectors().count(), Channels{});
  for (const NodeShare& leaf : leaves) {
    const Node node = layout.node(leaf.node);
    const Block block = layout.block(node);
    const auto projector = static_cast<std::size_t>(node.projector);
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x) {
        Channels& at = light[layout.projectors().offset(projector) +
                             indexOf(layout.projectors().size(projector), {x, y})];
        for (std::size_t c = 0; c < 3; ++c) at[c] += leaf.share[c] / static_cast<float>(block.count());
      }
  }
  return light;
}

std::vector<NodeShare> seenBy(const SharedLight& shared, std::size_t pixel) {
  std::vector<NodeShare> leaves = shared.own[pixel];
  for (std::uint32_t g = shared.groupOf[pixel]; g != LightGroup::none; g = shared.groups[g].parent)
    leaves.insert(leaves.end(), shared.groups[g].leaves.begin(), shared.groups[g].leaves.end());
  return leaves;
}

std::size_t leavesOf(const SharedLight& shared) {
  std::size_t count = 0;
  for (const LightGroup& group : shared.groups) count += group.leaves.size();
  for (const std::vector<NodeShare>& own : shared.own) count += own.size();
  return count;
}

/// Quadtrees that differ a little from pixel to pixel, of two projectors, the second of odd size.
NodeLayout twoProjectors() {
  return NodeLayout(Rasters({{32, 32}, {13, 7}}));
}

void divide(const NodeLayout& layout, const Node& node, Random& random, float light,
            std::vector<NodeShare>& to) {
  if (node.level > 2 && random.uniformFloat() < 0.6f) {
    for (const Node& child : layout.children(node)) divide(layout, child, random, 0.3f * light, to);
    return;
  }
  NodeShare leaf{static_cast<std::uint32_t>(layout.index(node)), {}};
  for (float& share : leaf.share) share = light * (random.uniformFloat() - 0.1f);
  to.push_back(leaf);
}

Rows unlikeRows(const NodeLayout& layout, std::uint64_t seed) {
  Rows rows(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    Random random{seed, i / 16};  // 4x4 pixels are alike but for some noise
    for (int projector = 0; projector < 2; ++projector)
      divide(layout, {projector, layout.levels(static_cast<std::size_t>(projector)) - 1, 0, 0}, random, 1.0f,
             rows[i]);
    Random noise{seed, 1000 + i};
    for (NodeShare& leaf : rows[i])
      for (float& share : leaf.share) share += 0.01f * (noise.uniformFloat() - 0.5f);
  }
  return rows;
}

/// Whether a node is, or is within, one that has a leaf.
bool isWithin(const NodeLayout& layout, Node node, const std::vector<NodeShare>& leaves) {
  for (;; node = layout.parent(node)) {
    const auto index = static_cast<std::uint32_t>(layout.index(node));
    if (std::ranges::any_of(leaves, [&](const NodeShare& leaf) { return leaf.node == index; })) return true;
    if (node.level + 1 == layout.levels(static_cast<std::size_t>(node.projector))) return false;
  }
}

/// The largest difference of a node's light, weighted, over the leaves of `shared` and what of `exact` is
/// within them.
float mostApart(const NodeLayout& layout, const std::vector<NodeShare>& exact,
                const std::vector<NodeShare>& shared, const Channels& weight) {
  const std::vector<Channels> a = spread(layout, exact), b = spread(layout, shared);
  float most = 0.0f;
  for (const std::vector<NodeShare>* leaves : {&exact, &shared})
    for (const NodeShare& leaf : *leaves) {
      const Node node = layout.node(leaf.node);
      if (!isWithin(layout, node, shared)) continue;
      const Block block = layout.block(node);
      const auto projector = static_cast<std::size_t>(node.projector);
      Channels apart{};
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) {
          const std::size_t j =
              layout.projectors().offset(projector) + indexOf(layout.projectors().size(projector), {x, y});
          for (std::size_t c = 0; c < 3; ++c) apart[c] += a[j][c] - b[j][c];
        }
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, weight[c] * std::abs(apart[c]));
    }
  return most;
}

}  // namespace

class TestSharedLight : public QObject {
  Q_OBJECT

 private slots:
  void staysWithinTheTolerance_data() {
    QTest::addColumn<float>("tolerance");
    QTest::addColumn<int>("seed");
    for (float tolerance : {0.0f, 0.003f, 0.02f, 0.1f})
      for (int seed : {1, 2, 3})
        QTest::addRow("%g, seed %d", static_cast<double>(tolerance), seed) << tolerance << seed;
  }
  /// Every camera pixel sees what it saw, to the tolerance within every leaf, in at most as many leaves; the
  /// more is tolerated, the fewer. Nothing tolerated: the same light everywhere.
  void staysWithinTheTolerance() {
    QFETCH(float, tolerance);
    QFETCH(int, seed);
    const NodeLayout layout = twoProjectors();
    const Rows rows = unlikeRows(layout, static_cast<std::uint64_t>(seed));
    std::vector<Channels> weight(pixels, Channels{0.5f, 1.0f, 0.25f});
    const SharedLight shared = shareLight(layout, rows, weight, tolerance);
    std::size_t before = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      before += rows[i].size();
      QVERIFY(mostApart(layout, rows[i], seenBy(shared, i), weight[i]) <= tolerance + rounding);
      if (tolerance > 0.0f) continue;
      const std::vector<Channels> seen = spread(layout, seenBy(shared, i)), exact = spread(layout, rows[i]);
      for (std::size_t j = 0; j < seen.size(); ++j)
        for (std::size_t c = 0; c < 3; ++c) QVERIFY(std::abs(seen[j][c] - exact[j][c]) <= rounding);
    }
    QVERIFY(leavesOf(shared) <= before);
    QVERIFY(leavesOf(shareLight(layout, rows, weight, tolerance + 0.05f)) < leavesOf(shared));
  }

  /// What all see alike is there once, for all of them.
  void alikeIsSharedByAll() {
    const NodeLayout layout = twoProjectors();
    const Rows rows(pixels, unlikeRows(layout, 5).front());
    const SharedLight shared =
        shareLight(layout, rows, std::vector<Channels>(pixels, {1.0f, 1.0f, 1.0f}), rounding);
    QCOMPARE(shared.groups.size(), std::size_t{1});
    QCOMPARE(shared.groups[0].begin, std::size_t{0});
    QCOMPARE(shared.groups[0].end, pixels);
    QCOMPARE(leavesOf(shared), rows[0].size());
    for (std::uint32_t group : shared.groupOf) QCOMPARE(group, 0u);
  }

  /// Where there is no camera pixel, or none that counts, neighbours need not differ.
  void whatHasNoWeightIsLikeItsNeighbours() {
    const NodeLayout layout = twoProjectors();
    Rows rows(pixels, unlikeRows(layout, 6).front());
    std::vector<Channels> weight(pixels, {1.0f, 1.0f, 1.0f});
    rows[10].clear();
    weight[10] = {};
    rows[50] = unlikeRows(layout, 7).front();
    weight[50] = {};
    const SharedLight shared = shareLight(layout, rows, weight, rounding);
    QCOMPARE(shared.groups.size(), std::size_t{1});
    QCOMPARE(leavesOf(shared), rows[0].size());
  }

  void nothingIsNothing() {
    const SharedLight shared =
        shareLight(twoProjectors(), Rows(pixels), std::vector<Channels>(pixels, Channels{}), 0.0f);
    QCOMPARE(shared.groups.size(), std::size_t{0});
    QCOMPARE(leavesOf(shared), std::size_t{0});
  }

  /// Blocks of 2^n x 2^n pixels are ranges of places.
  void places() {
    for (int side : {1, 2, 4, 8})
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          QCOMPARE(
              SharedLight::placeOf(x, y) / static_cast<std::size_t>(side * side),
              SharedLight::placeOf(x / side * side, y / side * side) / static_cast<std::size_t>(side * side));
    std::vector<std::size_t> all;
    for (int i = 0; i < 64; ++i) all.push_back(SharedLight::placeOf(i % 8, i / 8));
    std::sort(all.begin(), all.end());
    for (std::size_t i = 0; i < 64; ++i) QCOMPARE(all[i], i);
  }

  void rowsInTwoParts_data() {
    QTest::addColumn<QString>("scene");
    for (const std::string& scene : engineSceneNames())
      QTest::addRow("%s", scene.c_str()) << QString::fromStdString(scene);
  }
  /// Near and far light together are the row's, and leaves that stand for four are within the tolerance.
  void rowsInTwoParts() {
    QFETCH(QString, scene);
    const compensation::MeasuredVenue venue = engineSceneOf(scene.toStdString()).venue;
    const TransportMatrix& transport = venue.transport;
    const std::vector<ColourBlock> sums = transport.rowSums();
    for (std::size_t row = 0; row < transport.cameras().count(); ++row) {
      std::size_t before = 0;
      for (float tolerance : {0.0f, 0.02f}) {
        const RowLight light = rowLight(transport, row, tolerance);
        ColourBlock sum = ColourBlock::Zero();
        for (const LightPart* part : {&light.near, &light.far})
          for (const NodeShare& leaf : part->leaves)
            sum += part->mixing * Eigen::Vector3f(leaf.share[0], leaf.share[1], leaf.share[2]).asDiagonal();
        const float bright = sums[row].cwiseAbs().maxCoeff();
        QVERIFY((sum - sums[row]).cwiseAbs().maxCoeff() <= 1e-3f * bright + 1e-9f);
        for (const NodeShare& leaf : light.near.leaves) QVERIFY(transport.layout().node(leaf.node).level < 2);
        for (const NodeShare& leaf : light.far.leaves) {
          const Node node = transport.layout().node(leaf.node);
          QVERIFY(node.level >= 2);
        }
        const std::size_t leaves = light.near.leaves.size() + light.far.leaves.size();
        if (tolerance > 0.0f) QVERIFY(leaves <= before);
        before = leaves;
      }
    }
  }

  /// Four pixels within the tolerance of their mean become one node; a brighter one among them stays.
  void joinsWhatIsAlike() {
    const NodeLayout layout{Rasters(Size{8, 8})};
    BlockSparseBuilder builder(layout.count(), {1.0f});
    auto add = [&](int x, int y, float light) {
      builder.add(0, layout.index({0, 0, x, y}), (light * ColourBlock::Identity()).eval());
    };
    for (int i = 0; i < 4; ++i) {
      add(i % 2, i / 2, 0.100f + 0.001f * static_cast<float>(i));  // alike
      add(2 + i % 2, i / 2, i == 3 ? 0.3f : 0.0999f);              // one is not
    }
    add(4, 4, 0.004f);  // dim: its three neighbours are dark
    const TransportMatrix transport(Size{1, 1}, Size{8, 8}, builder.build());
    const RowLight light = rowLight(transport, 0, 0.005f);
    std::vector<std::pair<int, int>> levels;  // level and place
    for (const LightPart* part : {&light.near, &light.far})
      for (const NodeShare& leaf : part->leaves) {
        const Node node = layout.node(leaf.node);
        levels.push_back({node.level, node.x});
      }
    std::sort(levels.begin(), levels.end());
    // The dim one goes up to four pixels' width, where its light is far.
    const std::vector<std::pair<int, int>> expected{{0, 2}, {0, 2}, {0, 3}, {0, 3}, {1, 0}, {2, 1}};
    QVERIFY(levels == expected);
  }
};

QTEST_GUILESS_MAIN(TestSharedLight)
#include "test_shared_light.moc"
