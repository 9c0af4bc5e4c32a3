// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/transport/node_layout.h"
#include "relucent/venue/spectra.h"

namespace relucent::venue {

/// One camera pixel's light transport while it is being traced: a sum of spectra per node of the
/// projectors' mean pyramids.
class TransportRow {
 public:
  struct Entry {
    transport::Node node;
    Spectrum transport;
  };

  TransportRow();
  void clear();
  void add(const transport::Node& node, const Spectrum& transport);
  const std::vector<Entry>& entries() const { return entries_; }

  /// Merges siblings that together are less than `share` of the row into their parent, starting from the
  /// finest level that may be merged: insignificant light is not resolved. Energy is preserved.
  /// Nodes of levels below `finest` and of each projector's `coarsest` level stay.
  void condense(float share, int finest, int coarsest);

 private:
  std::size_t slotOf(const transport::Node& node) const;
  void grow();

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> slots_;  // index into entries_ plus one; 0: free
};

}  // namespace relucent::venue
