// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "rig/rig.h"
#include "transport/transport_matrix.h"

namespace relucent {

/// A simulated venue on offer.
struct VenueDescription {
  std::string name;      // "corner"
  std::string sentence;  // what there is to see
  int projectors = 1;
};
const std::vector<VenueDescription>& venues();

/// Imperfections of the simulated devices.
struct DeviceModelSettings {
  int projectorBits = 8;
  int cameraBits = 12;
  double contrast = 1500.0;    // full white : black of the projector
  double gamma = 2.2;          // overall shape of the projector's response; each channel deviates from it
  double vignetting = 0.2;     // loss of light in the projector's corners
  double fullWell = 15000.0;   // electrons at full scale: shot noise
  double readElectrons = 6.0;  // read noise
  double ambient = 0.002;      // room light, relative to the flood image's mean
  double drift = 0.0;          // relative change of lamp power over 1000 shots
  bool whiteSegment = false;   // a fourth, white segment: additivity broken
  double flicker = 0.0;        // relative standard deviation of lamp power between exposures
  double cameraGamma = 1.0;    // other than 1: the camera applies a response curve
};

struct VenueSettings {
  std::string name = "corner";
  Size projector{256, 192};
  Size camera{160, 120};
  std::uint64_t seed = 1;
  int pathsPerPixel = 256;
  DeviceModelSettings devices;
};
std::vector<std::string> problems(const VenueSettings& settings);

/// A venue that exists only in the computer: a scene traced into its light transport, and models of a
/// projector and a camera that answer from it with noise, quantisation, saturation and a response curve.
class SimulatedVenue {
 public:
  /// Traces the scene, or reads its transport from `cache` (a folder; created; empty path: no cache).
  /// Throws: Error{input} for an unknown name or an impossible size, naming what there is.
  SimulatedVenue(const VenueSettings& settings, const std::filesystem::path& cache, Progress& progress);
  ~SimulatedVenue();

  const VenueSettings& settings() const;
  /// The devices, as the pipeline sees them. Share the venue's data; may outlive this object.
  Rig rig() const;

  /// The truth, for `evaluate` and for tests only.
  /// T of linear light, without vignetting of the lens left out: as the camera would measure it, free of
  /// noise.
  const TransportMatrix& trueTransport() const;
  /// e: black level of the projector and ambient light, camera signal per second.
  const Stack& trueBlack() const;
  /// What the cameras would measure under encoded drive values (rounded to codes, through the projector's
  /// true response), free of noise: camera signal per second.
  Stack trueRadiance(const std::vector<Image>& encodedDrive) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace relucent
