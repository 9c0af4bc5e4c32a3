// SPDX-License-Identifier: MIT
#include "relucent/transport/block_sparse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/block_kernels.h"

namespace relucent::transport {
namespace {

constexpr float largestCode = 32767.0f;
// A fixed number of private sums makes the transposed product the same for every number of threads. Each
// costs the memory of the columns that it adds to; eight threads use up the bandwidth of most machines.
constexpr std::size_t scatterParts = 8;
constexpr std::size_t rowsOfGather = 256;

using Code = std::array<std::int16_t, 9>;

/// Sorts one row's entries by column, adds up entries of the same column (saturating), and returns how
/// many are left.
std::size_t sortAndMerge(std::uint32_t* column, Code* code, std::size_t count) {
  std::vector<std::pair<std::uint32_t, Code>> row(count);
  for (std::size_t i = 0; i < count; ++i) row[i] = {column[i], code[i]};
  std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

  std::size_t left = 0;
  for (const auto& [place, values] : row) {
    if (left == 0 || column[left - 1] != place) {
      column[left] = place;
      code[left] = values;
      ++left;
      continue;
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      code[left - 1][k] = static_cast<std::int16_t>(std::clamp(code[left - 1][k] + values[k], -32767, 32767));
  }
  return left;
}

}  // namespace

BlockSparse BlockSparse::assembled(std::size_t columns, std::vector<std::size_t> rowStart,
                                   LargeVector<std::uint32_t> column, LargeVector<Code> code,
                                   std::vector<float> scale) {
  require(rowStart.size() == scale.size() + 1 && rowStart.front() == 0 && rowStart.back() == column.size() &&
              column.size() == code.size(),
          "{} row starts, {} columns and {} blocks for {} rows", rowStart.size(), column.size(), code.size(),
          scale.size());
  BlockSparse result;
  result.columns_ = columns;
  result.rowStart_ = std::move(rowStart);
  result.column_ = std::move(column);
  result.code_ = std::move(code);
  result.scale_ = std::move(scale);
  return result;
}

std::size_t BlockSparse::bytes() const {
  return column_.size() * sizeof(std::uint32_t) + code_.size() * sizeof(code_[0]) +
         factor_.size() * sizeof(factor_[0]) + mixing_.size() * sizeof(ColourBlock) +
         rowStart_.size() * sizeof(std::size_t) + scale_.size() * sizeof(float);
}

std::size_t BlockSparse::bytesOfBlock() const {
  return sizeof(std::uint32_t) + (sharedColours() ? sizeof(factor_[0]) : sizeof(code_[0]));
}

ColourBlock BlockSparse::block(std::size_t row, std::size_t entry) const {
  if (sharedColours()) {
    const std::array<std::int16_t, 3>& code = factor_[entry];
    const ColourBlock& colours = mixing(row, kinds_.kindOf(column_[entry]));
    return colours * Eigen::Vector3f(code[0], code[1], code[2]).asDiagonal();
  }
  ColourBlock block;
  for (int i = 0; i < 9; ++i)
    block.data()[i] = scale_[row] * static_cast<float>(code_[entry][static_cast<std::size_t>(i)]);
  return block;
}

BlockSize BlockSparse::sizeOf(std::size_t row, std::size_t entry) const {
  if (sharedColours()) {
    const ColourBlock magnitudes = block(row, entry).cwiseAbs();
    return {magnitudes.maxCoeff(), magnitudes.sum()};
  }
  int largest = 0, sum = 0;
  for (std::int16_t value : code_[entry]) {
    const int magnitude = std::abs(static_cast<int>(value));
    largest = std::max(largest, magnitude);
    sum += magnitude;
  }
  return {scale_[row] * static_cast<float>(largest), scale_[row] * static_cast<float>(sum)};
}

SharedColourRow BlockSparse::sharedRow(std::size_t row) const {
  const std::span<const std::uint32_t> columns = columnsOf(row);
  const auto* first = factor_.data() + rowStart_[row];
  const ColourBlock* colours = mixing_.data() + row * kinds_.count;
  return {
      {columns.begin(), columns.end()}, {first, first + columns.size()}, {colours, colours + kinds_.count}};
}

BlockRows BlockSparse::view() const {
  return {rowStart_.data(),
          column_.data(),
          code_.data(),
          scale_.data(),
          columns_,
          factor_.data(),
          mixing_.empty() ? nullptr : mixing_.front().data(),
          kinds_.ranges,
          kinds_.count};
}

Stack BlockSparse::multiply(const Stack& x) const {
  require(x.size() == 3 * columns_, "a vector of {} values for {} block columns", x.size(), columns_);
  Stack y(3 * rows());
  parallelChunks(0, rows(), (rows() + rowsOfGather - 1) / rowsOfGather,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   blockKernels().back().gather(view(), begin, end, x.data(), y.data());
                 });
  return y;
}

Stack BlockSparse::multiplyTransposed(const Stack& y) const {
  require(y.size() == 3 * rows(), "a vector of {} values for {} block rows", y.size(), rows());
  std::array<ColumnSums, scatterParts> parts;
  parallelFor(0, scatterParts, 1, [&](std::size_t part) {
    parts[part] = ColumnSums(columns_);
    blockKernels().back().scatter(view(), rowAtShare(part), rowAtShare(part + 1), y.data(), parts[part]);
  });

  Stack x(3 * columns_);
  parallelFor(0, parts[0].tiles(), 4, [&](std::size_t tile) {
    std::size_t begin = tile * ColumnSums::tileColumns;
    std::size_t end = std::min(begin + ColumnSums::tileColumns, columns_);
    for (const ColumnSums& part : parts) {
      const float* sums = part.tile(tile);
      if (sums == nullptr) continue;
      for (std::size_t column = begin; column < end; ++column, sums += 4)
        for (std::size_t c = 0; c < 3; ++c) x[3 * column + c] += sums[c];
    }
  });
  return x;
}

float BlockSparse::stepOf(std::span<const ColourBlock> mixing) {
  float step = 0.0f;
  for (const ColourBlock& colours : mixing) step += colours.cwiseAbs().sum();
  return step;
}

std::size_t BlockSparse::rowAtShare(std::size_t part) const {
  if (part == scatterParts) return rows();
  std::size_t entry = blocks() * part / scatterParts;
  return static_cast<std::size_t>(std::lower_bound(rowStart_.begin(), rowStart_.end() - 1, entry) -
                                  rowStart_.begin());
}

BlockSparse BlockSparse::transposed() const {
  std::vector<float> fullScale(columns_, 0.0f);
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry) {
      float& scale = fullScale[column_[entry]];
      scale = std::max(scale, sizeOf(row, entry).largest);
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
  if (sharedColours()) {
    parallelFor(0, rows(), 256, [&](std::size_t row) {
      const Eigen::Map<const Eigen::Vector3f> factors(&factor[3 * row]);
      const std::span<ColourBlock> mixing(&result.mixing_[row * kinds_.count], kinds_.count);
      for (ColourBlock& colours : mixing) colours = factors.asDiagonal() * colours;
      result.scale_[row] = stepOf(mixing);
    });
    return result;
  }
  parallelFor(0, rows(), 256, [&](std::size_t row) {
    float largest =
        std::max({std::abs(factor[3 * row]), std::abs(factor[3 * row + 1]), std::abs(factor[3 * row + 2])});
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

BlockSparse BlockSparse::withBlocksScaled(const ColumnKinds& kinds, const BlockFactor& factor) const& {
  BlockSparse result = *this;
  result.scaleBlocks(kinds, factor);
  return result;
}

BlockSparse BlockSparse::withBlocksScaled(const ColumnKinds& kinds, const BlockFactor& factor) && {
  scaleBlocks(kinds, factor);
  return std::move(*this);
}

void BlockSparse::scaleBlocks(const ColumnKinds& kinds, const BlockFactor& factor) {
  if (sharedColours()) {
    std::vector<std::uint32_t> kindOf(kinds_.count, 0);
    for (std::size_t i = 0; i < kinds_.ranges.size(); ++i)
      kindOf[kinds_.ranges[i].kind] = kinds.kindOf(i == 0 ? 0 : kinds_.ranges[i - 1].end);
    parallelFor(0, rows(), 256, [&](std::size_t row) {
      const std::span<ColourBlock> mixing(&mixing_[row * kinds_.count], kinds_.count);
      for (std::size_t kind = 0; kind < mixing.size(); ++kind)
        mixing[kind] = mixing[kind].cwiseProduct(factor(row, kindOf[kind]));
      scale_[row] = stepOf(mixing);
    });
    return;
  }
  parallelFor(0, rows(), 256, [&](std::size_t row) {
    std::vector<ColourBlock> factors;
    float largest = 0.0f;
    for (std::size_t kind = 0; kind < kinds.count; ++kind) {
      factors.push_back(factor(row, kind));
      largest = std::max(largest, factors.back().cwiseAbs().maxCoeff());
    }
    // The largest factor goes into the row's scale, so codes only ever shrink.
    scale_[row] *= largest;
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry) {
      const ColourBlock& of = factors[kinds.kindOf(column_[entry])];
      for (std::size_t i = 0; i < 9; ++i)
        code_[entry][i] = largest == 0.0f
                              ? std::int16_t{0}
                              : static_cast<std::int16_t>(std::lround(static_cast<float>(code_[entry][i]) *
                                                                      (of.data()[i] / largest)));
    }
  });
}

BlockSparse BlockSparse::filtered(const std::function<bool(std::size_t row, std::size_t entry)>& keep) const {
  std::vector<std::uint8_t> kept(blocks());
  parallelFor(0, rows(), 256, [&](std::size_t row) {
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry)
      kept[entry] = keep(row, entry) ? 1 : 0;
  });
  return filtered(kept);
}

BlockSparse BlockSparse::filtered(const std::vector<std::uint8_t>& keep) const {
  require(keep.size() == blocks(), "{} marks for {} blocks", keep.size(), blocks());
  BlockSparse result;
  result.columns_ = columns_;
  result.scale_ = scale_;
  result.kinds_ = kinds_;
  result.mixing_ = mixing_;
  result.rowStart_.assign(rows() + 1, 0);
  parallelFor(0, rows(), 256, [&](std::size_t row) {
    for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry)
      result.rowStart_[row + 1] += keep[entry] != 0 ? 1 : 0;
  });
  for (std::size_t row = 0; row < rows(); ++row) result.rowStart_[row + 1] += result.rowStart_[row];

  result.column_.resize(result.rowStart_.back());
  auto keepOf = [&](const auto& values, auto& into) {
    if (values.empty()) return;
    into.resize(result.rowStart_.back());
    parallelFor(0, rows(), 256, [&](std::size_t row) {
      std::size_t next = result.rowStart_[row];
      for (std::size_t entry = rowStart_[row]; entry < rowStart_[row + 1]; ++entry)
        if (keep[entry] != 0) into[next++] = values[entry];
    });
  };
  keepOf(column_, result.column_);
  keepOf(code_, result.code_);
  keepOf(factor_, result.factor_);
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
  Entry entry{static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column),
              codeOf(block, scale_[row])};
  if (entry.code != Code{}) entries_.push_back(entry);
}

