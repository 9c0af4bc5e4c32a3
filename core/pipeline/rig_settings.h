// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/venue/venue.h"

namespace relucent::pipeline {

/// External programs as devices: anybody's camera by script. Several of them: command_devices.h has both as
/// lists.
/// {image} in the projector's command is the file to show; {exposure} in the camera's command is the time
/// in seconds, {output} the file to write (float EXR, 16-bit PNG or TIFF, or 8-bit).
struct CommandRigSettings {
  std::string projectorCommand;
  std::string cameraCommand;
  Size projector;
  std::optional<Size> camera;      // none: the size of the first photograph
  double shortestExposure = 1e-3;  // seconds
  double longestExposure = 4.0;    // seconds
  /// A camera that Relucent drives itself, by its address (devices/camera_address.h), in place of the
  /// camera's command and exposures.
  std::string cameraAddress{};
  double latency = 0.0;  // seconds from the end of the projector's command until its picture is out
  std::string
      record{};  // folder for all that is shown and photographed (devices/recording/recording.h); empty: none
  /// Pictures a second of the projector: exposures become whole pictures (devices/whole_frames.h). 0: as they
  /// are asked for.
  double frameRate = 0.0;

  /// A projector beside the first one, which the fields above are of.
  struct Projector {
    std::string command;
    Size size;
    bool operator==(const Projector&) const = default;
  };
  /// A camera beside the first one: by its command, or by its address. Exposures are those that all cameras
  /// can take.
  struct Camera {
    std::string command;
    std::string address{};
    std::optional<Size> size{};  // none: of a command's first photograph; all that a camera has
    bool operator==(const Camera&) const = default;
  };
  std::vector<Projector> moreProjectors{};
  std::vector<Camera> moreCameras{};
};

/// Screens of the desktop as projectors, and any cameras by their addresses; screen_devices.h has both as
/// lists. Opened by whoever has windows (pipeline/devices.h).
struct ScreenRigSettings {
  /// What the screen is known by after it was unplugged: its maker's names where it tells them, else where it
  /// is plugged in.
  struct Display {
    std::string connector;  // "HDMI-1"
    std::string manufacturer, model, serialNumber;
    bool operator==(const Display&) const = default;
  };
  Display display;
  Size projector;                  // the screen's own pixels
  double frameRate = 60.0;         // pictures a second: exposures are whole pictures
  std::string cameraAddress{};     // devices/camera_address.h; empty: not chosen yet
  std::optional<Size> camera{};    // none: all that it has
  double shortestExposure = 1e-3;  // seconds; of external programs, which cannot be asked
  double longestExposure = 4.0;
  double latency = 0.0;  // seconds from the swap until the picture is out; 0: measured at the step Camera

  /// A screen beside the first one, which the fields above are of.
  struct Screen {
    Display display;
    Size projector;
    double frameRate = 60.0;
    std::string name{};  // what people call the projector; empty: its number
    bool operator==(const Screen&) const = default;
  };
  /// A camera beside the first one. Exposures are those that all cameras can take.
  struct Camera {
    std::string address;
    std::optional<Size> size{};  // none: all that it has
    std::string name{};
    bool operator==(const Camera&) const = default;
  };
  std::string name{}, cameraName{};  // of the first ones
  std::vector<Screen> moreScreens{};
  std::vector<Camera> moreCameras{};  // only where the first one is chosen
};

/// A recording in place of devices (devices/recording/recording.h).
struct ReplayRigSettings {
  std::string folder;
};

/// No devices: patterns and photographs of them that were taken elsewhere.
struct ImportedRigSettings {
  Size projector;  // of the patterns
  Size camera;     // of the photographs
  int pictures = 0;
  std::string patterns;  // folders that they were read from
  std::string photographs;
  std::string fingerprint;  // of all pictures' files
};

/// How the rig is made: a simulated venue, external programs, a screen of the desktop, a recording, or none
/// at all.
using RigSettings = std::variant<venue::VenueSettings, CommandRigSettings, ImportedRigSettings,
                                 ReplayRigSettings, ScreenRigSettings>;

/// The same venue as it has become since: simulated ones only.
/// Throws: Error{input} if another rig is to have changed.
RigSettings changedRig(RigSettings rig, const venue::Changes& changes);

}  // namespace relucent::pipeline
