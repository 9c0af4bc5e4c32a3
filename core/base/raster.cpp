// SPDX-License-Identifier: MIT
#include "relucent/base/raster.h"

#include "relucent/base/require.h"

namespace relucent {

Rasters::Rasters(std::vector<Size> sizes) : sizes_(std::move(sizes)) {
  offsets_.push_back(0);
  for (const Size& size : sizes_) {
    require(!size.empty(), "a raster of {}x{} pixels holds nothing", size.width, size.height);
    offsets_.push_back(offsets_.back() + size.count());
  }
}

Rasters::Rasters(Size single) : Rasters(std::vector<Size>{single}) {}

}  // namespace relucent
