// SPDX-License-Identifier: MIT
#include "acquisition/refinement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

using Code = BlockSparseWriter::Code;

constexpr int quadrants = 4;
// A child is at most as bright as its parent, but for the noise of both.
constexpr float brighterThanParent = 1.1f;
// Standard deviation of what the unevenness of lit leaves does to a frame, as a share of tau.
constexpr float unevenness = 0.25f;

/// The child of `parent` in a quadrant, 0 to 3 row by row, if it is not cut off by the border.
bool childOf(const NodeLayout& layout, const Node& parent, int quadrant, Node& child) {
  child = {parent.projector, parent.level - 1, 2 * parent.x + quadrant % 2, 2 * parent.y + quadrant / 2};
  Size grid = layout.gridSize(static_cast<std::size_t>(parent.projector), child.level);
  return child.x < grid.width && child.y < grid.height;
}

/// Nodes of one level, all projectors: their indices are contiguous.
struct LevelNodes {
  LevelNodes(const NodeLayout& layout, int level) {
    for (std::size_t projector = layout.projectors().devices(); projector-- > 0;) {
      if (level >= layout.levels(projector)) continue;
      first = layout.index({static_cast<int>(projector), level, 0, 0});
      count += layout.gridSize(projector, level).count();
    }
  }
  std::size_t first = 0;
  std::size_t count = 0;
};

bool matters(const ColourBlock& value, const ColourBlock& variance, float strongest,
             const AcquisitionSettings& settings) {
  auto relative = static_cast<float>(settings.relativeThreshold) * strongest;
  auto sigmas = static_cast<float>(settings.noiseSigmas);
  for (int i = 0; i < 9; ++i) {
    float noise = sigmas * std::sqrt(std::max(0.0f, variance.data()[i]));
    if (value.data()[i] > std::max(relative, noise)) return true;
  }
  return false;
}

/// Standard deviations as codes, never zero: they stand beside an active pair's value.
Code spreadCode(const ColourBlock& variance, float scale) {
  Code code = codeOf(variance.cwiseMax(0.0f).cwiseSqrt(), scale);
  for (std::int16_t& value : code) value = std::max<std::int16_t>(1, value);
  return code;
}

/// A camera pixel and the one of its active nodes that a colour lights.
struct Seen {
  std::uint32_t row;
  std::uint32_t pair;
};

/// The active pairs, colour after colour.
struct PairsByColour {
  PairsByColour(const BlockSparse& active, const Schedule& schedule) : start(schedule.colours + 1, 0) {
    for (std::size_t pair = 0; pair < active.blocks(); ++pair)
      ++start[schedule.colour(active.column(pair)) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    seen.resize(active.blocks());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::size_t row = 0; row < active.rows(); ++row)
      for (std::size_t pair = active.rowBegin(row); pair < active.rowBegin(row + 1); ++pair)
        seen[next[schedule.colour(active.column(pair))]++] = {static_cast<std::uint32_t>(row),
                                                              static_cast<std::uint32_t>(pair)};
  }
  std::span<const Seen> of(std::uint32_t colour) const {
    return {seen.data() + start[colour], start[colour + 1] - start[colour]};
  }

  std::vector<std::size_t> start;
  std::vector<Seen> seen;
};

/// A projector stack of one value a pixel: which pixels a colour lights in a quadrant. Empty: none.
std::vector<std::uint8_t> litPixels(const Schedule& schedule, const NodeLayout& layout, std::uint32_t colour,
                                    int quadrant) {
  const Rasters& projectors = layout.projectors();
  std::vector<std::uint8_t> lit;
  for (std::size_t i = 0; i < schedule.colourOf.size(); ++i) {
    Node child;
    if (schedule.colourOf[i] != colour ||
        !childOf(layout, layout.node(schedule.firstNode + i), quadrant, child))
      continue;
    if (lit.empty()) lit.assign(projectors.count(), 0);
    Block block = layout.block(child);
    auto projector = static_cast<std::size_t>(child.projector);
    for (int y = block.y0; y < block.y1; ++y) {
      std::size_t begin = projectors.offset(projector) + indexOf(projectors.size(projector), {block.x0, y});
      std::fill_n(lit.begin() + static_cast<std::ptrdiff_t>(begin), block.x1 - block.x0, std::uint8_t{1});
    }
  }
  return lit;
}

