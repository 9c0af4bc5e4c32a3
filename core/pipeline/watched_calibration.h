// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/monitoring/watched_venue.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/rig/rig.h"

namespace relucent::pipeline {

/// What one camera of a calibration has to know to watch a show (core/monitoring). Keeps nothing of
/// `measured`. Contract: it has such a camera.
monitoring::WatchedVenue watchedVenueOf(const MeasuredCalibration& measured, std::size_t camera,
                                        const monitoring::SamplingSettings& sampling = {});

/// The linear light of every drive code of 8 bits, per projector and channel: what pictures that were sent
/// are read with.
using CodeLights = std::vector<std::array<std::array<float, 256>, 3>>;
CodeLights lightOfCodes(const linearization::Linearization& linearization);

/// Which camera of a calibration watches its show.
struct WatchSettings {
  std::size_t camera = 0;  // of the calibration's, from 0
  std::string address{};   // where it is now (devices/camera_address.h); empty: where it was
  bool operator==(const WatchSettings&) const = default;
};

/// A camera that is open and stays.
struct WatchingCamera {
  monitoring::WatchedVenue venue;
  CodeLights lights;
  std::vector<double> exposures;      // seconds, longest first
  std::unique_ptr<rig::Rig> devices;  // what is open
  rig::Rig used;                      // the same with photographs as the calibration has them
  rig::Camera& camera() { return *used.cameras.front(); }
};

/// Reads what a camera has to know of its venue; T is let go of afterwards.
/// Throws: as loadMeasurements(); Error{input} if there is no such camera.
WatchingCamera readWatchedVenue(const std::filesystem::path& calibration, const WatchSettings& settings,
                                Progress& progress);
/// Opens the camera alone, no projector. Throws: Error{input} if the calibration names no camera that sees a
/// show, or it delivers photographs of another size; as devices::CameraRegistry::open().
void openCamera(const std::filesystem::path& calibration, const WatchSettings& settings,
                WatchingCamera& watching);

}  // namespace relucent::pipeline
