// SPDX-License-Identifier: MIT
#include "transport/block_sparse.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

constexpr float largestCode = 32767.0f;
// A fixed number of private sums makes the transposed product the same for every number of threads.
constexpr std::size_t scatterChunks = 4;

}  // namespace

std::size_t BlockSparse::bytes() const {
  return column_.size() * sizeof(std::uint32_t) + code_.size() * sizeof(code_[0]) +
         rowStart_.size() * sizeof(std::size_t) + scale_.size() * sizeof(float);
}

ColourBlock BlockSparse::block(std::size_t row, std::size_t entry) const {
  ColourBlock block;
  for (int i = 0; i < 9; ++i)
    block.data()[i] = scale_[row] * static_cast<float>(code_[entry][static_cast<std::size_t>(i)]);
  return block;
}

Stack BlockSparse::multiply(const Stack& x) const {
  require(x.size() == 3 * columns_, "a vector of {} values for {} block columns", x.size(), columns_);
  Stack y(3 * rows());
  parallelFor(0, rows(), 256, [&](std::size_t row) {
    float sum[3] = {0, 0, 0};
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry) {
      const float* in = &x[3 * static_cast<std::size_t>(column_[entry])];
      const auto& code = code_[entry];
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += static_cast<float>(code[3 * c]) * in[0] + static_cast<float>(code[3 * c + 1]) * in[1] +
                  static_cast<float>(code[3 * c + 2]) * in[2];
    }
    for (std::size_t c = 0; c < 3; ++c) y[3 * row + c] = scale_[row] * sum[c];
  });
  return y;
}

Stack BlockSparse::multiplyTransposed(const Stack& y) const {
  require(y.size() == 3 * rows(), "a vector of {} values for {} block rows", y.size(), rows());
  std::vector<Stack> partial(scatterChunks);
  parallelChunks(0, rows(), scatterChunks, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Stack& x = partial[chunk];
    for (std::size_t row = begin; row < end; ++row) {
      float in[3];
      for (std::size_t c = 0; c < 3; ++c) in[c] = scale_[row] * y[3 * row + c];
      if (in[0] == 0.0f && in[1] == 0.0f && in[2] == 0.0f) continue;
      if (x.empty()) x.resize(3 * columns_);
      for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry) {
        float* out = &x[3 * static_cast<std::size_t>(column_[entry])];
        const auto& code = code_[entry];
        for (std::size_t p = 0; p < 3; ++p)
          out[p] += static_cast<float>(code[p]) * in[0] + static_cast<float>(code[3 + p]) * in[1] +
                    static_cast<float>(code[6 + p]) * in[2];
      }
    }
  });
  Stack sum(3 * columns_);
  for (const Stack& x : partial) {
    if (x.empty()) continue;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += x[i];
  }
  return sum;
}

BlockSparse BlockSparse::transposed() const {
  std::vector<float> fullScale(columns_, 0.0f);
  for (std::size_t row = 0; row < rows(); ++row) {
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry) {
      int largest = 0;
      for (std::int16_t code : code_[entry]) largest = std::max(largest, std::abs(static_cast<int>(code)));
      float& scale = fullScale[column_[entry]];
      scale = std::max(scale, scale_[row] * static_cast<float>(largest));
    }
  }
  BlockSparseBuilder builder(rows(), std::move(fullScale));
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry)
      builder.add(column_[entry], row, block(row, entry).transpose());
  return builder.build();
}

BlockSparse BlockSparse::withRowsScaled(const Stack& factor) const {
  require(factor.size() == 3 * rows(), "{} factors for {} rows", factor.size(), rows());
  BlockSparse result = *this;
  parallelFor(0, rows(), 256, [&](std::size_t row) {
    float largest = std::max({std::abs(factor[3 * row]), std::abs(factor[3 * row + 1]),
                              std::abs(factor[3 * row + 2])});
    if (largest == 0.0f) {
      for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry) result.code_[entry] = {};
      return;
    }
    // The largest factor goes into the row's scale, so codes only ever shrink.
    result.scale_[row] = scale_[row] * largest;
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry)
      for (std::size_t i = 0; i < 9; ++i)
        result.code_[entry][i] = static_cast<std::int16_t>(
            std::lround(static_cast<float>(code_[entry][i]) * (factor[3 * row + i / 3] / largest)));
  });
  return result;
}

BlockSparseBuilder::BlockSparseBuilder(std::size_t columns, std::vector<float> fullScale)
    : columns_(columns), scale_(std::move(fullScale)) {
  require(columns <= std::numeric_limits<std::uint32_t>::max() &&
              scale_.size() <= std::numeric_limits<std::uint32_t>::max(),
          "{} x {} blocks are more than 32-bit indices hold", scale_.size(), columns);
  for (float& scale : scale_) scale /= largestCode;
}

void BlockSparseBuilder::add(std::size_t row, std::size_t column, const ColourBlock& block) {
  require(row < scale_.size() && column < columns_, "block ({}, {}) is outside {} x {}", row, column,
          scale_.size(), columns_);
  Entry entry{static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column), {}};
  bool zero = true;
  for (std::size_t i = 0; i < 9; ++i) {
    float code = scale_[row] > 0.0f ? std::round(block.data()[i] / scale_[row]) : 0.0f;
    entry.code[i] = static_cast<std::int16_t>(std::clamp(code, -largestCode, largestCode));
    zero = zero && entry.code[i] == 0;
  }
  if (!zero) entries_.push_back(entry);
}

BlockSparse BlockSparseBuilder::build() {
  BlockSparse result;
  result.columns_ = columns_;
  result.scale_ = std::move(scale_);
  std::vector<std::size_t> start(result.scale_.size() + 1, 0);
  for (const Entry& entry : entries_) ++start[entry.row + 1];
  for (std::size_t row = 1; row < start.size(); ++row) start[row] += start[row - 1];
  {
    std::vector<Entry> sorted(entries_.size());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (const Entry& entry : entries_) sorted[next[entry.row]++] = entry;
    entries_ = std::move(sorted);
  }
  parallelFor(0, start.size() - 1, 256, [&](std::size_t row) {
    std::stable_sort(entries_.begin() + static_cast<std::ptrdiff_t>(start[row]),
                     entries_.begin() + static_cast<std::ptrdiff_t>(start[row + 1]),
                     [](const Entry& a, const Entry& b) { return a.column < b.column; });
  });

  result.rowStart_.assign(1, 0);
  result.rowStart_.reserve(start.size());
  result.column_.reserve(entries_.size());
  result.code_.reserve(entries_.size());
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    for (std::size_t i = start[row]; i < start[row + 1]; ++i) {
      bool again = result.column_.size() > result.rowStart_.back() && result.column_.back() == entries_[i].column;
      if (!again) {
        result.column_.push_back(entries_[i].column);
        result.code_.push_back(entries_[i].code);
        continue;
      }
      for (std::size_t k = 0; k < 9; ++k)
        result.code_.back()[k] = static_cast<std::int16_t>(
            std::clamp(result.code_.back()[k] + entries_[i].code[k], -32767, 32767));
    }
    result.rowStart_.push_back(result.column_.size());
  }
  entries_ = {};
  columns_ = 0;
  return result;
}

}  // namespace relucent