Stack inChannel(const std::vector<std::uint8_t>& lit, std::size_t channel) {
  Stack pattern(3 * lit.size(), 0.0f);
  for (std::size_t i = 0; i < lit.size(); ++i) pattern[3 * i + channel] = lit[i];
  return pattern;
}

/// The share of every node's block that is lit.
std::vector<float> litShares(const std::vector<std::uint8_t>& lit, const NodeLayout& layout) {
  Stack means = layout.means(inChannel(lit, 0));
  std::vector<float> shares(layout.count());
  for (std::size_t node = 0; node < shares.size(); ++node) shares[node] = means[3 * node];
  return shares;
}

/// What a row's leaves send to the camera, per projector channel, with these shares of their blocks lit.
ColourBlock underPattern(const std::vector<BlockSparse>& leaves, std::size_t row,
                         const std::vector<float>& shares) {
  float sum[9] = {};
  float scale = 0.0f;
  for (const BlockSparse& level : leaves) {
    scale = level.scale(row);
    for (std::size_t entry = level.rowBegin(row); entry < level.rowBegin(row + 1); ++entry) {
      float share = shares[level.column(entry)];
      if (share == 0.0f) continue;
      const Code& code = level.code(entry);
      for (std::size_t i = 0; i < 9; ++i) sum[i] += share * static_cast<float>(code[i]);
    }
  }
  ColourBlock block;
  for (int i = 0; i < 9; ++i) block.data()[i] = scale * sum[i];
  return block;
}

/// The children of all active pairs while they are being measured.
class Children {
 public:
  Children(std::size_t pairs, bool mayDivide)
      : code_(quadrants * pairs), spread_(mayDivide ? quadrants * pairs : 0), active_(pairs, 0) {}

  void set(std::size_t pair, int quadrant, const Code& code) { code_[at(pair, quadrant)] = code; }
  void activate(std::size_t pair, int quadrant, const Code& spread) {
    spread_[at(pair, quadrant)] = spread;
    active_[pair] = static_cast<std::uint8_t>(active_[pair] | (1 << quadrant));
  }
  const Code& code(std::size_t pair, int quadrant) const { return code_[at(pair, quadrant)]; }
  const Code& spread(std::size_t pair, int quadrant) const { return spread_[at(pair, quadrant)]; }
  bool active(std::size_t pair, int quadrant) const { return (active_[pair] >> quadrant & 1) != 0; }
  std::size_t actives() const {
    std::size_t count = 0;
    for (std::uint8_t bits : active_) count += static_cast<std::size_t>(std::popcount(bits));
    return count;
  }
  std::size_t leaves() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < code_.size(); ++i)
      if (code_[i] != Code{} && !active(i / quadrants, static_cast<int>(i % quadrants))) ++count;
    return count;
  }

 private:
  static std::size_t at(std::size_t pair, int quadrant) {
    return quadrants * pair + static_cast<std::size_t>(quadrant);
  }
  std::vector<Code> code_, spread_;
  std::vector<std::uint8_t> active_;  // per pair, a bit a quadrant
};

/// A value with its variance, for all nine channel pairs.
struct Estimate {
  ColourBlock value = ColourBlock::Zero();
  ColourBlock variance = ColourBlock::Zero();
};

