// SPDX-License-Identifier: MIT
#include "pipeline/devices.h"

#include "base/error.h"
#include "devices/command_camera.h"
#include "devices/command_projector.h"

namespace relucent {
namespace {

OpenedRig opened(const VenueSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  OpenedRig result;
  result.venue.emplace(settings, cache, progress);
  result.rig = result.venue->rig();
  return result;
}

OpenedRig opened(const CommandRigSettings& settings, const std::filesystem::path&, Progress&) {
  CommandProjectorSettings projector;
  projector.command = settings.projectorCommand;
  projector.size = settings.projector;
  CommandCameraSettings camera;
  camera.command = settings.cameraCommand;
  camera.size = settings.camera;
  camera.exposures = {settings.shortestExposure, settings.longestExposure};

  OpenedRig result;
  result.rig.projectors.push_back(std::make_unique<CommandProjector>(std::move(projector)));
  result.rig.cameras.push_back(std::make_unique<CommandCamera>(std::move(camera)));
  return result;
}

OpenedRig opened(const ImportedRigSettings& settings, const std::filesystem::path&, Progress&) {
  throw Error(ErrorKind::input, "this calibration was imported from photographs and has no devices",
              "import again, into a new folder: relucent-cli import", settings.photographs);
}

}  // namespace

OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  return std::visit([&](const auto& rig) { return opened(rig, cache, progress); }, settings);
}

}  // namespace relucent
