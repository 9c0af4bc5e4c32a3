// SPDX-License-Identifier: MIT
#include "acquisition/tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "acquisition/frames.h"

namespace relucent {
namespace {

using Code = BlockSparseWriter::Code;

BlockSparse noPairs(const NodeLayout& layout, const References& references) {
  BlockSparseWriter writer(layout.count(), references.fullScale, 0);
  for (std::size_t row = 0; row < references.fullScale.size(); ++row) writer.endRow();
  return writer.build();
}

}  // namespace

Code spreadCode(const ColourBlock& variance, float scale) {
  Code code = codeOf(variance.cwiseMax(0.0f).cwiseSqrt(), scale);
  for (std::int16_t& value : code) value = std::max<std::int16_t>(1, value);
  return code;
}

Tree emptyTree(const NodeLayout& layout, const References& references) {
  return {layout,
          {},
          noPairs(layout, references),
          noPairs(layout, references),
          std::vector<ColourBlock>(references.fullScale.size(), ColourBlock::Zero()),
          std::vector<LeafNoise>(references.fullScale.size()),
          references.usable,
          std::vector<std::uint8_t>(references.fullScale.size(), 0)};
}

void plantRoots(Tree& tree, int level, const References& references, const Scheme& scheme) {
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
      if (!tree.wanted[row]) continue;
      const ColourBlock& value = references.root[projector][row];
      bool divided = level > 0 && scheme.follows(row, value, references.rootVariance[projector][row]);
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
      leaves.add(tree.active.column(pair), children.rest(pair));
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