/// Makes measured children agree with their measured parent: the least squares solution of
///   sum of children = parent,
/// each side trusted by its variance. Without it the noise of a row's sum grows with its leaves, and an
/// error that all children share, such as that of e, adds up.
void reconcile(const Estimate& parent, std::span<Estimate> children) {
  ColourBlock sum = ColourBlock::Zero(), variance = parent.variance;
  for (const Estimate& child : children) {
    sum += child.value;
    variance += child.variance;
  }
  for (Estimate& child : children) {
    for (int i = 0; i < 9; ++i) {
      if (variance.data()[i] <= 0.0f) continue;
      float gain = child.variance.data()[i] / variance.data()[i];
      child.value.data()[i] += gain * (parent.value.data()[i] - sum.data()[i]);
      child.variance.data()[i] *= 1.0f - gain;
    }
  }
}

/// Measures the four quadrants of one colour in red, green and blue.
class ColourClass {
 public:
  ColourClass(Tree& tree, std::span<const Seen> seen, const References& references,
              const AcquisitionSettings& settings)
      : tree_(tree),
        seen_(seen),
        references_(references),
        settings_(settings),
        predicted_(seen.size()),
        measured_(quadrants * seen.size()) {}

  void measure(int quadrant, const std::vector<std::uint8_t>& lit, Photographer& photographer,
               const Progress& progress) {
    std::vector<float> shares = litShares(lit, tree_.layout);
    parallelFor(0, seen_.size(), 256,
                [&](std::size_t i) { predicted_[i] = underPattern(tree_.leaves, seen_[i].row, shares); });
    for (std::size_t channel = 0; channel < 3; ++channel)
      extract(quadrant, channel, photographer.take(inChannel(lit, channel), demands(channel), progress));
  }

  /// To be called when all quadrants have been measured.
  void settle(Children& children) {
    parallelFor(0, seen_.size(), 256, [&](std::size_t i) { settle(i, children); });
  }

 private:
  std::vector<Demand> demands(std::size_t channel) const {
    std::vector<Demand> demands(references_.usable.size());
    parallelFor(0, seen_.size(), 1024, [&](std::size_t i) {
      std::size_t row = seen_[i].row;
      ColourBlock parent = tree_.active.block(row, seen_[i].pair);
      float brightest = 0.0f, expected = 0.0f;
      for (std::size_t c = 0; c < 3; ++c) {
        float around = references_.black.radiance[3 * row + c] + predicted_[i].data()[3 * c + channel];
        float block = std::max(0.0f, parent.data()[3 * c + channel]);
        brightest = std::max(brightest, around + brighterThanParent * block);
        expected = std::max(expected, around + block / quadrants);
      }
      auto tolerable = static_cast<float>(settings_.relativeThreshold / settings_.noiseSigmas);
      demands[row] = {brightest, expected, tolerable * references_.strongest[row]};
    });
    return demands;
  }

  void extract(int quadrant, std::size_t channel, const HdrFrame& frame) {
    parallelFor(0, seen_.size(), 256, [&](std::size_t i) {
      std::size_t row = seen_[i].row;
      Estimate& child = measured_[quadrants * i + static_cast<std::size_t>(quadrant)];
      for (std::size_t c = 0; c < 3; ++c) {
        std::size_t at = 3 * row + c, place = 3 * c + channel;
        child.value.data()[place] =
            frame.radiance[at] - references_.black.radiance[at] - predicted_[i].data()[place];
        child.variance.data()[place] = frame.variance[at] + references_.black.variance[at];
        // Too bright for every exposure: the whole camera pixel is in doubt.
        if (!frame.valid[at]) tree_.unknown[row] = 1;
      }
    });
  }

