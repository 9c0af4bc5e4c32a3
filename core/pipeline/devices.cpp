// SPDX-License-Identifier: MIT
#include "pipeline/devices.h"

#include "base/error.h"
#include "devices/command_projector.h"
#include "devices/latency.h"
#include "devices/open_camera.h"
#include "devices/recording.h"

namespace relucent {
namespace {

OpenedRig opened(const VenueSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  OpenedRig result;
  result.venue.emplace(settings, cache, progress);
  result.rig = result.venue->rig();
  return result;
}

DeviceAddress cameraOf(const CommandRigSettings& settings) {
  if (settings.cameraAddress.empty()) return {DeviceAddress::Kind::command, settings.cameraCommand};
  const std::optional<DeviceAddress> address = deviceAddressFrom(settings.cameraAddress);
  if (!address)
    throw Error(ErrorKind::usage, fmt::format("'{}' is no camera", settings.cameraAddress),
                fmt::format("write {}", deviceAddressForms));
  return *address;
}

OpenedRig opened(const CommandRigSettings& settings, const std::filesystem::path&, Progress&) {
  if (!settings.replay.empty()) return {replayed(settings.replay), std::nullopt};
  CommandProjectorSettings projector;
  projector.command = settings.projectorCommand;
  projector.size = settings.projector;

  OpenedRig result;
  result.rig.projectors.push_back(std::make_unique<CommandProjector>(std::move(projector)));
  result.rig.cameras.push_back(openCamera(
      cameraOf(settings), {settings.camera, {settings.shortestExposure, settings.longestExposure}}));
  if (settings.latency > 0.0)
    result.rig.projectors.front() =
        delayed(std::move(result.rig.projectors.front()), settings.latency, sleepFor);
  if (!settings.record.empty()) result.rig = recorded(std::move(result.rig), settings.record);
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

Rig& RigSource::open(const RigSettings& settings, const TransportMatrix& transport,
                     const std::filesystem::path& calibration, Progress& progress) {
  Rig& rig = given_ != nullptr ? *given_ : opened_.emplace(openRig(settings, cache_, progress)).rig;
  if (!(rig.cameraRasters() == transport.cameras() && rig.projectorRasters() == transport.projectors()))
    throw Error(ErrorKind::input, "the devices have other sizes than those that were calibrated",
                "set projector and camera as they were, or calibrate anew", calibration.string());
  return rig;
}

}  // namespace relucent
