// SPDX-License-Identifier: MIT
#include "relucent/pipeline/devices.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/check/latency.h"
#include "relucent/devices/command/command_camera.h"
#include "relucent/devices/command/command_projector.h"
#include "relucent/devices/recording/recording.h"
#include "relucent/devices/whole_frames.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/warm_up.h"
#include "relucent/rig/distinct_cameras.h"

namespace relucent::pipeline {
namespace {

devices::CameraAddress addressOf(const CommandRigSettings::Camera& camera) {
  if (camera.address.empty()) return {devices::CommandCamera::kind, camera.command};
  return devices::cameraRegistry().requiredAddress(camera.address);
}

/// Else the second one would be said to be another program's.
void requireOwnCameras(const std::vector<devices::CameraAddress>& addresses) {
  if (addresses.size() > 1) rig::requireDistinctCameras(devices::cameraRegistry().devicesAt(addresses));
}

/// One overload a kind of rig.
struct Opener {
  const std::filesystem::path& cache;
  const ScreenOpener& screens;
  Progress& progress;

  OpenedRig operator()(const venue::VenueSettings& settings) const {
    OpenedRig result;
    result.venue.emplace(settings, cache, progress);
    result.rig = result.venue->rig();
    return result;
  }

  OpenedRig operator()(const CommandRigSettings& settings) const {
    OpenedRig result;
    const std::vector<CommandRigSettings::Projector> projectors = projectorsOf(settings);
    for (std::size_t i = 0; i < projectors.size(); ++i) {
      devices::CommandProjectorSettings command;
      command.command = projectors[i].command;
      command.size = projectors[i].size;
      if (projectors.size() > 1) command.name += " " + std::to_string(i + 1);
      auto& opened =
          result.rig.projectors.emplace_back(std::make_unique<devices::CommandProjector>(std::move(command)));
      if (settings.latency > 0.0)
        opened = devices::delayed(std::move(opened), settings.latency, devices::sleepFor);
    }
    const std::vector<CommandRigSettings::Camera> cameras = camerasOf(settings);
    std::vector<devices::CameraAddress> addresses;
    for (const CommandRigSettings::Camera& camera : cameras) addresses.push_back(addressOf(camera));
    requireOwnCameras(addresses);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      devices::CameraWishes wishes{cameras[i].size, {settings.shortestExposure, settings.longestExposure}};
      if (cameras.size() > 1) wishes.ofSeveral = static_cast<int>(i) + 1;
      auto& opened = result.rig.cameras.emplace_back(devices::cameraRegistry().open(addresses[i], wishes));
      if (settings.frameRate > 0.0)
        opened = devices::inWholeFrames(std::move(opened), 1.0 / settings.frameRate);
    }
    if (!settings.record.empty()) result.rig = devices::recorded(std::move(result.rig), settings.record);
    return result;
  }

  OpenedRig operator()(const ScreenRigSettings& settings) const {
    if (!screens)
      throw Error(ErrorKind::usage,
                  RELUCENT_ENGLISH_MESSAGE("calibration.projector-is-screen",
                                           "this calibration's projector is a screen of the desktop"),
                  RELUCENT_ENGLISH_MESSAGE("calibration.open-with-windows",
                                           "open it with `relucent`, which has windows"),
                  settings.display.connector);
    if (settings.cameraAddress.empty())
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("calibration.no-camera-chosen", "no camera is chosen"),
                  RELUCENT_ENGLISH_MESSAGE("calibration.choose-camera", "choose one in the Camera step"));
    OpenedRig result;
    std::vector<devices::CameraAddress> addresses;
    for (const ScreenRigSettings::Camera& camera : camerasOf(settings))
      addresses.push_back(devices::cameraRegistry().requiredAddress(camera.address));
    requireOwnCameras(addresses);
    std::vector<std::unique_ptr<rig::Camera>> cameras;
    for (const ScreenRigSettings::Camera& camera : camerasOf(settings))
      cameras.push_back(devices::cameraRegistry().open(
          devices::cameraRegistry().requiredAddress(camera.address),
          {camera.size, {settings.shortestExposure, settings.longestExposure}}));
    std::vector<std::unique_ptr<devices::ScreenProjector>> projectors;
    double slowest = settings.frameRate;
    for (std::size_t i = 0; i < screensOf(settings).size(); ++i) {
      const ScreenRigSettings alone = withScreenAlone(settings, i);
      projectors.push_back(screens(alone));
      slowest = std::min(slowest, alone.frameRate);
    }
    devices::ScreenRig screen = devices::screenRig(std::move(projectors), std::move(cameras),
                                                   {settings.latency, 1.0 / slowest}, devices::sleepFor);
    result.rig = std::move(screen.rig);
    result.screen = std::move(screen.control);
    return result;
  }

  OpenedRig operator()(const ReplayRigSettings& settings) const {
    return {devices::replayed(settings.folder), std::nullopt};
  }

  OpenedRig operator()(const ImportedRigSettings& settings) const {
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.imported-without-devices",
                                         "this calibration was imported from photographs and has no devices"),
                RELUCENT_ENGLISH_MESSAGE("calibration.import-again-into-new-folder",
                                         "import again, into a new folder: relucent-cli import"),
                settings.photographs);
  }
};

}  // namespace

OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache,
                  const ScreenOpener& screens, Progress& progress) {
  return std::visit(Opener{cache, screens, progress}, settings);
}

OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  return openRig(settings, cache, {}, progress);
}

rig::Rig& RigSource::open(const RigSettings& settings, const transport::TransportMatrix& transport,
                          const calibration::CalibrationFolder& folder, Progress& progress) {
  if (given_ == nullptr) {
    ProjectorWarmUp warmUp(networkProjectorsOf(folder), settings);
    warmUp.switchOn(progress);
    opened_.emplace(openRig(settings, cache_, progress));
    warmUp.awaitSteadyLight(opened_->rig, progress);
  }
  used_ = reducedRig(folder, whole());
  if (!(used_.cameraRasters() == transport.cameras() && used_.projectorRasters() == transport.projectors()))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.device-sizes-differ",
                                         "the devices have other sizes than those that were calibrated"),
                RELUCENT_ENGLISH_MESSAGE("calibration.restore-sizes-or-recalibrate",
                                         "set projector and camera as they were, or calibrate again"),
                folder.path().string());
  return used_;
}

rig::Rig& RigSource::whole() {
  return given_ != nullptr ? *given_ : opened_.value().rig;
}

}  // namespace relucent::pipeline