  void settle(std::size_t i, Children& children) const {
    auto [row, pair] = seen_[i];
    if (tree_.unknown[row]) return;
    float strongest = references_.strongest[row];
    auto relative = static_cast<float>(settings_.relativeThreshold) * strongest;

    std::array<Estimate, quadrants> estimate;
    std::array<Node, quadrants> node;
    std::array<int, quadrants> quadrant;
    std::array<ColourBlock, quadrants> noise;
    std::size_t count = 0;
    Node parent = tree_.layout.node(tree_.active.column(pair));
    for (int q = 0; q < quadrants; ++q) {
      if (!childOf(tree_.layout, parent, q, node[count])) continue;
      estimate[count] = measured_[quadrants * i + static_cast<std::size_t>(q)];
      noise[count] = estimate[count].variance;
      // Leaves that are lit in part were taken off as if they were even.
      estimate[count].variance.array() += std::pow(unevenness * relative, 2.0f);
      quadrant[count++] = q;
    }
    ColourBlock spread = tree_.spread.block(row, pair);
    reconcile({tree_.active.block(row, pair), spread.cwiseProduct(spread)}, {estimate.data(), count});

    float scale = tree_.active.scale(row);
    for (std::size_t k = 0; k < count; ++k) {
      if (node[k].level > 0 && matters(estimate[k].value, noise[k], strongest, settings_)) {
        children.set(pair, quadrant[k], codeOf(estimate[k].value, scale));
        children.activate(pair, quadrant[k], spreadCode(estimate[k].variance, scale));
        continue;
      }
      ColourBlock rounded = estimate[k].value + tree_.rounding[row];
      Code code = codeOf(rounded, scale);
      for (std::size_t c = 0; c < 9; ++c) rounded.data()[c] -= scale * static_cast<float>(code[c]);
      tree_.rounding[row] = rounded;
      children.set(pair, quadrant[k], code);
    }
  }

  Tree& tree_;
  std::span<const Seen> seen_;
  const References& references_;
  const AcquisitionSettings& settings_;
  std::vector<ColourBlock> predicted_;  // as seen_, in the quadrant under way
  std::vector<Estimate> measured_;      // as seen_, four each
};

/// Sorts measured children into leaves and the next level's active nodes.
void adopt(Tree& tree, const Children& children, const References& references) {
  BlockSparseWriter leaves(tree.layout.count(), references.fullScale, children.leaves());
  BlockSparseWriter active(tree.layout.count(), references.fullScale, children.actives());
  BlockSparseWriter spread(tree.layout.count(), references.fullScale, children.actives());
  for (std::size_t row = 0; row < tree.active.rows(); ++row) {
    for (std::size_t pair = tree.active.rowBegin(row); pair < tree.active.rowBegin(row + 1); ++pair) {
      Node parent = tree.layout.node(tree.active.column(pair));
      for (int quadrant = 0; quadrant < quadrants; ++quadrant) {
        Node child;
        if (!childOf(tree.layout, parent, quadrant, child)) continue;
        std::size_t node = tree.layout.index(child);
        bool divided = children.active(pair, quadrant);
        (divided ? active : leaves).add(node, children.code(pair, quadrant));
        if (divided) spread.add(node, children.spread(pair, quadrant));
      }
    }
    leaves.endRow();
    active.endRow();
    spread.endRow();
  }
  tree.leaves.push_back(leaves.build());
  tree.active = active.build();
  tree.spread = spread.build();
}

BlockSparse noPairs(const NodeLayout& layout, const References& references) {
  BlockSparseWriter writer(layout.count(), references.fullScale, 0);
  for (std::size_t row = 0; row < references.fullScale.size(); ++row) writer.endRow();
  return writer.build();
}

}  // namespace

Tree emptyTree(const NodeLayout& layout, const References& references) {
  return {layout,
          {},
          noPairs(layout, references),
          noPairs(layout, references),
          std::vector<ColourBlock>(references.fullScale.size(), ColourBlock::Zero()),
          std::vector<std::uint8_t>(references.fullScale.size(), 0)};
}

