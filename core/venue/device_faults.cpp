// SPDX-License-Identifier: MIT
#include "relucent/venue/device_faults.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "relucent/base/error.h"

namespace relucent::venue {
namespace {

/// The view, shifted and turned about its centre, bilinear; what comes in at the border is its last pixel.
Stack moved(const Stack& view, Size size, double shift, double degrees) {
  double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  double cx = 0.5 * (size.width - 1), cy = 0.5 * (size.height - 1);
  Stack result(view.size());
  for (std::size_t i = 0; i < size.count(); ++i) {
    Pixel at = pixelAt(size, i);
    double dx = at.x - shift - cx, dy = at.y - shift - cy;
    double x = std::clamp(cx + c * dx + s * dy, 0.0, size.width - 1.0);
    double y = std::clamp(cy - s * dx + c * dy, 0.0, size.height - 1.0);
    int left = std::min(static_cast<int>(x), std::max(0, size.width - 2));
    int top = std::min(static_cast<int>(y), std::max(0, size.height - 2));
    int right = std::min(left + 1, size.width - 1), bottom = std::min(top + 1, size.height - 1);
    auto u = static_cast<float>(x - left), v = static_cast<float>(y - top);
    for (std::size_t k = 0; k < 3; ++k) {
      auto value = [&](int px, int py) { return view[3 * indexOf(size, {px, py}) + k]; };
      result[3 * i + k] = (1.0f - v) * ((1.0f - u) * value(left, top) + u * value(right, top)) +
                          v * ((1.0f - u) * value(left, bottom) + u * value(right, bottom));
    }
  }
  return result;
}

bool isInside(const DeviceFault& fault, Size size, std::size_t i) {
  Pixel at = pixelAt(size, i);
  double x = (at.x + 0.5) / size.width, y = (at.y + 0.5) / size.height;
  return x >= fault.x0 && x < fault.x1 && y >= fault.y0 && y < fault.y1;
}

}  // namespace

std::vector<DeviceFault> FaultSchedule::during(const rig::ShotId& shot) const {
  std::vector<DeviceFault> acting;
  for (const DeviceFault& fault : faults)
    if (fault.stage == shot.stage && fault.first <= shot.number && shot.number <= fault.last)
      acting.push_back(fault);
  return acting;
}

void requireConnected(const std::vector<DeviceFault>& faults, const std::string& camera) {
  if (std::ranges::any_of(faults,
                          [](const DeviceFault& fault) { return fault.kind == FaultKind::unplugged; }))
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("device.simulated-camera-unplugged", "the camera's cable is out"),
                RELUCENT_MESSAGE("device.push-cable-in", "push in the camera's cable at both ends"), camera);
}

image::Image withFaults(const image::Image& encodedDrive, const std::vector<DeviceFault>& faults) {
  image::Image shown = encodedDrive;
  for (const DeviceFault& fault : faults) {
    if (fault.kind != FaultKind::mirroredScreen) continue;
    image::Image before = shown;
    for (int y = 0; y < shown.height(); ++y)
      for (int x = 0; x < shown.width(); ++x)
        for (int c = 0; c < shown.channels(); ++c) shown.at(x, y, c) = before.at(shown.width() - 1 - x, y, c);
  }
  return shown;
}

Stack withFaults(Stack fromProjectors, const Stack& ambient, Size size, double full, int exposure,
                 const std::vector<DeviceFault>& faults) {
  float lamp = 1.0f, room = 0.0f;
  for (const DeviceFault& fault : faults) {
    if (fault.kind == FaultKind::asleepProjector) lamp = 0.0f;
    if (fault.kind == FaultKind::flicker && exposure % 2 == 1) lamp *= static_cast<float>(1.0 + fault.amount);
    if (fault.kind == FaultKind::ambient) room += static_cast<float>(fault.amount * full);
  }
  Stack& view = fromProjectors;
  for (std::size_t i = 0; i < view.size(); ++i) view[i] = lamp * view[i] + ambient[i] + room;
  for (const DeviceFault& fault : faults) {
    if (fault.kind == FaultKind::shiftedCamera) view = moved(view, size, fault.amount, fault.degrees);
    if (fault.kind == FaultKind::coveredLens) std::fill(view.begin(), view.end(), 0.0f);
    if (fault.kind != FaultKind::flash && fault.kind != FaultKind::hand) continue;
    for (std::size_t i = 0; i < size.count(); ++i) {
      if (!isInside(fault, size, i)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        view[3 * i + c] =
            fault.kind == FaultKind::hand ? 0.0f : view[3 * i + c] + static_cast<float>(fault.amount);
    }
  }
  return fromProjectors;
}

}  // namespace relucent::venue
