// SPDX-License-Identifier: MIT
#pragma once

#include "support/scripted_rig.h"

namespace relucent::test {

inline constexpr Size commandProjector{16, 12};
inline constexpr Size commandCamera{12, 9};

/// The venue that command-venue photographs and that its test knows the truth of.
inline ScriptedVenue commandVenue() {
  SyntheticSettings scene;
  scene.projectors = {commandProjector};
  scene.cameras = {commandCamera};
  ScriptedSettings devices;
  ScriptedCamera camera;
  camera.exposures = {1e-4, 2.0};
  devices.cameras = {camera};
  transport::TransportMatrix transport = syntheticTransport(scene);
  CameraStack black = syntheticBlack(transport);
  return ScriptedVenue(std::move(transport), std::move(black), devices);
}

}  // namespace relucent::test
