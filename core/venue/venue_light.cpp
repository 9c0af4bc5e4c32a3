// SPDX-License-Identifier: MIT
#include "relucent/venue/venue_light.h"

#include <numeric>

#include "relucent/base/error.h"

namespace relucent::venue {
namespace {

double mean(const Stack& stack) {
  return std::accumulate(stack.begin(), stack.end(), 0.0) / static_cast<double>(stack.size());
}

}  // namespace

VenueLight::VenueLight(const VenueSettings& settings, transport::NodeLayout layout, Rasters cameras,
                       TracedTransport traced, std::optional<float> asBright)
    : settings_(settings),
      layout_(std::move(layout)),
      cameras_(std::move(cameras)),
      projectorModel_(settings.devices),
      cameraByNode_(std::move(traced.cameraByNode)),
      ambient_(std::move(traced.roomLight)) {
  ProjectorStack white(3 * layout_.projectors().count(), 1.0f), leak = white;
  for (std::size_t i = 0; i < leak.size(); ++i) leak[i] = projectorModel_.black()[i % 3];
  projectorBlack_ = CameraStack(cameraByNode_.multiplyTransposed(layout_.means(leak)));

  double flood = mean(cameraByNode_.multiplyTransposed(layout_.means(white)));
  double roomLight = mean(ambient_);
  roomLight_ = roomLight > 0.0 ? static_cast<float>(settings_.devices.ambient * flood / roomLight) : 0.0f;
  if (asBright) roomLight_ = *asBright;
  black_ = projectorBlack_;
  for (std::size_t i = 0; i < ambient_.size(); ++i) {
    ambient_[i] *= roomLight_;
    black_[i] += ambient_[i];
  }
}

CameraStack VenueLight::fromProjectors(const std::vector<image::Image>& encodedDrive) const {
  const Rasters& projectors = layout_.projectors();
  require(encodedDrive.size() == projectors.devices(), "{} pictures for {} projectors", encodedDrive.size(),
          projectors.devices());
  ProjectorStack drive;
  drive.reserve(3 * projectors.count());
  for (std::size_t i = 0; i < encodedDrive.size(); ++i) {
    require(encodedDrive[i].size() == projectors.size(i), "a picture of {}x{} pixels for projector {}",
            encodedDrive[i].width(), encodedDrive[i].height(), i);
    Stack light = projectorModel_.light(encodedDrive[i]);
    drive.insert(drive.end(), light.begin(), light.end());
  }
  CameraStack seen = fromLight(drive);
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += projectorBlack_[i];
  return seen;
}

CameraStack VenueLight::fromLight(const ProjectorStack& linear) const {
  return CameraStack(cameraByNode_.multiplyTransposed(layout_.means(linear)));
}

const transport::TransportMatrix& VenueLight::transport() const {
  std::call_once(transportMade_, [&] {
    transport_ = transport::TransportMatrix(cameras_, layout_.projectors(), cameraByNode_.transposed());
  });
  return transport_;
}

}  // namespace relucent::venue
