// SPDX-License-Identifier: MIT
// What the two files that know Aravis share; included by nobody else.
#pragma once

#include <arv.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "relucent/base/error.h"
#include "relucent/devices/genicam/genicam_driver.h"

namespace relucent::devices {

struct UnrefObject {
  void operator()(gpointer object) const { g_object_unref(object); }
};
struct FreeMemory {
  void operator()(gpointer memory) const { g_free(memory); }
};
template <typename Object>
using OwnedObject = std::unique_ptr<Object, UnrefObject>;

inline std::string textOf(const char* from) {
  return from == nullptr ? std::string() : std::string(from);
}

/// Receives a GError: `arv_something(..., failure)`, then failure.check().
class AravisFailure {
 public:
  explicit AravisFailure(std::string camera) : camera_(std::move(camera)) {}
  ~AravisFailure() { g_clear_error(&error_); }
  AravisFailure(const AravisFailure&) = delete;
  AravisFailure& operator=(const AravisFailure&) = delete;

  operator GError**() {
    g_clear_error(&error_);
    return &error_;
  }
  bool happened() const { return error_ != nullptr; }

  /// Throws: CameraLost if the camera does not answer or obeys somebody else, Error{device} for all the rest.
  void check(const std::string& action) const {
    if (error_ == nullptr) return;
    if (isConnectionLost())
      throw CameraLost(
          RELUCENT_MESSAGE("device.camera-no-longer-answers", "the camera no longer answers ({}: {})")
              .with(action, error_->message));
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("device.camera-refuses", "the camera refuses ({}: {})")
            .with(action, error_->message),
        RELUCENT_MESSAGE(
            "device.restart-with-default-settings",
            "switch it off and on, load its default settings with its maker's program, and try again"),
        camera_);
  }

 private:
  bool isConnectionLost() const {
    if (error_->domain != ARV_DEVICE_ERROR) return false;
    constexpr std::array lost{ARV_DEVICE_ERROR_NOT_CONNECTED,  ARV_DEVICE_ERROR_TIMEOUT,
                              ARV_DEVICE_ERROR_TRANSFER_ERROR, ARV_DEVICE_ERROR_NOT_FOUND,
                              ARV_DEVICE_ERROR_NOT_CONTROLLER, ARV_DEVICE_ERROR_PROTOCOL_ERROR};
    return std::find(lost.begin(), lost.end(), error_->code) != lost.end();
  }

  std::string camera_;
  GError* error_ = nullptr;
};

/// How a camera was set up.
struct AravisSetup {
  SensorFormat format;
  ArvPixelFormat pixelFormat = 0;
  bool triggered = false;
  Pixel begin;  // of the photograph on the sensor, sensor pixels
  Size sensor;  // that the photograph takes
};

/// The smallest part of the photograph that holds `part` and that the camera can deliver alone, sensor
/// pixels: its corners lie on multiples of what the camera steps by, and of a colour filter's cell. Throws:
/// as AravisFailure::check().
rig::PicturePart partOfSensor(ArvCamera* camera, const std::string& name, const AravisSetup& setup,
                              const rig::PicturePart& part);
/// Whether the camera delivers that part of its sensor from now on. Throws: CameraLost.
bool setPartOfSensor(ArvCamera* camera, const std::string& name, const rig::PicturePart& part);

/// Sets pixel format, part of the sensor, gain and trigger as wanted, switches everything automatic off, and
/// fills `traits` with what was read back.
/// Throws: Error{device} for what the camera cannot; CameraLost.
AravisSetup setUp(ArvCamera* camera, const std::string& name, const GenicamSettings& settings,
                  CameraTraits& traits);

}  // namespace relucent::devices
