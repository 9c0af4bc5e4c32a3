// SPDX-License-Identifier: MIT
#include "relucent/rig/shot_bytes.h"

namespace relucent::rig {

std::uint64_t plainBytes(const Shot& shot) {
  std::uint64_t bytes = 0;
  for (const std::vector<RawFrame>& exposure : shot.frames)
    for (const RawFrame& frame : exposure) {
      const std::uint64_t each = frame.bits < 1 || frame.bits > 16 ? 4 : frame.bits <= 8 ? 1 : 2;
      bytes += each * frame.signal.data().size();
    }
  return bytes;
}

}  // namespace relucent::rig
