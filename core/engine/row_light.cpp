// SPDX-License-Identifier: MIT
#include "relucent/engine/row_light.h"

#include <algorithm>
#include <array>
#include <span>

namespace relucent::engine {
namespace {

using transport::ColourBlock;

// As measurements share colours: see transport::nearAndFar().
constexpr int nearLevels = 2;
// A part whose blocks, being noise, cancel to less than this of the row's light has the row's mixing.
constexpr float cancelled = 0.05f;

struct Leaf {
  std::uint32_t node = 0;
  ColourBlock light;
};

/// Per projector channel: what a camera receives of it, channels added.
Eigen::RowVector3f received(const ColourBlock& light) {
  return light.colwise().sum();
}

/// By node; leaves at the same node become one.
void sortAndMerge(std::vector<Leaf>& leaves) {
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.node < b.node; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i)
    if (count > 0 && leaves[count - 1].node == leaves[i].node)
      leaves[count - 1].light += leaves[i].light;
    else
      leaves[count++] = leaves[i];
  leaves.resize(count);
}

/// How far leaves within one node are from having its light evenly, as the cameras' channels receive it
/// together.
float unevenness(const transport::NodeLayout& layout, const transport::Node& around,
                 std::span<const Leaf* const> leaves) {
  ColourBlock sum = ColourBlock::Zero();
  for (const Leaf* leaf : leaves) sum += leaf->light;
  const auto whole = static_cast<float>(layout.block(around).count());
  float most = 0.0f, dark = 1.0f;  // where there is no leaf
  for (const Leaf* leaf : leaves) {
    const float share = static_cast<float>(layout.block(layout.node(leaf->node)).count()) / whole;
    dark -= share;
    most = std::max(most, received(leaf->light - share * sum).cwiseAbs().maxCoeff());
  }
  return std::max(most, received(dark * sum).cwiseAbs().maxCoeff());
}

/// Of the leaves of one level, those that are alike within the node around them go on as one leaf of `wider`,
/// the others to `kept`.
void join(const transport::NodeLayout& layout, std::vector<Leaf>& leaves, float tolerance,
          std::vector<Leaf>& wider, std::vector<Leaf>& kept) {
  sortAndMerge(leaves);
  std::vector<std::pair<std::size_t, const Leaf*>> byParent;
  for (const Leaf& leaf : leaves) {
    const transport::Node node = layout.node(leaf.node);
    if (node.level + 1 < layout.levels(static_cast<std::size_t>(node.projector)))
      byParent.push_back({layout.index(layout.parent(node)), &leaf});
    else
      kept.push_back(leaf);
  }
  std::sort(byParent.begin(), byParent.end());
  std::vector<const Leaf*> brothers;
  for (std::size_t begin = 0, end = 0; begin < byParent.size(); begin = end) {
    const std::size_t parent = byParent[begin].first;
    brothers.clear();
    for (end = begin; end < byParent.size() && byParent[end].first == parent; ++end)
      brothers.push_back(byParent[end].second);
    const bool alike = unevenness(layout, layout.node(parent), brothers) <= tolerance;
    Leaf sum{static_cast<std::uint32_t>(parent), ColourBlock::Zero()};
    for (const Leaf* leaf : brothers)
      if (alike)
        sum.light += leaf->light;
      else
        kept.push_back(*leaf);
    if (alike) wider.push_back(sum);
  }
}

LightPart partOf(std::vector<Leaf> leaves, const ColourBlock& all) {
  sortAndMerge(leaves);
  LightPart part;
  for (const Leaf& leaf : leaves) part.mixing += leaf.light;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (part.mixing.col(k).norm() < cancelled * all.col(k).norm()) part.mixing.col(k) = all.col(k);
  const Eigen::RowVector3f square = part.mixing.colwise().squaredNorm();
  for (const Leaf& leaf : leaves) {
    NodeShare share{leaf.node, {}};
    const Eigen::RowVector3f along = part.mixing.cwiseProduct(leaf.light).colwise().sum();
    for (Eigen::Index k = 0; k < 3; ++k)
      if (square[k] > 0.0f) share.share[static_cast<std::size_t>(k)] = along[k] / square[k];
    part.leaves.push_back(share);
  }
  return part;
}

}  // namespace

RowLight rowLight(const transport::TransportMatrix& transport, std::size_t row, float tolerance) {
  const transport::BlockSparse& blocks = transport.leaves();
  const transport::NodeLayout& layout = transport.layout();
  std::array<std::vector<Leaf>, nearLevels + 1> levels;  // the last: all that is far
  ColourBlock all = ColourBlock::Zero();
  for (std::size_t entry = blocks.rowBegin(row); entry < blocks.rowBegin(row + 1); ++entry) {
    const std::uint32_t column = blocks.column(entry);
    const int level = std::min(layout.node(column).level, nearLevels);
    levels[static_cast<std::size_t>(level)].push_back({column, blocks.block(row, entry)});
    all += levels[static_cast<std::size_t>(level)].back().light;
  }

  const float light = received(all).maxCoeff();
  std::vector<Leaf> near;
  for (std::size_t level = 0; level < nearLevels; ++level)
    join(layout, levels[level], tolerance * light, levels[level + 1], near);

  RowLight result{partOf(std::move(near), all), partOf(std::move(levels[nearLevels]), all), {}};
  if (light > 0.0f)
    for (std::size_t k = 0; k < 3; ++k)
      result.farWeight[k] = result.far.mixing.col(static_cast<Eigen::Index>(k)).cwiseAbs().sum() / light;
  return result;
}

}  // namespace relucent::engine
