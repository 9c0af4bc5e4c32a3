// SPDX-License-Identifier: MIT
#include "relucent/venue/simulated_devices.h"

#include <fmt/format.h>

#include <mutex>

#include "relucent/base/error.h"
#include "relucent/venue/sensor_model.h"

namespace relucent::venue {
namespace {

/// What the projectors of one rig show, and what that looks like to the cameras: computed for the first
/// exposure, kept for the others.
class Stage {
 public:
  Stage(std::shared_ptr<const VenueLight> light, FaultsDuring faults)
      : light_(std::move(light)), faults_(std::move(faults)) {
    const Rasters& rasters = light_->layout().projectors();
    for (std::size_t i = 0; i < rasters.devices(); ++i) shown_.emplace_back(rasters.size(i), 3);
  }

  const VenueLight& light() const { return *light_; }
  /// A camera's part of a stack of all.
  CameraStack partOf(const CameraStack& all, std::size_t camera) const {
    const Rasters& cameras = light_->cameras();
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(3 * cameras.offset(camera));
    return CameraStack(Stack(begin, begin + static_cast<std::ptrdiff_t>(3 * cameras.size(camera).count())));
  }
  /// Mean radiance that the first camera sees at full light.
  double full() {
    std::call_once(fullMade_, [&] {
      CameraStack flood = partOf(light_->transport().floodlight(), 0);
      for (float value : flood) full_ += static_cast<double>(value) / static_cast<double>(flood.size());
    });
    return full_;
  }
  std::vector<DeviceFault> faultsDuring(const rig::ShotId& shot) const {
    return faults_ ? faults_(shot) : std::vector<DeviceFault>{};
  }
  /// What the camera would see of the projectors' pictures, had they these faults.
  CameraStack lightOfFaultyProjectors(const std::vector<DeviceFault>& faults) {
    std::vector<image::Image> shown;
    for (const image::Image& picture : shown_) shown.push_back(withFaults(picture, faults));
    return light_->fromProjectors(shown);
  }

  void show(std::size_t projector, const image::Image& encodedDrive) {
    std::lock_guard lock(mutex_);
    if (shown_[projector] == encodedDrive) return;
    shown_[projector] = encodedDrive;
    current_ = nullptr;
  }

  std::shared_ptr<const CameraStack> fromProjectors() {
    std::lock_guard lock(mutex_);
    if (!current_) current_ = std::make_shared<const CameraStack>(light_->fromProjectors(shown_));
    return current_;
  }

 private:
  std::shared_ptr<const VenueLight> light_;
  FaultsDuring faults_;
  std::once_flag fullMade_;
  double full_ = 0.0;
  std::mutex mutex_;
  std::vector<image::Image> shown_;
  std::shared_ptr<const CameraStack> current_;
};

class SimulatedProjector : public rig::Projector {
 public:
  SimulatedProjector(std::shared_ptr<Stage> stage, std::size_t index)
      : stage_(std::move(stage)), index_(index) {}

  std::string name() const override { return fmt::format("simulated projector {}", index_ + 1); }
  Size size() const override { return stage_->light().layout().projectors().size(index_); }
  int bits() const override { return stage_->light().projectorModel().bits(); }
  void show(const image::Image& encodedDrive) override {
    require(encodedDrive.size() == size() && encodedDrive.channels() == 3,
            "a picture of {}x{} pixels, {} channels for a projector of {}x{}", encodedDrive.width(),
            encodedDrive.height(), encodedDrive.channels(), size().width, size().height);
    stage_->show(index_, encodedDrive);
  }

 private:
  std::shared_ptr<Stage> stage_;
  std::size_t index_;
};

class SimulatedCamera : public rig::Camera {
 public:
  SimulatedCamera(std::shared_ptr<Stage> stage, std::size_t index)
      : stage_(std::move(stage)),
        index_(index),
        ambient_(stage_->partOf(stage_->light().ambient(), index)),
        sensor_(stage_->light().settings().devices, stage_->light().settings().seed, index) {}

  std::string name() const override {
    return stage_->light().cameras().devices() == 1 ? "simulated camera"
                                                    : fmt::format("simulated camera {}", index_ + 1);
  }
  Size size() const override { return stage_->light().cameras().size(index_); }
  rig::ExposureRange exposures() const override { return SensorModel::exposures(); }
  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    float power = static_cast<float>(sensor_.lampPower(request));
    std::vector<DeviceFault> faults = stage_->faultsDuring(request.shot);
    if (!faults.empty()) return faulty(request, power, faults);
    CameraStack radiance = stage_->partOf(*stage_->fromProjectors(), index_);
    for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = power * radiance[i] + ambient_[i];
    return sensor_.expose(radiance, size(), request);
  }

 private:
  rig::RawFrame faulty(const rig::CaptureRequest& request, float power, const std::vector<DeviceFault>& all) {
    std::vector<DeviceFault> faults;
    for (const DeviceFault& fault : all)
      if (index_ == 0 || isOfTheRoom(fault.kind)) faults.push_back(fault);
    requireConnected(faults, name());
    CameraStack light = stage_->partOf(stage_->lightOfFaultyProjectors(faults), index_);
    for (float& value : light) value *= power;
    CameraStack view(
        withFaults(std::move(light), ambient_, size(), stage_->full(), request.exposure, faults));
    return sensor_.expose(view, size(), request);
  }

  std::shared_ptr<Stage> stage_;
  std::size_t index_;
  CameraStack ambient_;
  SensorModel sensor_;
};

}  // namespace

rig::Rig simulatedRig(std::shared_ptr<const VenueLight> light) {
  return simulatedRig(std::move(light), FaultsDuring());
}

rig::Rig simulatedRig(std::shared_ptr<const VenueLight> light, FaultsDuring faults) {
  const std::size_t projectors = light->layout().projectors().devices();
  const std::size_t cameras = light->cameras().devices();
  auto stage = std::make_shared<Stage>(std::move(light), std::move(faults));
  rig::Rig rig;
  for (std::size_t i = 0; i < projectors; ++i)
    rig.projectors.push_back(std::make_unique<SimulatedProjector>(stage, i));
  for (std::size_t i = 0; i < cameras; ++i)
    rig.cameras.push_back(std::make_unique<SimulatedCamera>(stage, i));
  return rig;
}

}  // namespace relucent::venue
