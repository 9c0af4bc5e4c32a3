// SPDX-License-Identifier: MIT
#include "relucent/acquisition/mixed_rows.h"

#include <algorithm>
#include <utility>

#include "relucent/base/parallel.h"
#include "relucent/base/require.h"
#include "relucent/base/signed_codes.h"
#include "relucent/transport/shared_colours.h"

namespace relucent::acquisition {
namespace {

/// Where rows of `first` share their colours, those of `second` do as well.
transport::BlockSparse mixedSharing(const transport::BlockSparse& first, const transport::BlockSparse& second,
                                    const std::vector<std::uint8_t>& chosen,
                                    const transport::ColumnKinds& kinds) {
  constexpr std::size_t rowsAtOnce = 16384, grain = 256;
  transport::SharedColourWriter writer(first.columns(), first.rows(), kinds, first.blocks());
  std::vector<transport::SharedColourRow> written(std::min(rowsAtOnce, first.rows()));
  for (std::size_t begin = 0; begin < first.rows(); begin += rowsAtOnce) {
    const std::size_t count = std::min(rowsAtOnce, first.rows() - begin);
    parallelFor(0, (count + grain - 1) / grain, 1, [&](std::size_t part) {
      transport::SharedColourEncoder encoder(kinds);
      std::vector<transport::ColourBlock> blocks;
      for (std::size_t i = part * grain; i < std::min((part + 1) * grain, count); ++i) {
        const std::size_t row = begin + i;
        if (!chosen[row]) {
          written[i] = first.sharedRow(row);
          continue;
        }
        blocks.clear();
        for (std::size_t entry = second.rowBegin(row); entry < second.rowBegin(row + 1); ++entry)
          blocks.push_back(second.block(row, entry));
        encoder.encode(second.columnsOf(row), blocks, written[i]);
      }
    });
    for (std::size_t i = 0; i < count; ++i) writer.add(written[i]);
  }
  return writer.build();
}

/// The step of a row's codes.
float stepOf(const transport::BlockSparse& of, std::size_t row) {
  if (!of.sharedColours()) return of.scale(row);
  float largest = 0.0f;
  for (std::size_t entry = of.rowBegin(row); entry < of.rowBegin(row + 1); ++entry)
    largest = std::max(largest, of.sizeOf(row, entry).largest);
  return largest / largestCode;
}

transport::BlockSparse mixedOwn(const transport::BlockSparse& first, const transport::BlockSparse& second,
                                const std::vector<std::uint8_t>& chosen) {
  std::vector<std::size_t> rowStart{0};
  LargeVector<std::uint32_t> column;
  LargeVector<transport::BlockSparseWriter::Code> code;
  std::vector<float> scale;
  column.reserve(first.blocks());
  code.reserve(first.blocks());
  for (std::size_t row = 0; row < first.rows(); ++row) {
    const transport::BlockSparse& from = chosen[row] ? second : first;
    scale.push_back(stepOf(from, row));
    for (std::size_t entry = from.rowBegin(row); entry < from.rowBegin(row + 1); ++entry) {
      column.push_back(from.column(entry));
      code.push_back(from.sharedColours() ? transport::codeOf(from.block(row, entry), scale.back())
                                          : from.code(entry));
    }
    rowStart.push_back(column.size());
  }
  return transport::BlockSparse::assembled(first.columns(), std::move(rowStart), std::move(column),
                                           std::move(code), std::move(scale));
}

}  // namespace

transport::BlockSparse mixedRows(const transport::BlockSparse& first, const transport::BlockSparse& second,
                                 const std::vector<std::uint8_t>& chosen) {
  const transport::ColumnKinds* kinds = first.sharedColours();
  return kinds ? mixedSharing(first, second, chosen, *kinds) : mixedOwn(first, second, chosen);
}

transport::TransportMatrix mixedRows(const transport::TransportMatrix& first,
                                     const transport::TransportMatrix& second,
                                     const std::vector<std::uint8_t>& chosen) {
  require(second.groups().empty(), "rows of a T with groups");
  return {first.cameras(), first.projectors(), mixedRows(first.ownLeaves(), second.ownLeaves(), chosen),
          first.groups().without(chosen)};
}

void replaceRows(Stack& into, const Stack& from, const std::vector<std::uint8_t>& chosen) {
  for (std::size_t i = 0; i < into.size(); ++i)
    if (chosen[i / 3]) into[i] = from[i];
}

}  // namespace relucent::acquisition
