// SPDX-License-Identifier: MIT
#include "relucent/transport/shared_light.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::transport {
namespace {

constexpr std::size_t pixels = SharedLight::pixels;
constexpr std::size_t blockSizes = 4;  // of 1, 4, 16 and 64 pixels
// All 64 pixels are block 0; the quarters of block b are 4 b + 1 to 4 b + 4.
constexpr std::size_t blocks = 1 + 4 + 16 + 64;
constexpr std::array<std::size_t, blockSizes> firstBlock{21, 5, 1, 0};

constexpr std::size_t pixelsOf(std::size_t size) {
  return std::size_t{1} << (2 * size);
}

/// Values of one channel, one for each place.
using Lane = std::array<float, pixels>;
using Lanes = std::array<Lane, 3>;

std::uint64_t spread(std::uint32_t value) {
  std::uint64_t bits = value;
  bits = (bits | (bits << 16)) & 0x0000ffff0000ffffULL;
  bits = (bits | (bits << 8)) & 0x00ff00ff00ff00ffULL;
  bits = (bits | (bits << 4)) & 0x0f0f0f0f0f0f0f0fULL;
  bits = (bits | (bits << 2)) & 0x3333333333333333ULL;
  return (bits | (bits << 1)) & 0x5555555555555555ULL;
}

/// The nodes that any pixel has a leaf at, with all nodes above them and their brothers, depth first.
class NodeTree {
 public:
  struct Entry {
    Node node;
    std::uint32_t index = 0;   // of the NodeLayout
    std::uint32_t end = 0;     // its descendants are the entries up to here
    std::uint32_t parent = 0;  // itself: none
    float count = 0.0f;        // projector pixels
    bool hasChildren = false;
  };

  NodeTree(const NodeLayout& layout, std::span<const std::vector<NodeShare>> leaves) {
    std::vector<std::uint32_t> nodes;
    for (const std::vector<NodeShare>& pixel : leaves)
      for (const NodeShare& leaf : pixel) nodes.push_back(leaf.node);
    auto unify = [](std::vector<std::uint32_t>& values) {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
    };
    unify(nodes);
    std::vector<std::uint32_t> finer = nodes;
    while (!finer.empty()) {
      std::vector<std::uint32_t> parents;
      for (std::uint32_t index : finer) {
        const Node node = layout.node(index);
        if (node.level + 1 < layout.levels(static_cast<std::size_t>(node.projector)))
          parents.push_back(static_cast<std::uint32_t>(layout.index(layout.parent(node))));
      }
      unify(parents);
      for (std::uint32_t index : parents) {
        nodes.push_back(index);
        for (const Node& child : layout.children(layout.node(index)))
          nodes.push_back(static_cast<std::uint32_t>(layout.index(child)));
      }
      finer = std::move(parents);
    }
    unify(nodes);
    for (std::uint32_t index : nodes) {
      Entry entry;
      entry.node = layout.node(index);
      entry.index = index;
      entry.count = static_cast<float>(layout.block(entry.node).count());
      entries_.push_back(entry);
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return keyOf(a.node) < keyOf(b.node); });
    link();
    for (std::size_t i = 0; i < entries_.size(); ++i)
      byIndex_.push_back({entries_[i].index, static_cast<std::uint32_t>(i)});
    std::sort(byIndex_.begin(), byIndex_.end());
  }

  const std::vector<Entry>& entries() const { return entries_; }
  std::size_t find(std::uint32_t index) const {
    return std::lower_bound(byIndex_.begin(), byIndex_.end(), std::pair{index, 0u})->second;
  }

 private:
  /// Projector, place in Z order, the wider node first.
  static std::uint64_t keyOf(const Node& node) {
    const auto x = static_cast<std::uint32_t>(node.x) << node.level;
    const auto y = static_cast<std::uint32_t>(node.y) << node.level;
    const std::uint64_t z = spread(x) | (spread(y) << 1);
    return (static_cast<std::uint64_t>(node.projector) << 48) | (z << 5) |
           static_cast<std::uint64_t>(31 - node.level);
  }

  void link() {
    std::vector<std::uint32_t> open;  // the nodes around the next one, widest first
    auto isWithin = [&](const Entry& inner, const Entry& outer) {
      const int up = outer.node.level - inner.node.level;
      return inner.node.projector == outer.node.projector && up > 0 && inner.node.x >> up == outer.node.x &&
             inner.node.y >> up == outer.node.y;
    };
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
      while (!open.empty() && !isWithin(entries_[i], entries_[open.back()])) {
        entries_[open.back()].end = i;
        open.pop_back();
      }
      entries_[i].parent = open.empty() ? i : open.back();
      if (!open.empty()) entries_[open.back()].hasChildren = true;
      open.push_back(i);
    }
    for (std::uint32_t i : open) entries_[i].end = static_cast<std::uint32_t>(entries_.size());
  }

  std::vector<Entry> entries_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> byIndex_;
};