BlockSparse BlockSparseBuilder::build() {
  BlockSparse result;
  result.columns_ = columns_;
  result.scale_ = std::move(scale_);
  std::vector<std::size_t> start(result.scale_.size() + 1, 0);
  for (const Entry& entry : entries_) ++start[entry.row + 1];
  for (std::size_t row = 1; row < start.size(); ++row) start[row] += start[row - 1];

  // Straight into the result's arrays, in rows but unsorted within: at full scale a sorted copy of the
  // entries would be another gigabyte.
  result.column_.resize(entries_.size());
  result.code_.resize(entries_.size());
  {
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (const Entry& entry : entries_) {
      std::size_t place = next[entry.row]++;
      result.column_[place] = entry.column;
      result.code_[place] = entry.code;
    }
  }
  entries_ = {};
  columns_ = 0;

  // Each row is sorted and its repeated columns are added up, at the front of its own range.
  std::vector<std::size_t> length(start.size() - 1);
  parallelFor(0, length.size(), 256, [&](std::size_t row) {
    length[row] = sortAndMerge(result.column_.data() + start[row], result.code_.data() + start[row],
                               start[row + 1] - start[row]);
  });

  result.rowStart_.assign(1, 0);
  result.rowStart_.reserve(start.size());
  for (std::size_t row = 0; row < length.size(); ++row) {
    auto from = static_cast<std::ptrdiff_t>(start[row]);
    auto end = from + static_cast<std::ptrdiff_t>(length[row]);
    auto to = static_cast<std::ptrdiff_t>(result.rowStart_.back());
    if (from != to) {
      std::copy(result.column_.begin() + from, result.column_.begin() + end, result.column_.begin() + to);
      std::copy(result.code_.begin() + from, result.code_.begin() + end, result.code_.begin() + to);
    }
    result.rowStart_.push_back(result.rowStart_.back() + length[row]);
  }
  result.column_.resize(result.rowStart_.back());
  result.code_.resize(result.rowStart_.back());
  return result;
}

