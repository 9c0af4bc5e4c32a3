// SPDX-License-Identifier: MIT
#include "relucent/transport/row_light.h"

#include <algorithm>
#include <array>
#include <span>

#include "relucent/transport/shared_colours.h"

namespace relucent::transport {
namespace {

// As measurements share colours: see nearAndFar().
constexpr int nearLevels = 2;

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
float unevenness(const NodeLayout& layout, const Node& around, std::span<const Leaf* const> leaves) {
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
void join(const NodeLayout& layout, std::vector<Leaf>& leaves, float tolerance, std::vector<Leaf>& wider,
          std::vector<Leaf>& kept) {
  sortAndMerge(leaves);
  std::vector<std::pair<std::size_t, const Leaf*>> byParent;
  for (const Leaf& leaf : leaves) {
    const Node node = layout.node(leaf.node);
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
  Eigen::Array3f magnitude = Eigen::Array3f::Zero();
  for (const Leaf& leaf : leaves) {
    part.mixing += leaf.light;
    magnitude += leaf.light.colwise().norm().transpose().array();
  }
  for (Eigen::Index k = 0; k < 3; ++k)
    if (part.mixing.col(k).norm() < cancelledShare * magnitude[k]) part.mixing.col(k) = all.col(k);
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

std::vector<Leaf> leavesOf(const TransportMatrix& transport, std::size_t row) {
  const LeafRow blocks = transport.row(row);
  std::vector<Leaf> leaves;
  for (std::size_t entry = 0; entry < blocks.size(); ++entry)
    leaves.push_back({blocks.column(entry), blocks.block(entry)});
  return leaves;
}

/// What a camera pixel receives of all leaves, in the channel that gives most.
float lightOf(const std::vector<Leaf>& leaves) {
  ColourBlock all = ColourBlock::Zero();
  for (const Leaf& leaf : leaves) all += leaf.light;
  return received(all).maxCoeff();
}

/// `light`: what tolerances and weights are shares of.
RowLight divided(const NodeLayout& layout, const std::vector<Leaf>& leaves, float light, float tolerance) {
  std::array<std::vector<Leaf>, nearLevels + 1> levels;  // the last: all that is far
  ColourBlock all = ColourBlock::Zero();
  for (const Leaf& leaf : leaves) {
    levels[static_cast<std::size_t>(std::min(layout.node(leaf.node).level, nearLevels))].push_back(leaf);
    all += leaf.light;
  }
  std::vector<Leaf> near;
  for (std::size_t level = 0; level < nearLevels; ++level)
    join(layout, levels[level], tolerance * light, levels[level + 1], near);

  RowLight result{partOf(std::move(near), all), partOf(std::move(levels[nearLevels]), all), {}};
  if (light > 0.0f)
    for (std::size_t k = 0; k < 3; ++k)
      result.farWeight[k] = result.far.mixing.col(static_cast<Eigen::Index>(k)).cwiseAbs().sum() / light;
  return result;
}

}  // namespace

RowLight rowLight(const TransportMatrix& transport, std::size_t row, float tolerance) {
  const std::vector<Leaf> leaves = leavesOf(transport, row);
  return divided(transport.layout(), leaves, lightOf(leaves), tolerance);
}

RowLight rowLightAsShared(const TransportMatrix& transport, std::size_t row) {
  const SharedColourRow shared = transport.row(row).shared();
  const ColumnKinds& kinds = *transport.ownLeaves().sharedColours();
  RowLight result;
  for (std::size_t j = 0; j < shared.column.size(); ++j) {
    NodeShare share{shared.column[j], {}};
    for (std::size_t c = 0; c < 3; ++c)
      share.share[c] = LeafGroups::shareStep * static_cast<float>(shared.factor[j][c]);
    const bool isNear = kinds.kindOf(share.node) == nearKind(0);
    (isNear ? result.near : result.far).leaves.push_back(share);
  }
  result.near.mixing = shared.mixing[nearKind(0)] / LeafGroups::shareStep;
  result.far.mixing = shared.mixing[farKind(0)] / LeafGroups::shareStep;
  result.farWeight.fill(1.0f);
  return result;
}

std::vector<RowLight> rowLights(const TransportMatrix& transport, std::size_t row, float tolerance) {
  const NodeLayout& layout = transport.layout();
  const std::vector<Leaf> leaves = leavesOf(transport, row);
  const float light = lightOf(leaves);
  std::vector<std::vector<Leaf>> of(layout.projectors().devices());
  for (const Leaf& leaf : leaves)
    of[static_cast<std::size_t>(layout.node(leaf.node).projector)].push_back(leaf);
  std::vector<RowLight> result;
  for (const std::vector<Leaf>& ofProjector : of)
    result.push_back(divided(layout, ofProjector, light, tolerance));
  return result;
}

}  // namespace relucent::transport
