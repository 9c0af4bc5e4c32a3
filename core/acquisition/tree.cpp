// SPDX-License-Identifier: MIT
#include "relucent/acquisition/tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "relucent/acquisition/frames.h"

namespace relucent::acquisition {
namespace {

using Code = transport::BlockSparseWriter::Code;

transport::BlockSparse noPairs(std::size_t nodes, const Stack& fullScale) {
  transport::BlockSparseWriter writer(nodes, fullScale, 0);
  for (std::size_t row = 0; row < fullScale.size(); ++row) writer.endRow();
  return writer.build();
}

/// One level of the tree as it is written, row after row.
class LevelWriter {
 public:
  LevelWriter(const transport::NodeLayout& layout, const photography::References& references,
              std::size_t leaves, std::size_t actives)
      : leaves_(layout.count(), references.fullScale, leaves),
        active_(layout.count(), references.fullScale, actives),
        spread_(layout.count(), references.fullScale, actives) {}

  void leaf(std::size_t node, const Code& value) { leaves_.add(node, value); }
  void divided(std::size_t node, const Code& value, const Code& spread) {
    active_.add(node, value);
    spread_.add(node, spread);
  }
  void endRow() {
    leaves_.endRow();
    active_.endRow();
    spread_.endRow();
  }
  void store(Tree& tree) {
    tree.leaves.push_back(leaves_.build());
    tree.active = active_.build();
    tree.spread = spread_.build();
  }

 private:
  transport::BlockSparseWriter leaves_, active_, spread_;
};

}  // namespace

Code spreadCode(const transport::ColourBlock& variance, float scale) {
  Code code = transport::codeOf(variance.cwiseMax(0.0f).cwiseSqrt(), scale);
  for (std::int16_t& value : code) value = std::max<std::int16_t>(1, value);
  return code;
}

Tree emptyTree(const photography::References& references, const std::vector<std::uint8_t>& rows) {
  transport::NodeLayout layout(references.projectors);
  transport::BlockSparse none = noPairs(layout.count(), references.fullScale);
  std::size_t count = references.fullScale.size();
  return {layout,
          {},
          none,
          none,
          std::vector<transport::ColourBlock>(count, transport::ColourBlock::Zero()),
          std::vector<LeafNoise>(count),
          rows,
          CameraMask(count, 0)};
}

void addRoots(Tree& tree, int level, const photography::References& references, const Scheme& scheme) {
  std::vector<std::size_t> ending;
  for (std::size_t projector = 0; projector < tree.layout.projectors().devices(); ++projector)
    if (tree.layout.levels(projector) == level + 1) ending.push_back(projector);
  if (ending.empty()) return;

  std::size_t rows = references.fullScale.size();
  LevelWriter writer(tree.layout, references, rows, tree.active.blocks() + rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t pair = tree.active.rowBegin(row); pair < tree.active.rowBegin(row + 1); ++pair)
      writer.divided(tree.active.column(pair), tree.active.code(pair), tree.spread.code(pair));
    for (std::size_t projector : ending) {
      if (!tree.wanted[row]) continue;
      const transport::ColourBlock& value = references.root[projector][row];
      const transport::ColourBlock& variance = references.rootVariance[projector][row];
      std::size_t node = tree.layout.index({static_cast<int>(projector), level, 0, 0});
      float scale = tree.active.scale(row);
      if (level > 0 && scheme.follows(row, value, variance))
        writer.divided(node, transport::codeOf(value, scale), spreadCode(variance, scale));
      else
        writer.leaf(node, transport::codeOf(value, scale));
    }
    writer.endRow();
  }
  writer.store(tree);
}

void adopt(Tree& tree, const Children& children, const photography::References& references) {
  LevelWriter writer(tree.layout, references, children.leaves(), children.actives());
  for (std::size_t row = 0; row < tree.active.rows(); ++row) {
    for (std::size_t pair = tree.active.rowBegin(row); pair < tree.active.rowBegin(row + 1); ++pair) {
      transport::Node parent = tree.layout.node(tree.active.column(pair));
      for (int quadrant = 0; quadrant < quadrants; ++quadrant) {
        transport::Node child;
        if (!childOf(tree.layout, parent, quadrant, child)) continue;
        std::size_t node = tree.layout.index(child);
        if (children.active(pair, quadrant))
          writer.divided(node, children.code(pair, quadrant), children.spread(pair, quadrant));
        else
          writer.leaf(node, children.code(pair, quadrant));
      }
      writer.leaf(tree.active.column(pair), children.rest(pair));
    }
    writer.endRow();
  }
  writer.store(tree);
}

void stopDividing(Tree& tree, const photography::References& references) {
  transport::BlockSparse none = noPairs(tree.layout.count(), references.fullScale);
  tree.leaves.push_back(std::exchange(tree.active, none));
  tree.spread = std::move(none);
}

transport::BlockSparse takeLeaves(Tree& tree, const photography::References& references) {
  std::size_t blocks = 0;
  for (const transport::BlockSparse& level : tree.leaves) blocks += level.blocks();
  transport::BlockSparseWriter all(tree.layout.count(), references.fullScale, blocks);
  for (std::size_t row = 0; row < references.fullScale.size(); ++row) {
    for (const transport::BlockSparse& level : tree.leaves)
      for (std::size_t entry = level.rowBegin(row); entry < level.rowBegin(row + 1); ++entry)
        all.add(level.column(entry), level.code(entry));
    all.endRow();
  }
  tree.leaves.clear();
  return all.build();
}

}  // namespace relucent::acquisition
