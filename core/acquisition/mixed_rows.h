// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/transport/block_sparse.h"

namespace relucent::acquisition {

/// `first`, with the rows of `second`, which has own colours, that are chosen. In the form of `first`.
/// Shapes: rows and columns of both alike; a flag and a full scale for each row.
transport::BlockSparse mixedRows(const transport::BlockSparse& first, const transport::BlockSparse& second,
                                 const std::vector<std::uint8_t>& chosen,
                                 const std::vector<float>& fullScale);

}  // namespace relucent::acquisition
