// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "relucent/devices/camera_driver.h"
#include "relucent/devices/gphoto/gphoto_settings.h"
#include "relucent/devices/shutter_speed.h"

namespace relucent::devices {

/// How a still camera is driven once it is set up.
struct GphotoSetup {
  std::string shutter;  // the setting that holds the exposure time
  ShutterList speeds;
  /// The setting that opens and closes the shutter in bulb, with its words for that; empty: none has it.
  struct Bulb {
    std::string setting, open, close;
  };
  std::optional<Bulb> bulb{};
};

/// Sets a camera up for measuring: manual exposure, raw files, kept in the camera's memory and not on its
/// card, lowest sensitivity (or `iso`), no flash, no bursts, no dark frames of its own, manual focus, awake.
/// The first three have to be, the others are left as they are where the camera does not know them.
/// Fills model, gain and remarks of `traits`, and its range of exposures.
/// Throws: Error{device} that says what to switch at the camera by hand; GphotoFailure.
GphotoSetup setUpGphoto(BorrowedSettings& settings, const std::string& name, std::optional<int> iso,
                        CameraTraits& traits);

/// Of the choices for picture quality the one to be photographed with: raw files alone, of full size and
/// without loss, before those with a JPEG beside, before lossy ones. None if there are no raw files.
std::optional<std::string> rawChoice(const std::vector<std::string>& choices);

}  // namespace relucent::devices
