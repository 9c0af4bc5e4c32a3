// SPDX-License-Identifier: MIT
#include "relucent/pipeline/projection.h"

#include <cmath>

#include "relucent/base/error.h"
#include "relucent/image/resample.h"

namespace relucent::pipeline {

std::vector<image::Image> encodedDrive(const ProjectorStack& linear, const Rasters& projectors,
                                       const linearization::Linearization& linearization) {
  require(linearization.projectors.size() == projectors.devices(), "{} responses for {} projectors",
          linearization.projectors.size(), projectors.devices());
  std::vector<image::Image> drive;
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector)
    drive.push_back(
        linearization.projectors[projector].encode(image::imageFromStack(linear, projectors, projector)));
  return drive;
}

std::vector<image::Image> codedDrive(const ProjectorStack& linear, const Rasters& projectors,
                                     const linearization::Linearization& linearization) {
  constexpr float codes = 255.0f;
  std::vector<image::Image> drive = encodedDrive(linear, projectors, linearization);
  for (image::Image& one : drive)
    for (float& value : one.data()) value = std::round(value * codes) / codes;
  return drive;
}

ProjectorStack lightOf(const std::vector<image::Image>& drive, const Rasters& projectors,
                       const linearization::Linearization& linearization) {
  std::vector<image::Image> light;
  for (std::size_t projector = 0; projector < drive.size(); ++projector)
    light.push_back(linearization.projectors[projector].decode(drive[projector]));
  return ProjectorStack(image::stackFromImages(light, projectors));
}

Stack patternFrom(const image::Image& linearContent, const Rasters& projectors) {
  std::vector<image::Image> patterns;
  for (const Size& size : projectors.sizes()) patterns.push_back(image::resized(linearContent, size));
  return image::stackFromImages(patterns, projectors);
}

}  // namespace relucent::pipeline
