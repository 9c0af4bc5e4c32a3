// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/pattern.h"

#include "relucent/base/parallel.h"
#include "relucent/base/random.h"

namespace relucent::multiplexing {

ProjectorStack blockPattern(const Rasters& projectors, int level, int number, std::uint64_t seed) {
  constexpr std::uint64_t purpose = 0x6d756c7469ULL;  // other bits than those of other users of the seed
  ProjectorStack pattern(3 * projectors.count());
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    Size size = projectors.size(projector);
    parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t y) {
      std::size_t row = projectors.offset(projector) + indexOf(size, {0, static_cast<int>(y)});
      std::uint64_t bits = 0;
      for (int x = 0; x < size.width; ++x) {
        if (x % (1 << level) == 0)
          bits = Random{seed,
                        purpose,
                        static_cast<std::uint64_t>(level),
                        static_cast<std::uint64_t>(number),
                        projector,
                        y >> level,
                        static_cast<std::uint64_t>(x >> level)}
                     .next();
        for (std::size_t c = 0; c < 3; ++c)
          pattern[3 * (row + static_cast<std::size_t>(x)) + c] = static_cast<float>(bits >> (61 + c) & 1);
      }
    });
  }
  return pattern;
}

}  // namespace relucent::multiplexing
