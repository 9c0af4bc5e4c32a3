// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/division.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "relucent/base/parallel.h"

namespace relucent::multiplexing {
namespace {

bool isStrong(const Leaf& leaf, float threshold, const DivisionSettings& settings) {
  return leaf.light > std::max(threshold, settings.sigmas * leaf.deviation);
}

/// The light of the leaf at a node, if it is strong there.
float strongLight(std::span<const Leaf> leaves, std::uint32_t node, float threshold,
                  const DivisionSettings& settings) {
  auto found = std::lower_bound(leaves.begin(), leaves.end(), node,
                                [](const Leaf& leaf, std::uint32_t wanted) { return leaf.node < wanted; });
  bool there = found != leaves.end() && found->node == node;
  if (!there || !isStrong(*found, threshold, settings)) return 0.0f;
  return found->light;
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
  float light = std::max<float>(0.0f, leaf.light);
  for (const transport::Node& child : layout.children(node)) {
    float share = static_cast<float>(layout.block(child).count()) / area;
    float spread = 0.6f * std::max(light, 0.5f * threshold) * std::sqrt(share) + leaf.deviation * share;
    leaves.push_back(
        {static_cast<std::uint32_t>(layout.index(child)), light * share, spread, light * share, spread});
  }
}

/// Which leaves of a level are divided, for all rows: dividing one row looks at those beside it, as they
/// were.
class Followed {
 public:
  explicit Followed(const Rows& rows) : begin_(rows.size() + 1, 0) {
    for (std::size_t row = 0; row < rows.size(); ++row)
      begin_[row + 1] = begin_[row] + rows.leavesOf(row).size();
    flags_.resize(begin_.back(), 0);
  }

  std::uint8_t* of(std::size_t row) { return flags_.data() + begin_[row]; }
  const std::uint8_t* of(std::size_t row) const { return flags_.data() + begin_[row]; }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint8_t> flags_;
};

/// A leaf and what becomes of it.
struct Candidate {
  std::size_t parent;
  std::size_t leaf;
  bool followed;
};

/// Joins what `candidates` of one parent, all of its children, measured.
void addParent(std::vector<Leaf>& leaves, std::size_t parent, std::span<const Leaf> row,
               std::span<const Candidate> children) {
  float light = 0.0f, variance = 0.0f;
  for (const Candidate& child : children) {
    light += row[child.leaf].light;
    variance += row[child.leaf].deviation * row[child.leaf].deviation;
  }
  leaves.push_back({static_cast<std::uint32_t>(parent), 0.0f, std::sqrt(light * light + variance), light,
                    std::sqrt(variance)});
}

Followed findFollowed(const Rows& rows, const Rasters& cameras, const transport::NodeLayout& layout,
                      int level, const std::vector<float>& thresholds, const DivisionSettings& settings) {
  Followed followed(rows);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    parallelFor(0, cameras.size(camera).count(), 256, [&](std::size_t pixel) {
      std::size_t row = cameras.offset(camera) + pixel;
      std::vector<std::size_t> others = beside(cameras, camera, pixelAt(cameras.size(camera), pixel));
      std::uint8_t* flag = followed.of(row);
      for (const Leaf& leaf : rows.leavesOf(row)) {
        bool follow = false;
        if (layout.node(leaf.node).level == level) {
          follow = isStrong(leaf, thresholds[row], settings);
          float sum = 0.0f;
          for (std::size_t other : others)
            if (!follow) sum += strongLight(rows.leavesOf(other), leaf.node, thresholds[other], settings);
          follow = follow || sum > 4.0f * settings.neighbours * thresholds[row];
        }
        *flag++ = follow ? 1 : 0;
      }
    });
  return followed;
}

/// The row's leaves with those of the level divided, joined or as they are.
void divided(std::span<const Leaf> leaves, const std::uint8_t* followed, const transport::NodeLayout& layout,
             int level, float threshold, const DivisionSettings& settings, std::vector<Leaf>& result) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    transport::Node node = layout.node(leaves[i].node);
    if (node.level != level) {
      result.push_back(leaves[i]);
      continue;
    }
    bool root = node.level + 1 >= layout.levels(static_cast<std::size_t>(node.projector));
    candidates.push_back({root ? layout.count() : layout.index(layout.parent(node)), i, followed[i] != 0});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.parent < b.parent; });
  for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
    float light = 0.0f;
    bool anyFollowed = false;
    for (; end < candidates.size() && candidates[end].parent == candidates[begin].parent; ++end) {
      light += std::abs(leaves[candidates[end].leaf].light);
      anyFollowed = anyFollowed || candidates[end].followed;
    }
    std::span<const Candidate> siblings(&candidates[begin], end - begin);
    if (!anyFollowed && light < settings.joined * threshold && siblings[0].parent < layout.count() &&
        siblings.size() == layout.children(layout.node(siblings[0].parent)).size()) {
      addParent(result, siblings[0].parent, leaves, siblings);
      continue;
    }
    for (const Candidate& sibling : siblings) {
      const Leaf& leaf = leaves[sibling.leaf];
      if (sibling.followed && level > 0)
        addChildren(result, leaf, threshold, layout);
      else
        result.push_back(leaf);
    }
  }
  std::sort(result.begin(), result.end(), [](const Leaf& a, const Leaf& b) { return a.node < b.node; });
}

}  // namespace

void divide(Rows& rows, const Rasters& cameras, const transport::NodeLayout& layout, int level,
            const std::vector<float>& thresholds, const DivisionSettings& settings) {
  const Followed followed = findFollowed(rows, cameras, layout, level, thresholds, settings);
  rows.change([&](std::size_t row, std::vector<Leaf>& leaves) {
    divided(rows.leavesOf(row), followed.of(row), layout, level, thresholds[row], settings, leaves);
  });
}

std::vector<std::size_t> childrenAfterDivision(const Rows& rows, const Rasters& cameras,
                                               const transport::NodeLayout& layout, int level,
                                               const std::vector<float>& thresholds,
                                               const DivisionSettings& settings) {
  const Followed followed = findFollowed(rows, cameras, layout, level, thresholds, settings);
  std::vector<std::size_t> children(rows.size(), 0);
  parallelFor(0, rows.size(), 256, [&](std::size_t row) {
    const std::span<const Leaf> leaves = rows.leavesOf(row);
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (followed.of(row)[i]) children[row] += layout.children(layout.node(leaves[i].node)).size();
  });
  return children;
}

}  // namespace relucent::multiplexing
