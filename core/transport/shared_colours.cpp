// SPDX-License-Identifier: MIT
#include "relucent/transport/shared_colours.h"

#include <algorithm>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/signed_codes.h"

namespace relucent::transport {
void SharedColourEncoder::encode(std::span<const std::uint32_t> columns, std::span<const ColourBlock> blocks,
                                 SharedColourRow& row) {
  row.column.clear();
  row.factor.clear();
  row.mixing.assign(kinds_.count, ColourBlock::Zero());
  ColourBlock all = ColourBlock::Zero();
  std::vector<Eigen::Array3f> magnitude(kinds_.count, Eigen::Array3f::Zero());
  kind_.resize(blocks.size());
  std::size_t range = 0;
  for (std::size_t j = 0; j < blocks.size(); ++j) {
    while (columns[j] >= kinds_.ranges[range].end) ++range;
    kind_[j] = kinds_.ranges[range].kind;
    row.mixing[kind_[j]] += blocks[j];
    all += blocks[j];
    magnitude[kind_[j]] += blocks[j].colwise().norm().transpose().array();
  }
  for (std::size_t kind = 0; kind < kinds_.count; ++kind)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (row.mixing[kind].col(k).norm() < cancelledShare * magnitude[kind][k])
        row.mixing[kind].col(k) = all.col(k);

  factor_.resize(blocks.size());
  std::vector<float> largest(kinds_.count, 0.0f);
  for (std::size_t j = 0; j < blocks.size(); ++j) {
    const ColourBlock& colours = row.mixing[kind_[j]];
    for (Eigen::Index k = 0; k < 3; ++k) {
      const float square = colours.col(k).squaredNorm();
      factor_[j][k] = square > 0.0f ? colours.col(k).dot(blocks[j].col(k)) / square : 0.0f;
    }
    largest[kind_[j]] = std::max(largest[kind_[j]], factor_[j].cwiseAbs().maxCoeff());
  }
  std::vector<Eigen::Array3f> rest(kinds_.count, Eigen::Array3f::Zero());
  for (std::size_t j = 0; j < blocks.size(); ++j) {
    const std::uint32_t kind = kind_[j];
    if (!(largest[kind] > 0.0f)) continue;
    Eigen::Array3f wanted = factor_[j].array() * (largestCode / largest[kind]) + rest[kind];
    Eigen::Array3f code = wanted.round().max(-largestCode).min(largestCode);
    rest[kind] = wanted - code;
    if ((code == 0.0f).all()) continue;
    row.column.push_back(columns[j]);
    row.factor.push_back({static_cast<std::int16_t>(code[0]), static_cast<std::int16_t>(code[1]),
                          static_cast<std::int16_t>(code[2])});
  }
  for (std::size_t kind = 0; kind < kinds_.count; ++kind) row.mixing[kind] *= largest[kind] / largestCode;
}

SharedColourWriter::SharedColourWriter(std::size_t columns, std::size_t rows, ColumnKinds kinds,
                                       std::size_t blocks)
    : rows_(rows) {
  require(!kinds.ranges.empty() && kinds.ranges.back().end == columns, "kinds of {} columns for {}",
          kinds.ranges.empty() ? 0 : kinds.ranges.back().end, columns);
  result_.columns_ = columns;
  result_.kinds_ = std::move(kinds);
  result_.rowStart_.reserve(rows + 1);
  result_.scale_.reserve(rows);
  result_.mixing_.reserve(rows * result_.kinds_.count);
  result_.column_.reserve(blocks);
  result_.factor_.reserve(blocks);
}

void SharedColourWriter::add(const SharedColourRow& row) {
  require(result_.rows() < rows_, "all {} rows have been written", rows_);
  result_.column_.insert(result_.column_.end(), row.column.begin(), row.column.end());
  result_.factor_.insert(result_.factor_.end(), row.factor.begin(), row.factor.end());
  result_.mixing_.insert(result_.mixing_.end(), row.mixing.begin(), row.mixing.end());
  result_.scale_.push_back(BlockSparse::stepOf(row.mixing));
  result_.rowStart_.push_back(result_.column_.size());
}

BlockSparse SharedColourWriter::build() {
  require(result_.rows() == rows_, "{} of {} rows have been written", result_.rows(), rows_);
  return std::exchange(result_, {});
}

}  // namespace relucent::transport
