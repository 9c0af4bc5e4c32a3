// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/camera_driver.h"

namespace relucent::devices {

struct GenicamSettings {
  std::string camera;              // serial number, identity, network address or name of the camera
  std::optional<Size> photograph;  // a part around the sensor's middle; none: all of the sensor
  std::string format;              // "BayerRG12"; empty: the one that loses least
  std::optional<double> gain;      // in the camera's unit; none: its lowest, which has the least noise
  int packetSize = 0;              // bytes, GigE only; 0: as much as the network lets through
};
std::vector<Message> problems(const GenicamSettings& settings);

/// A camera that answered.
struct GenicamCamera {
  std::string serial;
  std::string model;     // "Aravis Fake"
  std::string protocol;  // "GigEVision", "USB3Vision"
  std::string address;   // "192.168.1.20"
};

/// All cameras that answer within a second.
std::vector<GenicamCamera> findGenicamCameras();
/// Where on the network, or by which serial number, each of these is found that GenicamSettings::camera may
/// be: equal texts for one camera. Of one that does not answer what it was given by.
std::vector<std::string> genicamDevices(const std::vector<std::string>& cameras);
std::unique_ptr<CameraDriver> makeGenicamDriver(const GenicamSettings& settings);

}  // namespace relucent::devices