void plantRoots(Tree& tree, int level, const References& references, const AcquisitionSettings& settings) {
  std::vector<std::size_t> ending;
  for (std::size_t projector = 0; projector < tree.layout.projectors().devices(); ++projector)
    if (tree.layout.levels(projector) == level + 1) ending.push_back(projector);
  if (ending.empty()) return;

  std::size_t rows = references.fullScale.size();
  BlockSparseWriter leaves(tree.layout.count(), references.fullScale, rows);
  BlockSparseWriter active(tree.layout.count(), references.fullScale, tree.active.blocks() + rows);
  BlockSparseWriter spread(tree.layout.count(), references.fullScale, tree.active.blocks() + rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t pair = tree.active.rowBegin(row); pair < tree.active.rowBegin(row + 1); ++pair) {
      active.add(tree.active.column(pair), tree.active.code(pair));
      spread.add(tree.spread.column(pair), tree.spread.code(pair));
    }
    for (std::size_t projector : ending) {
      if (!references.usable[row]) continue;
      const ColourBlock& value = references.root[projector][row];
      bool divided = level > 0 && matters(value, references.rootVariance[projector][row],
                                          references.strongest[row], settings);
      std::size_t node = tree.layout.index({static_cast<int>(projector), level, 0, 0});
      float scale = tree.active.scale(row);
      (divided ? active : leaves).add(node, codeOf(value, scale));
      if (divided) spread.add(node, spreadCode(references.rootVariance[projector][row], scale));
    }
    leaves.endRow();
    active.endRow();
    spread.endRow();
  }
  tree.leaves.push_back(leaves.build());
  tree.active = active.build();
  tree.spread = spread.build();
}

void stopDividing(Tree& tree) {
  tree.spread = tree.active.filtered([](std::size_t, std::size_t) { return false; });
  tree.leaves.push_back(std::exchange(tree.active, tree.spread));
}

int patternsOf(const Schedule& schedule, const NodeLayout& layout, int level) {
  std::vector<std::uint8_t> used(quadrants * schedule.colours, 0);
  for (std::size_t i = 0; i < schedule.colourOf.size(); ++i) {
    if (schedule.colourOf[i] == Schedule::dark) continue;
    Node node = layout.node(schedule.firstNode + i), child;
    require(node.level == level, "a schedule for level {}, not {}", node.level, level);
    for (int quadrant = 0; quadrant < quadrants; ++quadrant)
      if (childOf(layout, node, quadrant, child))
        used[quadrants * schedule.colourOf[i] + static_cast<std::size_t>(quadrant)] = 1;
  }
  return 3 * static_cast<int>(std::count(used.begin(), used.end(), 1));
}

void divide(Tree& tree, int level, const Schedule& schedule, Photographer& photographer,
            const References& references, const AcquisitionSettings& settings, Progress& progress) {
  require(tree.active.blocks() <= std::numeric_limits<std::uint32_t>::max(), "{} active pairs",
          tree.active.blocks());
  PairsByColour pairs(tree.active, schedule);
  Children children(tree.active.blocks(), level > 1);
  double total = patternsOf(schedule, tree.layout, level), done = 0.0;
  for (std::uint32_t colour = 0; colour < schedule.colours; ++colour) {
    ColourClass blocks(tree, pairs.of(colour), references, settings);
    for (int quadrant = 0; quadrant < quadrants; ++quadrant) {
      std::vector<std::uint8_t> lit = litPixels(schedule, tree.layout, colour, quadrant);
      if (lit.empty()) continue;
      blocks.measure(quadrant, lit, photographer, progress);
      progress.report((done += 3.0) / total);
    }
    blocks.settle(children);
  }
  adopt(tree, children, references);
}

BlockSparse harvest(Tree& tree, const References& references) {
  std::size_t blocks = 0;
  for (const BlockSparse& level : tree.leaves) blocks += level.blocks();
  BlockSparseWriter all(tree.layout.count(), references.fullScale, blocks);
  for (std::size_t row = 0; row < references.fullScale.size(); ++row) {
    for (const BlockSparse& level : tree.leaves)
      for (std::size_t entry = level.rowBegin(row); entry < level.rowBegin(row + 1); ++entry)
        all.add(level.column(entry), level.code(entry));
    all.endRow();
  }
  tree.leaves.clear();
  return all.build();
}

}  // namespace relucent
