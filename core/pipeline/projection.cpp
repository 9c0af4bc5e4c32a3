// SPDX-License-Identifier: MIT
#include "pipeline/projection.h"

#include "base/error.h"
#include "image/resample.h"

namespace relucent {

std::vector<Image> encodedDrive(const Stack& linear, const Rasters& projectors,
                                const Linearization& linearization) {
  require(linearization.projectors.size() == projectors.devices(), "{} responses for {} projectors",
          linearization.projectors.size(), projectors.devices());
  std::vector<Image> drive;
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector)
    drive.push_back(
        linearization.projectors[projector].encode(imageFromStack(linear, projectors, projector)));
  return drive;
}

Stack patternFrom(const Image& linearContent, const Rasters& projectors) {
  std::vector<Image> patterns;
  for (const Size& size : projectors.sizes()) patterns.push_back(resized(linearContent, size));
  return stackFromImages(patterns, projectors);
}

}  // namespace relucent
