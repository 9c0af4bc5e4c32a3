// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::acquisition {

/// `first`, with the rows of `second` that are chosen. In the form of `first`; what has own colours keeps its
/// codes.  Shapes: rows and columns of both alike; a flag for each row.
transport::BlockSparse mixedRows(const transport::BlockSparse& first, const transport::BlockSparse& second,
                                 const std::vector<std::uint8_t>& chosen);
/// The same of whole transport matrices. Chosen camera pixels leave the groups of `first`, and have all their
/// leaves for themselves. Contract: `second` has no groups.
transport::TransportMatrix mixedRows(const transport::TransportMatrix& first,
                                     const transport::TransportMatrix& second,
                                     const std::vector<std::uint8_t>& chosen);
/// The same of what is known of rows, three values each.
void replaceRows(Stack& into, const Stack& from, const std::vector<std::uint8_t>& chosen);

}  // namespace relucent::acquisition
