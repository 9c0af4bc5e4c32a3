// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "acquisition_run.h"
#include "relucent/sentinels/observer.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue.h"

/// A traced venue whose devices can be given faults while it is measured, and who looks on.
namespace relucent::test {

inline constexpr const char* stage = "acquisition";

/// Runs of acquisition in a traced venue whose devices can be given faults.
class FaultyVenue {
 public:
  explicit FaultyVenue(acquisition::AcquisitionMode mode)
      : venue_(settings(), {}, progress_), acquisition_(acquisition::settingsOf(mode)) {
    const venue::DeviceModelSettings& devices = venue_.settings().devices;
    double rounding = 1.0 / 4095.0;
    linearization_.exposures = {1.0 / 8.0, 1.0 / 75.0};
    linearization_.cameras.resize(1);
    linearization_.cameras[0].gain = 1.0 / devices.fullWell;
    linearization_.cameras[0].readNoise =
        std::hypot(devices.readElectrons / devices.fullWell, rounding / std::sqrt(12.0));
    acquisition_.relativeThreshold = mode == acquisition::AcquisitionMode::adaptive ? 0.05 : 0.02;
    acquisition_.references = 3;
    acquisition_.verificationPatterns = 4;
  }

  transport::Acquisition run(const sentinels::AlarmHandler& handler, rig::ShotLog& log) {
    sentinels::AcquisitionObserver nobody;
    return run(handler, log, nobody);
  }
  transport::Acquisition run(const sentinels::AlarmHandler& handler, rig::ShotLog& log,
                             sentinels::AcquisitionObserver& observer) {
    return run(handler, log, observer, progress_);
  }
  transport::Acquisition run(const sentinels::AlarmHandler& handler, rig::ShotLog& log,
                             sentinels::AcquisitionObserver& observer, Progress progress) {
    rig::Rig rig = venue_.rig(faults);
    if (before)
      for (std::unique_ptr<rig::Camera>& camera : rig.cameras)
        camera = std::make_unique<AskingCamera>(std::move(camera), before);
    rig::ShotTaker shots(rig, log, stage);
    return acquisition::acquire({shots, linearization_, acquisition_, handler, &observer}, progress);
  }
  /// Without faults, once.
  const transport::Acquisition& sound() {
    if (!sound_) {
      MemoryLog log;
      auto kept = std::exchange(faults->faults, {});
      sound_ = run({}, log);
      faults->faults = std::move(kept);
    }
    return *sound_;
  }

  std::shared_ptr<venue::FaultSchedule> faults = std::make_shared<venue::FaultSchedule>();
  /// Each photograph, from the next run on; empty: nothing happens.
  std::function<void(const rig::CaptureRequest&)> before;

 private:
  class AskingCamera : public rig::Camera {
   public:
    AskingCamera(std::unique_ptr<rig::Camera> camera, std::function<void(const rig::CaptureRequest&)> before)
        : camera_(std::move(camera)), before_(std::move(before)) {}
    std::string name() const override { return camera_->name(); }
    Size size() const override { return camera_->size(); }
    rig::ExposureRange exposures() const override { return camera_->exposures(); }
    rig::RawFrame capture(const rig::CaptureRequest& request) override {
      before_(request);
      return camera_->capture(request);
    }

   private:
    std::unique_ptr<rig::Camera> camera_;
    std::function<void(const rig::CaptureRequest&)> before_;
  };

  static venue::VenueSettings settings() {
    venue::VenueSettings settings;
    settings.name = "corner";
    settings.projector = {48, 36};
    settings.camera = {48, 36};
    settings.pathsPerPixel = 16;
    return settings;
  }

  Progress progress_;
  venue::SimulatedVenue venue_;
  linearization::Linearization linearization_;
  acquisition::AcquisitionSettings acquisition_;
  std::optional<transport::Acquisition> sound_;
};

inline venue::DeviceFault fault(venue::FaultKind kind, int first, double amount = 0.0, double degrees = 0.0) {
  venue::DeviceFault fault;
  fault.kind = kind;
  fault.stage = stage;
  fault.first = first;
  fault.last = 100000;
  fault.amount = amount;
  fault.degrees = degrees;
  return fault;
}

/// Keeps what it is told.
class Listening : public sentinels::AcquisitionObserver {
 public:
  void checked(const sentinels::Reading& reading) override { readings.push_back(reading); }
  void takenAgain(const sentinels::Retake& retake) override { retakes.push_back(retake); }
  void grew(const std::vector<int>& levels, int through) override { growth.emplace_back(levels, through); }

  std::vector<sentinels::Reading> readings;
  std::vector<sentinels::Retake> retakes;
  std::vector<std::pair<std::vector<int>, int>> growth;
};

inline venue::DeviceFault handOver(int first) {
  venue::DeviceFault hand = fault(venue::FaultKind::hand, first);
  hand.x0 = 0.3, hand.x1 = 0.5, hand.y0 = 0.4, hand.y1 = 0.7;
  return hand;
}

}  // namespace relucent::test

Q_DECLARE_METATYPE(relucent::venue::DeviceFault)
