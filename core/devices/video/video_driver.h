// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "relucent/devices/camera_driver.h"
#include "relucent/devices/driven_camera.h"
#include "relucent/devices/video/video_source.h"

namespace relucent::devices {

/// A webcam or frame grabber as a camera: manual exposure or none at all. Frames come all the time; each is
/// judged by when it was captured. `name` is for errors.
/// Its photographs have 8 bits and mostly a response curve, which `linearization/` measures.
std::unique_ptr<CameraDriver> makeVideoDriver(std::unique_ptr<VideoSource> source, std::string name,
                                              std::optional<Size> size);

/// What such cameras need on top: a new exposure time takes some frames to arrive.
DrivenCameraSettings videoPatience();

}  // namespace relucent::devices
