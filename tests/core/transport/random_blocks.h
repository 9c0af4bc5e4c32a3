// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "relucent/base/random.h"
#include "relucent/transport/block_sparse.h"
#include "relucent/transport/shared_colours.h"

namespace relucent {

/// A random sparse block matrix and the same as a dense one, both exact: the dense one holds what was stored.
struct RandomBlocks {
  transport::BlockSparse sparse;
  Eigen::MatrixXd dense;
};

inline Eigen::MatrixXd denseOf(const transport::BlockSparse& blocks) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * blocks.rows()),
                                                static_cast<Eigen::Index>(3 * blocks.columns()));
  for (std::size_t row = 0; row < blocks.rows(); ++row)
    for (std::size_t entry = blocks.rowBegin(row); entry < blocks.rowBegin(row + 1); ++entry)
      dense.block<3, 3>(static_cast<Eigen::Index>(3 * row),
                        static_cast<Eigen::Index>(3 * blocks.column(entry))) +=
          blocks.block(row, entry).cast<double>();
  return dense;
}

/// Values in [lowest, 1]; about `density` of all places are filled.
inline RandomBlocks randomBlocks(std::size_t rows, std::size_t columns, double density, std::uint64_t seed,
                                 float lowest = -0.2f) {
  Random random{seed};
  transport::BlockSparseBuilder builder(columns, std::vector<float>(rows, 1.0f));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      if (random.uniform() >= density) continue;
      transport::ColourBlock block;
      for (int i = 0; i < 9; ++i) block.data()[i] = lowest + (1.0f - lowest) * random.uniformFloat();
      builder.add(row, column, block);
    }
  }
  RandomBlocks result{builder.build(), {}};
  result.dense = denseOf(result.sparse);
  return result;
}

/// Three kinds in six ranges, as two projectors have them; fewer for less than six columns.
inline transport::ColumnKinds someKinds(std::size_t columns) {
  transport::ColumnKinds kinds;
  kinds.count = 3;
  for (std::size_t range = 1; range <= 6; ++range) {
    const auto end = static_cast<std::uint32_t>(columns * range / 6);
    if (end > (kinds.ranges.empty() ? 0 : kinds.ranges.back().end))
      kinds.ranges.push_back({end, static_cast<std::uint32_t>(range % 3)});
  }
  return kinds;
}

/// Random blocks whose rows share colours within each kind, as stored.
inline RandomBlocks randomSharedBlocks(std::size_t rows, std::size_t columns, double density,
                                       std::uint64_t seed) {
  Random random{seed};
  const transport::ColumnKinds kinds = someKinds(columns);
  transport::SharedColourWriter writer(columns, rows, kinds, 0);
  transport::SharedColourEncoder encoder(kinds);
  transport::SharedColourRow encoded;
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<transport::ColourBlock> mixing(kinds.count);
    for (transport::ColourBlock& colours : mixing)
      for (int i = 0; i < 9; ++i) colours.data()[i] = 0.05f + 0.95f * random.uniformFloat();
    std::vector<std::uint32_t> places;
    std::vector<transport::ColourBlock> blocks;
    for (std::size_t column = 0; column < columns; ++column) {
      if (random.uniform() >= density) continue;
      const auto place = static_cast<std::uint32_t>(column);
      const Eigen::Vector3f factor(random.uniformFloat(), random.uniformFloat(), random.uniformFloat());
      places.push_back(place);
      blocks.push_back(mixing[kinds.kindOf(place)] * factor.asDiagonal());
    }
    encoder.encode(places, blocks, encoded);
    writer.add(encoded);
  }
  RandomBlocks result{writer.build(), {}};
  result.dense = denseOf(result.sparse);
  return result;
}

inline Stack randomStack(std::size_t pixels, std::uint64_t seed) {
  Random random{seed};
  Stack stack(3 * pixels);
  for (float& value : stack) value = random.uniformFloat();
  return stack;
}

inline Eigen::VectorXd vectorOf(const Stack& stack) {
  return Eigen::Map<const Eigen::VectorXf>(stack.data(), static_cast<Eigen::Index>(stack.size()))
      .cast<double>();
}

}  // namespace relucent
