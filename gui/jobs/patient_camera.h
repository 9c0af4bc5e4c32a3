// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <chrono>
#include <memory>
#include <optional>

#include "jobs/failure.h"
#include "relucent/rig/rig.h"

namespace relucent::gui {

/// How long photographs are waited for: as long as nobody says otherwise. From any thread.
class CameraPatience {
 public:
  /// Nobody waits any longer: the photograph that is on its way, and all after it, are DeviceGivenUp, ...
  void giveUp() { setGivenUp(true); }
  /// ... until somebody does again.
  void wait() { setGivenUp(false); }
  bool isGivenUp() const;

  /// Why the last try failed, while it is tried again; none: no try has failed.
  std::optional<Failure> failure() const;
  void tell(std::optional<Failure> failure);

 private:
  void setGivenUp(bool givenUp);

  mutable QMutex guard_;
  bool givenUp_ = false;
  std::optional<Failure> failure_;
};

/// A camera that is waited for. Once it has delivered a photograph it works, and what fails later is tried
/// again until it works again: cables are pushed in, batteries changed. Whoever waits is free at once when
/// its job is cancelled (Cancelled) or the camera is given up (DeviceGivenUp), even while the camera's driver
/// looks for it: the photograph is taken on another thread.
class PatientCamera : public rig::Camera {
 public:
  /// `pause`: between two tries.
  PatientCamera(std::unique_ptr<rig::Camera> camera, std::shared_ptr<CameraPatience> patience,
                std::chrono::milliseconds pause = std::chrono::milliseconds(500));
  /// Waits for the driver.
  ~PatientCamera() override;

  std::string name() const override;
  Size size() const override;
  rig::ExposureRange exposures() const override;
  /// Throws: what the camera throws, before it has delivered one; DeviceGivenUp; Cancelled.
  rig::RawFrame capture(const rig::CaptureRequest& request) override;

 private:
  class Driver;
  void rest() const;
  void checkpoint() const;

  std::shared_ptr<CameraPatience> patience_;
  std::chrono::milliseconds pause_;
  bool hasWorked_ = false;
  std::unique_ptr<Driver> driver_;
};

}  // namespace relucent::gui
