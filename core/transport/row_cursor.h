// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace relucent::transport {

/// Steps through the rows of ascending entries.
class RowCursor {
 public:
  template <typename RowBegin>
  std::size_t rowOf(std::uint64_t entry, const RowBegin& rowBegin) {
    if (entry < rowBegin(row_)) row_ = 0;
    while (entry >= rowBegin(row_ + 1)) ++row_;
    return row_;
  }

 private:
  std::size_t row_ = 0;
};

}  // namespace relucent::transport
