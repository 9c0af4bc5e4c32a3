// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/division.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "relucent/base/parallel.h"

namespace relucent::multiplexing {
namespace {

bool isStrong(const Leaf& leaf, float threshold, const DivisionSettings& settings) {
  return leaf.light > std::max(threshold, settings.sigmas * leaf.deviation);
}

/// The light of the leaf at a node, if it is strong there.
float strongLight(const Row& row, std::uint32_t node, float threshold, const DivisionSettings& settings) {
  auto found = std::lower_bound(row.leaves.begin(), row.leaves.end(), node,
                                [](const Leaf& leaf, std::uint32_t wanted) { return leaf.node < wanted; });
  bool there = found != row.leaves.end() && found->node == node;
  return there && isStrong(*found, threshold, settings) ? found->light : 0.0f;
}

/// Up to four camera pixels beside one, of the same camera.
std::vector<std::size_t> beside(const Rasters& cameras, std::size_t camera, Pixel at) {
  Size size = cameras.size(camera);
  std::vector<std::size_t> found;
  for (auto [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    Pixel other{at.x + dx, at.y + dy};
    if (other.x >= 0 && other.y >= 0 && other.x < size.width && other.y < size.height)
      found.push_back(cameras.offset(camera) + indexOf(size, other));
  }
  return found;
}

void addChildren(std::vector<Leaf>& leaves, const Leaf& leaf, float threshold,
                 const transport::NodeLayout& layout) {
  transport::Node node = layout.node(leaf.node);
  auto area = static_cast<float>(layout.block(node).count());
  float light = std::max(0.0f, leaf.light);
  for (const transport::Node& child : layout.children(node)) {
    float share = static_cast<float>(layout.block(child).count()) / area;
    float spread = 0.6f * std::max(light, 0.5f * threshold) * std::sqrt(share) + leaf.deviation * share;
    leaves.push_back(
        {static_cast<std::uint32_t>(layout.index(child)), light * share, spread, light * share, spread});
  }
}

/// A leaf and what becomes of it.
struct Candidate {
  std::size_t parent;
  std::size_t leaf;
  bool followed;
};

/// Joins what `candidates` of one parent, all of its children, measured.
void addParent(std::vector<Leaf>& leaves, std::size_t parent, const std::vector<Leaf>& row,
               std::span<const Candidate> children) {
  Leaf joined{static_cast<std::uint32_t>(parent)};
  float variance = 0.0f;
  for (const Candidate& child : children) {
    joined.light += row[child.leaf].light;
    variance += row[child.leaf].deviation * row[child.leaf].deviation;
  }
  joined.deviation = std::sqrt(variance);
  joined.spread = std::hypot(joined.light, joined.deviation);
  leaves.push_back(joined);
}

}  // namespace

void divide(std::vector<Row>& rows, const Rasters& cameras, const transport::NodeLayout& layout, int level,
            const std::vector<float>& thresholds, const DivisionSettings& settings) {
  std::vector<std::vector<Leaf>> divided(rows.size());
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    parallelFor(0, cameras.size(camera).count(), 256, [&](std::size_t pixel) {
      std::size_t row = cameras.offset(camera) + pixel;
      std::vector<std::size_t> others = beside(cameras, camera, pixelAt(cameras.size(camera), pixel));
      std::vector<Leaf>& leaves = divided[row];
      leaves.reserve(rows[row].leaves.size());
      std::vector<Candidate> candidates;
      for (std::size_t i = 0; i < rows[row].leaves.size(); ++i) {
        const Leaf& leaf = rows[row].leaves[i];
        transport::Node node = layout.node(leaf.node);
        if (node.level != level) {
          leaves.push_back(leaf);
          continue;
        }
        bool follow = isStrong(leaf, thresholds[row], settings);
        float sum = 0.0f;
        for (std::size_t other : others)
          if (!follow) sum += strongLight(rows[other], leaf.node, thresholds[other], settings);
        follow = follow || sum > 4.0f * settings.neighbours * thresholds[row];
        bool root = node.level + 1 >= layout.levels(static_cast<std::size_t>(node.projector));
        candidates.push_back({root ? layout.count() : layout.index(layout.parent(node)), i, follow});
      }
      std::stable_sort(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.parent < b.parent; });
      for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
        float light = 0.0f;
        bool followed = false;
        for (; end < candidates.size() && candidates[end].parent == candidates[begin].parent; ++end) {
          light += std::abs(rows[row].leaves[candidates[end].leaf].light);
          followed = followed || candidates[end].followed;
        }
        std::span<const Candidate> siblings(&candidates[begin], end - begin);
        if (!followed && light < settings.joined * thresholds[row] && siblings[0].parent < layout.count() &&
            siblings.size() == layout.children(layout.node(siblings[0].parent)).size()) {
          addParent(leaves, siblings[0].parent, rows[row].leaves, siblings);
          continue;
        }
        for (const Candidate& sibling : siblings) {
          const Leaf& leaf = rows[row].leaves[sibling.leaf];
          if (sibling.followed && level > 0)
            addChildren(leaves, leaf, thresholds[row], layout);
          else
            leaves.push_back(leaf);
        }
      }
      std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.node < b.node; });
    });
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row].leaves = std::move(divided[row]);
}

}  // namespace relucent::multiplexing