BlockSparseWriter::BlockSparseWriter(std::size_t columns, std::vector<float> fullScale, std::size_t blocks) {
  require(columns <= std::numeric_limits<std::uint32_t>::max(),
          "{} block columns are more than 32-bit indices hold", columns);
  result_.columns_ = columns;
  result_.scale_ = std::move(fullScale);
  for (float& scale : result_.scale_) scale /= largestCode;
  result_.rowStart_.reserve(result_.scale_.size() + 1);
  result_.column_.reserve(blocks);
  result_.code_.reserve(blocks);
}

void BlockSparseWriter::add(std::size_t column, const Code& code) {
  require(column < result_.columns_, "column {} of {}", column, result_.columns_);
  if (code == Code{}) return;
  result_.column_.push_back(static_cast<std::uint32_t>(column));
  result_.code_.push_back(code);
}

void BlockSparseWriter::endRow() {
  require(result_.rows() < result_.scale_.size(), "all {} rows have been written", result_.scale_.size());
  std::size_t begin = result_.rowStart_.back();
  std::size_t left = begin + sortAndMerge(result_.column_.data() + begin, result_.code_.data() + begin,
                                          result_.column_.size() - begin);
  result_.column_.resize(left);
  result_.code_.resize(left);
  result_.rowStart_.push_back(left);
}

BlockSparse BlockSparseWriter::build() {
  require(result_.rows() == result_.scale_.size(), "{} of {} rows have been written", result_.rows(),
          result_.scale_.size());
  return std::exchange(result_, {});
}

BlockSparseWriter::Code codeOf(const ColourBlock& block, float scale) {
  BlockSparseWriter::Code code{};
  if (scale <= 0.0f) return code;
  for (std::size_t i = 0; i < 9; ++i)
    code[i] =
        static_cast<std::int16_t>(std::clamp(std::round(block.data()[i] / scale), -largestCode, largestCode));
  return code;
}

}  // namespace relucent::transport
