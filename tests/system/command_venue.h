// SPDX-License-Identifier: MIT
#pragma once

#include "support/scripted_rig.h"

namespace relucent::test {

inline constexpr Size commandProjector{16, 12};
inline constexpr Size commandCamera{12, 9};
/// Beside them, of the venue of several.
inline constexpr Size secondProjector{12, 16};
inline constexpr Size secondCamera{9, 12};

/// The venue that command-venue photographs and that its test knows the truth of. Of several: two projectors
/// and two cameras, of other sizes.
inline ScriptedVenue commandVenue(bool several = false) {
  SyntheticSettings scene;
  scene.projectors = {commandProjector};
  scene.cameras = {commandCamera};
  if (several) {
    scene.projectors.push_back(secondProjector);
    scene.cameras.push_back(secondCamera);
  }
  ScriptedSettings devices;
  ScriptedCamera camera;
  camera.exposures = {1e-4, 2.0};
  devices.cameras = {camera};
  transport::TransportMatrix transport = syntheticTransport(scene);
  CameraStack black = syntheticBlack(transport);
  return ScriptedVenue(std::move(transport), std::move(black), devices);
}

}  // namespace relucent::test
