// SPDX-License-Identifier: MIT
#include "relucent/pipeline/watched_calibration.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/command/command_camera.h"
#include "relucent/devices/whole_frames.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/reduction/reduced_rig.h"

namespace relucent::pipeline {

monitoring::WatchedVenue watchedVenueOf(const MeasuredCalibration& measured, std::size_t camera,
                                        const monitoring::SamplingSettings& settings) {
  const compensation::MeasuredVenue& venue = measured.venue;
  const Rasters& cameras = venue.transport.cameras();
  require(camera < cameras.devices(), "camera {} of {}", camera, cameras.devices());
  const std::size_t offset = cameras.offset(camera);
  const Size size = cameras.size(camera);
  std::vector<std::uint8_t> usable(size.count());
  for (std::size_t i = 0; i < usable.size(); ++i) usable[i] = venue.usable[offset + i];
  monitoring::Sampling sampling = monitoring::sampledPixels(size, usable, settings);

  std::vector<std::uint32_t> rows;
  std::vector<float> black, flood;
  for (std::uint32_t pixel : sampling.pixels) {
    const std::size_t row = offset + pixel;
    rows.push_back(static_cast<std::uint32_t>(row));
    for (std::size_t c = 0; c < 3; ++c) {
      black.push_back(venue.black[3 * row + c]);
      flood.push_back(venue.flood[3 * row + c]);
    }
  }
  monitoring::SampledTransport transport(venue.transport, rows);
  monitoring::WatchedVenue watched{std::move(sampling), std::move(transport), std::move(black),
                                   std::move(flood), measured.linearization.cameras[camera]};
  watched.wrong = std::max(watched.wrong, measured.acquisition.verificationError);
  return watched;
}

CodeLights lightOfCodes(const linearization::Linearization& linearization) {
  CodeLights lights;
  for (const linearization::ProjectorResponse& projector : linearization.projectors) {
    auto& own = lights.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t code = 0; code < 256; ++code)
        own[c][code] = static_cast<float>(projector.channels[c](static_cast<double>(code) / 255.0));
  }
  return lights;
}

namespace {

/// Where the cameras of a rig are, and how long a projector's picture lasts.
struct CameraPlace {
  std::string address;
  std::optional<Size> size;
  rig::ExposureRange exposures;
  double frame = 0.0;  // seconds; 0: exposures as they are asked for
};

struct PlaceOf {
  const WatchSettings& settings;

  CameraPlace operator()(const ScreenRigSettings& rig) const {
    const std::vector<ScreenRigSettings::Camera> cameras = camerasOf(rig);
    requireCamera(cameras.size());
    double slowest = rig.frameRate;
    for (const ScreenRigSettings::Screen& screen : screensOf(rig))
      slowest = std::min(slowest, screen.frameRate);
    return {cameras[settings.camera].address,
            cameras[settings.camera].size,
            {rig.shortestExposure, rig.longestExposure},
            slowest > 0.0 ? 1.0 / slowest : 0.0};
  }
  CameraPlace operator()(const CommandRigSettings& rig) const {
    const std::vector<CommandRigSettings::Camera> cameras = camerasOf(rig);
    requireCamera(cameras.size());
    const CommandRigSettings::Camera& camera = cameras[settings.camera];
    return {camera.address.empty() ? std::string(devices::CommandCamera::kind) + ":" + camera.command
                                   : camera.address,
            camera.size,
            {rig.shortestExposure, rig.longestExposure},
            rig.frameRate > 0.0 ? 1.0 / rig.frameRate : 0.0};
  }
  CameraPlace operator()(const auto&) const {
    if (settings.address.empty())
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("monitoring.no-camera",
                                           "this calibration names no camera that could see a show"),
                  RELUCENT_ENGLISH_MESSAGE("monitoring.name-camera",
                                           "name the camera by its address: --watch KIND:PLACE"));
    return {};
  }
  void requireCamera(std::size_t cameras) const {
    if (settings.camera >= cameras && settings.address.empty())
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("monitoring.no-such-camera", "there is no camera {} in this calibration")
              .with(as::label(settings.camera + 1)),
          RELUCENT_ENGLISH_MESSAGE("monitoring.choose-camera", "choose one of its {}, as --watch 1")
              .with(cameras));
  }
};

}  // namespace

WatchingCamera readWatchedVenue(const std::filesystem::path& path, const WatchSettings& settings,
                                Progress& progress) {
  using calibration::CalibrationFolder;
  const MeasuredCalibration measured =
      loadMeasurements(CalibrationFolder::open(path, CalibrationFolder::Access::read), progress);
  const Rasters& cameras = measured.venue.transport.cameras();
  PlaceOf{{settings.camera, {}}}.requireCamera(cameras.devices());
  WatchingCamera watching;
  watching.venue = watchedVenueOf(measured, settings.camera);
  watching.lights = lightOfCodes(measured.linearization);
  watching.exposures = measured.linearization.exposures;
  return watching;
}

void openCamera(const std::filesystem::path& path, const WatchSettings& settings, WatchingCamera& watching) {
  using calibration::CalibrationFolder;
  const CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  CameraPlace place = std::visit(PlaceOf{settings}, settingsOf(folder).rig);
  if (!settings.address.empty()) place.address = settings.address;
  const devices::CameraAddress address = devices::cameraRegistry().requiredAddress(place.address);
  auto devices = std::make_unique<rig::Rig>();
  std::unique_ptr<rig::Camera> camera =
      devices::cameraRegistry().open(address, {place.size, place.exposures});
  if (place.frame > 0.0) camera = devices::inWholeFrames(std::move(camera), place.frame);
  devices->cameras.push_back(std::move(camera));
  const std::vector<reduction::Reduction> reductions = reductionsOf(folder);
  if (reductions.empty())
    std::swap(watching.used.cameras, devices->cameras);
  else
    watching.used = reduction::reduced(*devices, {reductions.at(settings.camera)});
  watching.devices = std::move(devices);
  const Size delivers = watching.camera().size(), measured = watching.venue.sampling.camera;
  if (!(delivers == measured))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("monitoring.other-size",
                                         "the camera delivers {} pixels, and {} were measured")
                    .with(as::size(delivers), as::size(measured)),
                RELUCENT_ENGLISH_MESSAGE("monitoring.set-size-back",
                                         "set its size as it was, or name the camera that measured"));
}

}  // namespace relucent::pipeline
