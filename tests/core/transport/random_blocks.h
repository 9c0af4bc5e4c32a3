// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "relucent/base/random.h"
#include "relucent/transport/block_sparse.h"

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
