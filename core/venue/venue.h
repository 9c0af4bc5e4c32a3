// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/rig/rig.h"
#include "relucent/transport/transport_matrix.h"
#include "relucent/venue/changes.h"

namespace relucent::venue {

struct DeviceFault;
struct FaultSchedule;
/// The faults that are active during a shot. Called for each photograph, by the thread that takes it.
using FaultsDuring = std::function<std::vector<DeviceFault>(const rig::ShotId& shot)>;

/// A simulated venue that is available.
struct VenueDescription {
  std::string name;      // "corner"
  std::string sentence;  // short description
  int projectors = 1;
  int cameras = 1;
};
const std::vector<VenueDescription>& venues();

/// Imperfections of the simulated devices.
struct DeviceModelSettings {
  int projectorBits = 8;
  int cameraBits = 12;
  double contrast = 1500.0;    // projector's full white : black
  double gamma = 2.2;          // mean shape of the projector's response; each channel deviates from it
  double vignetting = 0.2;     // loss of light in the projector's corners
  double fullWell = 15000.0;   // electrons at full scale; decides the shot noise
  double readElectrons = 6.0;  // read noise
  double ambient = 0.002;      // room light, relative to the flood image's mean
  double drift = 0.0;          // relative change of lamp power over 1000 shots
  double flicker = 0.0;        // relative standard deviation of lamp power between exposures
  bool whiteSegment = false;   // the colour wheel has a white segment: channels are not additive
  double cameraGamma = 1.0;    // 1: linear; otherwise signal = light^(1 / cameraGamma)
};

struct VenueSettings {
  std::string name = "corner";
  Size projector{256, 192};  // each
  Size camera{160, 120};     // each
  std::uint64_t seed = 1;    // of the devices' noise; the scene does not depend on it
  int pathsPerPixel = 256;   // of the light tracer
  DeviceModelSettings devices{};
  Changes changes{};  // since it was built: its light is in the units that it had before
};
std::vector<Message> problems(const VenueSettings& settings);

class VenueLight;

/// A simulated venue: a scene with its traced light transport, and models of projectors and cameras with
/// quantisation, noise, saturation and response curves.
/// The brightest parts of the flood image reach full scale in 1/60 s.
class SimulatedVenue {
 public:
  /// Traces the scene, or reads its transport from `cache`, a folder, created if necessary; with an empty
  /// path nothing is cached. A damaged or foreign file in the cache is replaced.
  /// Throws: Error{input} for settings with problems(); Error{disk} if the cache cannot be written;
  /// Cancelled.
  SimulatedVenue(const VenueSettings& settings, const std::filesystem::path& cache, Progress& progress);
  ~SimulatedVenue();

  const VenueSettings& settings() const;
  /// Devices as the pipeline sees them. They may outlive this object. Each call gives a new set, showing
  /// black.
  rig::Rig rig() const;
  /// The same with faults (device_faults.h); the schedule may be changed while the rig is in use.
  rig::Rig rig(std::shared_ptr<const FaultSchedule> faults) const;
  /// The same with faults that depend on what has happened, as surprises do (surprises.h).
  rig::Rig rig(FaultsDuring faults) const;

  /// The true transport, for `evaluate` and tests only.
  /// T: camera signal per second per linear light of the projectors, free of noise. Vignetting is part of it;
  /// the response curves, the white segment and the black level are not.
  const transport::TransportMatrix& trueTransport() const;
  /// e: the projectors' black level and the ambient light, camera signal per second.
  const CameraStack& trueBlack() const;
  /// Camera signal per second under encoded drive, rounded to codes as the projectors do, free of noise.
  CameraStack trueRadiance(const std::vector<image::Image>& encodedDrive) const;

  /// What simulated devices (played_show.h) are made of.
  const VenueLight& light() const { return *light_; }

  /// The same venue as viewers see it who stand where no camera does, for `evaluate` and tests only: its
  /// cameras are those places. Traced or read from the cache when this is called. None: the scene has none.
  /// Throws: as the constructor.
  std::optional<SimulatedVenue> fromHiddenPlaces(Progress& progress) const;

 private:
  SimulatedVenue(std::shared_ptr<const VenueLight> light, std::filesystem::path cache);

  std::shared_ptr<const VenueLight> light_;
  std::filesystem::path cache_;
};

}  // namespace relucent::venue