/// Where leaves hold, and the least number of them.
class Division {
 public:
  Division(const NodeLayout& layout, std::span<const std::vector<NodeShare>> leaves,
           std::span<const Channels> weight, float tolerance)
      : tree_(layout, leaves), light_(tree_.entries().size()) {
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t c = 0; c < 3; ++c) weight_[c][i] = weight[i][c];
    fill(leaves);
    cost_.resize(tree_.entries().size());
    for (std::size_t entry = tree_.entries().size(); entry-- > 0;) weigh(entry, tolerance);
  }

  SharedLight result() {
    std::array<std::vector<NodeShare>, blocks> leaves;
    for (std::size_t entry = 0; entry < tree_.entries().size(); entry = tree_.entries()[entry].end)
      emit(0, blockSizes - 1, entry, leaves);
    SharedLight shared;
    std::array<std::uint32_t, blocks> group{};
    for (std::size_t size = blockSizes - 1; size > 0; --size) {
      const std::size_t count = pixelsOf(size);
      for (std::size_t i = 0; i < pixels / count; ++i) {
        const std::size_t block = firstBlock[size] + i;
        group[block] = block == 0 ? LightGroup::none : group[(block - 1) / 4];
        if (leaves[block].empty()) continue;
        shared.groups.push_back({group[block], i * count, (i + 1) * count, std::move(leaves[block])});
        group[block] = static_cast<std::uint32_t>(shared.groups.size() - 1);
      }
    }
    for (std::size_t i = 0; i < pixels; ++i) {
      shared.own[i] = std::move(leaves[firstBlock[0] + i]);
      shared.groupOf[i] = group[firstBlock[1] + i / 4];
    }
    return shared;
  }

 private:
  struct Cost {
    std::array<std::uint32_t, blocks> least{};
    std::array<bool, blocks> holds{};
  };

  void fill(std::span<const std::vector<NodeShare>> leaves) {
    const std::vector<NodeTree::Entry>& entries = tree_.entries();
    std::vector<Lanes> from(entries.size(), Lanes{});  // leaves at the node and those around it
    for (std::size_t i = 0; i < leaves.size(); ++i)
      for (const NodeShare& leaf : leaves[i]) {
        const std::size_t entry = tree_.find(leaf.node);
        for (std::size_t c = 0; c < 3; ++c) {
          from[entry][c][i] += leaf.share[c];
          light_[entry][c][i] += leaf.share[c];
        }
      }
    for (std::size_t entry = entries.size(); entry-- > 0;) {  // what is within
      const std::size_t parent = entries[entry].parent;
      if (parent != entry) add(light_[parent], light_[entry], 1.0f);
    }
    for (std::size_t entry = 0; entry < entries.size(); ++entry) {
      const std::size_t parent = entries[entry].parent;
      if (parent == entry) continue;
      const float share = entries[entry].count / entries[parent].count;
      add(light_[entry], from[parent], share);
      add(from[entry], from[parent], share);
    }
  }

  static void add(Lanes& to, const Lanes& what, float factor) {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < pixels; ++i) to[c][i] += factor * what[c][i];
  }

  /// The weighted means over all blocks of a size, for each of their pixels.
  Lanes means(const Lanes& light, std::size_t size) const {
    if (size == 0) return light;
    Lanes mean{};
    const std::size_t count = pixelsOf(size);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t begin = 0; begin < pixels; begin += count) {
        float sum = 0.0f, weights = 0.0f;
        for (std::size_t i = begin; i < begin + count; ++i) {
          const float square = weight_[c][i] * weight_[c][i];
          sum += square * light[c][i];
          weights += square;
        }
        const float value = weights > 0.0f ? sum / weights : 0.0f;
        std::fill_n(mean[c].begin() + static_cast<std::ptrdiff_t>(begin), count, value);
      }
    return mean;
  }

  /// At which blocks a leaf at an entry holds, and the least numbers of leaves within it.
  void weigh(std::size_t entry, float tolerance) {
    const std::vector<NodeTree::Entry>& entries = tree_.entries();
    const NodeTree::Entry& here = entries[entry];
    std::array<Lanes, blockSizes> mean;
    for (std::size_t size = 0; size < blockSizes; ++size) mean[size] = means(light_[entry], size);
    std::array<Lane, blockSizes> apart{};
    for (std::size_t within = entry; within < here.end; ++within) {
      const float share = entries[within].count / here.count;
      for (std::size_t size = 0; size < blockSizes; ++size)
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t i = 0; i < pixels; ++i)
            apart[size][i] = std::max(
                apart[size][i], weight_[c][i] * std::abs(light_[within][c][i] - share * mean[size][c][i]));
      bool any = false;
      for (std::size_t size = 0; size < blockSizes && !any; ++size)
        any = *std::min_element(apart[size].begin(), apart[size].end()) <= tolerance;
      if (!any) break;
    }
    Cost& cost = cost_[entry];
    for (std::size_t block = blocks, size = 0; block-- > 0;) {
      if (block < firstBlock[size]) ++size;
      const std::size_t count = pixelsOf(size), place = (block - firstBlock[size]) * count;
      const auto first = apart[size].begin() + static_cast<std::ptrdiff_t>(place);
      cost.holds[block] = *std::max_element(first, first + static_cast<std::ptrdiff_t>(count)) <= tolerance;
      if (cost.holds[block]) {
        cost.least[block] = isDark(light_[entry], place, count) ? 0 : 1;
        continue;
      }
      cost.least[block] = std::numeric_limits<std::uint32_t>::max();
      if (here.hasChildren) cost.least[block] = costOfChildren(entry, block);
      if (size > 0) cost.least[block] = std::min(cost.least[block], costOfQuarters(entry, block));
    }
  }

  static bool isDark(const Lanes& light, std::size_t begin, std::size_t count) {
    for (const Lane& lane : light)
      for (std::size_t i = begin; i < begin + count; ++i)
        if (lane[i] != 0.0f) return false;
    return true;
  }

  std::uint32_t costOfChildren(std::size_t entry, std::size_t block) const {
    std::uint32_t sum = 0;
    const std::vector<NodeTree::Entry>& entries = tree_.entries();
    for (std::size_t child = entry + 1; child < entries[entry].end; child = entries[child].end)
      sum += cost_[child].least[block];
    return sum;
  }

  std::uint32_t costOfQuarters(std::size_t entry, std::size_t block) const {
    std::uint32_t sum = 0;
    for (std::size_t quarter = 1; quarter <= 4; ++quarter) sum += cost_[entry].least[4 * block + quarter];
    return sum;
  }

  void emit(std::size_t block, std::size_t size, std::size_t entry,
            std::array<std::vector<NodeShare>, blocks>& to) const {
    const Cost& cost = cost_[entry];
    if (cost.least[block] == 0) return;
    const std::vector<NodeTree::Entry>& entries = tree_.entries();
    if (cost.holds[block]) {
      const Lanes mean = means(light_[entry], size);
      const std::size_t place = (block - firstBlock[size]) * pixelsOf(size);
      to[block].push_back({entries[entry].index, {mean[0][place], mean[1][place], mean[2][place]}});
    } else if (entries[entry].hasChildren && costOfChildren(entry, block) == cost.least[block]) {
      for (std::size_t child = entry + 1; child < entries[entry].end; child = entries[child].end)
        emit(block, size, child, to);
    } else {
      for (std::size_t quarter = 1; quarter <= 4; ++quarter) emit(4 * block + quarter, size - 1, entry, to);
    }
  }

  NodeTree tree_;
  std::vector<Lanes> light_;
  Lanes weight_{};
  std::vector<Cost> cost_;
};

}  // namespace

Channels sumOf(const std::vector<NodeShare>& shares) {
  Channels sum{};
  for (const NodeShare& share : shares)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += share.share[c];
  return sum;
}

std::size_t SharedLight::placeOf(int x, int y) {
  return static_cast<std::size_t>(spread(static_cast<std::uint32_t>(x)) |
                                  (spread(static_cast<std::uint32_t>(y)) << 1));
}

SharedLight shareLight(const NodeLayout& layout, std::span<const std::vector<NodeShare>> leaves,
                       std::span<const Channels> weight, float tolerance) {
  require(leaves.size() == pixels && weight.size() == pixels, "{} rows and {} weights for {} pixels",
          leaves.size(), weight.size(), pixels);
  constexpr float rounding = 1e-6f;  // of a row's shares, which sum to one
  return Division(layout, leaves, weight, std::max(tolerance, rounding)).result();
}

}  // namespace relucent::transport
