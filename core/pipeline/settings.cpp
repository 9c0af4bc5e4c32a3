// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "relucent/base/message.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/command/command_camera.h"
#include "relucent/devices/command/command_projector.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/export.h"
#include "relucent/pipeline/import.h"
#include "relucent/pipeline/perfecting_loop.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/relight.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/verify.h"

namespace relucent::pipeline {
namespace {

using Problems = std::vector<Message>;

void append(Problems& problems, const Problems& more) {
  problems.insert(problems.end(), more.begin(), more.end());
}

enum class DeviceKind { projector, camera };

void checkSize(Problems& problems, DeviceKind device, Size size) {
  constexpr int least = 8;
  constexpr int most = 8192;
  if (size.width < least || size.height < least || size.width > most || size.height > most)
    problems.push_back(device == DeviceKind::projector
                           ? RELUCENT_MESSAGE("device.projector-size-out-of-range",
                                              "a projector of {} pixels is impossible: each side is {} to {}")
                                 .with(as::size(size), least, most)
                           : RELUCENT_MESSAGE("device.camera-size-out-of-range",
                                              "a camera of {} pixels is impossible: each side is {} to {}")
                                 .with(as::size(size), least, most));
}

Problems problemsOf(const venue::VenueSettings& settings) {
  Problems found;
  checkSize(found, DeviceKind::projector, settings.projector);
  checkSize(found, DeviceKind::camera, settings.camera);
  // The venue would complain about the same sizes again in its own words.
  if (found.empty()) append(found, problems(settings));
  return found;
}

/// Which of several it is.
Problems numbered(const Problems& problems, DeviceKind device, std::size_t index, std::size_t count) {
  if (count == 1) return problems;
  Problems found;
  for (const Message& problem : problems)
    found.push_back((device == DeviceKind::projector
                         ? RELUCENT_ENGLISH_MESSAGE("device.of-projector", "projector {}: {}")
                         : RELUCENT_ENGLISH_MESSAGE("device.of-camera", "camera {}: {}"))
                        .with(as::label(index + 1), problem));
  return found;
}

template <typename Settings>
void checkTimes(Problems& problems, const Settings& settings) {
  if (!(settings.latency >= 0.0 && settings.latency <= 10.0))
    problems.push_back(RELUCENT_ENGLISH_MESSAGE("device.latency-out-of-range",
                                                "a projector's latency is between 0 and 10 seconds"));
  if (!(settings.frameRate >= 0.0 && settings.frameRate <= 1000.0))
    problems.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.frame-rate-out-of-range",
                                 "a projector's frame rate is between 0 and 1000 pictures a second"));
  if (!(settings.shortestExposure > 0.0) || !(settings.longestExposure >= settings.shortestExposure))
    problems.push_back(
        RELUCENT_MESSAGE("device.exposure-range-invalid",
                         "the shortest exposure must be above zero and no longer than the longest"));
}

Problems problemsOf(const CommandRigSettings& settings) {
  Problems found;
  const auto projectors = projectorsOf(settings);
  for (std::size_t i = 0; i < projectors.size(); ++i) {
    Problems of;
    checkSize(of, DeviceKind::projector, projectors[i].size);
    append(of, devices::problemsOfProjectorCommand(projectors[i].command));
    append(found, numbered(of, DeviceKind::projector, i, projectors.size()));
  }
  const auto cameras = camerasOf(settings);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    Problems of;
    if (cameras[i].size) checkSize(of, DeviceKind::camera, *cameras[i].size);
    append(of, cameras[i].address.empty() ? devices::problemsOfCameraCommand(cameras[i].command)
                                          : devices::cameraRegistry().problems(cameras[i].address));
    append(found, numbered(of, DeviceKind::camera, i, cameras.size()));
  }
  if (found.empty()) append(found, problemsOfDevices(settings));
  checkTimes(found, settings);
  return found;
}

Problems problemsOf(const ReplayRigSettings& settings) {
  if (settings.folder.empty())
    return {
        RELUCENT_ENGLISH_MESSAGE("device.recording-not-named", "the folder of the recording is not named")};
  return {};  // the recording knows all else
}

