// SPDX-License-Identifier: MIT
#include "relucent/acquisition/mixed_rows.h"

#include "relucent/transport/shared_colours.h"

namespace relucent::acquisition {
namespace {

/// Where rows of `first` share their colours, those of `second` do as well.
transport::BlockSparse mixedSharing(const transport::BlockSparse& first, const transport::BlockSparse& second,
                                    const std::vector<std::uint8_t>& chosen,
                                    const transport::ColumnKinds& kinds) {
  transport::SharedColourWriter writer(first.columns(), first.rows(), kinds, first.blocks());
  transport::SharedColourEncoder encoder(kinds);
  transport::SharedColourRow encoded;
  std::vector<transport::ColourBlock> blocks;
  for (std::size_t row = 0; row < first.rows(); ++row) {
    if (!chosen[row]) {
      writer.add(first.sharedRow(row));
      continue;
    }
    blocks.clear();
    for (std::size_t entry = second.rowBegin(row); entry < second.rowBegin(row + 1); ++entry)
      blocks.push_back(second.block(row, entry));
    encoder.encode(second.columnsOf(row), blocks, encoded);
    writer.add(encoded);
  }
  return writer.build();
}

}  // namespace

transport::BlockSparse mixedRows(const transport::BlockSparse& first, const transport::BlockSparse& second,
                                 const std::vector<std::uint8_t>& chosen,
                                 const std::vector<float>& fullScale) {
  if (const transport::ColumnKinds* kinds = first.sharedColours())
    return mixedSharing(first, second, chosen, *kinds);
  transport::BlockSparseWriter writer(first.columns(), fullScale, first.blocks());
  for (std::size_t row = 0; row < first.rows(); ++row) {
    const transport::BlockSparse& from = chosen[row] ? second : first;
    for (std::size_t entry = from.rowBegin(row); entry < from.rowBegin(row + 1); ++entry)
      writer.add(from.column(entry), from.code(entry));
    writer.endRow();
  }
  return writer.build();
}

}  // namespace relucent::acquisition
