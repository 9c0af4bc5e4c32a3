// SPDX-License-Identifier: MIT
#include "relucent/rig/rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/rig/distinct_cameras.h"

namespace relucent::rig {
namespace {

template <typename Device>
Rasters rastersOf(const std::vector<std::unique_ptr<Device>>& devices) {
  std::vector<Size> sizes;
  for (const auto& device : devices) sizes.push_back(device->size());
  return Rasters(std::move(sizes));
}

/// Every value is looked at, whatever the others are: most photographs are in order, and so it takes least.
bool isFinite(const image::Image& image) {
  std::array<bool, fixedParts> parts{};
  parallelChunks(0, image.data().size(), fixedParts,
                 [&](std::size_t part, std::size_t begin, std::size_t end) {
                   bool all = true;
                   for (std::size_t i = begin; i < end; ++i) all &= std::isfinite(image.data()[i]);
                   parts[part] = all;
                 });
  return std::ranges::all_of(parts, std::identity());
}

}  // namespace

Rasters Rig::projectorRasters() const {
  return rastersOf(projectors);
}
Rasters Rig::cameraRasters() const {
  return rastersOf(cameras);
}

void checkDevices(const Rig& rig) {
  std::vector<std::string> names;
  for (const std::unique_ptr<Camera>& camera : rig.cameras) names.push_back(camera->name());
  requireDistinctCameras(names);
}

void requireDistinctCameras(const std::vector<std::string>& devices) {
  for (std::size_t camera = 1; camera < devices.size(); ++camera)
    for (std::size_t other = 0; other < camera; ++other)
      if (devices[camera] == devices[other])
        throw Error(
            ErrorKind::input,
            RELUCENT_ENGLISH_MESSAGE("device.two-cameras-are-one",
                                     "cameras {} and {} are the same device: both are {}")
                .with(as::label(other + 1), as::label(camera + 1), devices[camera]),
            RELUCENT_ENGLISH_MESSAGE("device.choose-other-camera",
                                     "choose another camera for one of them, by its own serial number"));
}

void checkFrame(const RawFrame& frame, Size size, const std::string& camera) {
  const image::Image& image = frame.signal;
  if (image.size() != size)
    throw Error(ErrorKind::input,
                RELUCENT_MESSAGE("device.photograph-size-unexpected",
                                 "the photograph has {} pixels where {} were announced")
                    .with(as::size(image.width(), image.height()), as::size(size)),
                RELUCENT_ENGLISH_MESSAGE(
                    "device.set-announced-size",
                    "set the camera to that size, or start again with the size that it delivers"),
                camera);
  if (image.channels() != 3)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("device.photograph-not-rgb", "the photograph has {} channels")
                    .with(image.channels()),
                RELUCENT_ENGLISH_MESSAGE("device.set-camera-to-colour",
                                         "set the camera to colour pictures (red, green, blue)"),
                camera);
  if (!isFinite(image)) {
    const auto notFinite = std::find_if(image.data().begin(), image.data().end(),
                                        [](float value) { return !std::isfinite(value); });
    Pixel place = pixelAt(size, static_cast<std::size_t>(notFinite - image.data().begin()) / 3);
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("device.photograph-not-finite", "the photograph holds {} at pixel {}, {}")
            .with(*notFinite, as::label(place.x), place.y),
        RELUCENT_ENGLISH_MESSAGE("device.check-writing-program",
                                 "check the program that writes it: every value must be a finite number"),
        camera);
  }
}

}  // namespace relucent::rig