Problems problemsOf(const ScreenRigSettings& settings) {
  Problems found;
  checkSize(found, DeviceKind::projector, settings.projector);
  if (settings.camera) checkSize(found, DeviceKind::camera, *settings.camera);
  for (const ScreenRigSettings::Screen& screen : settings.moreScreens)
    checkSize(found, DeviceKind::projector, screen.projector);
  for (const ScreenRigSettings::Camera& camera : settings.moreCameras)
    if (camera.size) checkSize(found, DeviceKind::camera, *camera.size);
  if (settings.display == ScreenRigSettings::Display{})
    found.push_back(RELUCENT_ENGLISH_MESSAGE("calibration.no-screen-chosen", "no screen is chosen"));
  append(found, problemsOfDevices(settings));  // cameras may be chosen later
  for (const ScreenRigSettings::Screen& screen : screensOf(settings))
    if (!(screen.frameRate > 0.0))
      found.push_back(RELUCENT_ENGLISH_MESSAGE("device.screen-frame-rate-not-positive",
                                               "a screen's frame rate must be above 0"));
  checkTimes(found, settings);
  return found;
}

Problems problemsOf(const ImportedRigSettings& settings) {
  Problems found;
  checkSize(found, DeviceKind::projector, settings.projector);
  checkSize(found, DeviceKind::camera, settings.camera);
  return found;
}

void checkTarget(Problems& problems, const compensation::TargetSettings& target) {
  append(problems, compensation::problems(target));
}

}  // namespace

Problems problems(const CalibrateSettings& settings) {
  Problems found = std::visit([](const auto& rig) { return problemsOf(rig); }, settings.rig);
  append(found, problems(settings.linearization));
  append(found, problems(settings.acquisition));
  append(found, problems(settings.windows));
  append(found, problems(settings.clustering));
  append(found, problems(settings.content));
  append(found, problems(settings.network, settings.rig));
  return found;
}

Problems problems(const ContentSettings& settings) {
  Problems found;
  checkTarget(found, targetOf(settings));
  return found;
}

compensation::TargetSettings targetOf(const ContentSettings& settings) {
  compensation::TargetSettings target;
  target.corners = settings.corners;
  target.views = settings.views;
  target.viewer = settings.viewer;
  target.fit = settings.fit;
  target.reachablePercentile = settings.reachablePercentile;
  target.blackLift = settings.blackLift;
  target.brightness = settings.brightness;
  target.objective = settings.objective;
  target.clipping = settings.clipping;
  target.masks = settings.masks;
  return target;
}

std::vector<Message> problems(const VerifySettings& settings) {
  if (!settings.rig) return {};
  return std::visit([](const auto& rig) { return problemsOf(rig); }, *settings.rig);
}

Problems problems(const ImportPicturesSettings& settings) {
  Problems found;
  if (settings.patterns.empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("import.no-pattern-folder", "no folder of patterns is given"));
  if (settings.photographs.empty())
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("import.no-photograph-folder", "no folder of photographs is given"));
  append(found, problems(settings.import));
  return found;
}

Problems problems(const CompensateSettings& settings) {
  Problems found;
  if (settings.image.empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("settings.no-image", "no image is given"));
  if (settings.out.empty())
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("settings.no-output-folder", "no folder for the results is given"));
  checkTarget(found, settings.target);
  return found;
}

Problems problems(const ProveSettings& settings) {
  Problems found;
  if (settings.image.empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("settings.no-image", "no image is given"));
  if (settings.out.empty())
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("settings.no-output-folder", "no folder for the results is given"));
  checkTarget(found, settings.target);
  if (settings.canvas) append(found, problems(*settings.canvas));
  return found;
}

Problems problems(const EvaluateSettings& settings) {
  Problems found;
  checkTarget(found, settings.target);
  append(found, problems(settings.compensator));
  append(found, problems(settings.rivalSettings));
  if (settings.perfected != 0 && (settings.perfected < 2 || settings.perfected > mostPerfectingPhotographs))
    found.push_back(perfectingPhotographsOutOfRange());
  append(found, problems(settings.walk));
  return found;
}

Problems problems(const ExportSettings& settings) {
  if (!settings.transport.empty() || !settings.leaves.empty() || !settings.inverse.empty() ||
      !settings.maps.empty() || !settings.mpcdi.empty() || !settings.playerMaps.empty())
    return {};
  return {RELUCENT_ENGLISH_MESSAGE("calibration.nothing-to-export", "nothing was chosen to export")};
}

Problems problems(const RelightSettings& settings) {
  if (!settings.out.empty()) return {};
  return {RELUCENT_ENGLISH_MESSAGE("settings.no-output-file", "no file for the result is given")};
}

}  // namespace relucent::pipeline
