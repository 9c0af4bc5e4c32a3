// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/driven_camera.h"
#include "relucent/devices/gphoto/gphoto_port.h"
#include "relucent/devices/raw/raw_photograph.h"

namespace relucent::devices {

struct GphotoCameraSettings {
  std::string camera;              // model ("Canon EOS 80D") or port ("usb:001,005")
  std::optional<Size> photograph;  // a part around the sensor's middle; none: all of the sensor
  std::optional<int> iso;          // none: the lowest from 100 on
};
std::vector<Message> problems(const GphotoCameraSettings& settings);

/// What makes a photograph of a raw file: rawPhotograph().
using RawReader =
    std::function<RawPhotograph(const std::vector<std::uint8_t>& bytes, const std::string& name)>;

/// A DSLR or mirrorless camera that is set to raw files and manual exposure, and gets its settings back when
/// it is disconnected. Exposure times are the nearest of its list; longer ones are taken in bulb.
/// connect() takes a photograph, which tells its size.
std::unique_ptr<CameraDriver> makeGphotoDriver(std::unique_ptr<GphotoPort> port,
                                               GphotoCameraSettings settings, RawReader read = rawPhotograph);

/// How long still cameras are waited for: seconds to write, minutes until somebody has changed a battery.
DrivenCameraSettings gphotoPatience();

/// Whether two names of models are the same but for capitals.
bool isSameModel(const std::string& a, const std::string& b);
/// The addresses of cameras that are plugged in: their models, or ports where two are of one model.
std::vector<std::string> gphotoPlaces(const std::vector<GphotoCamera>& cameras);

}  // namespace relucent::devices
