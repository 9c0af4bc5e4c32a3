// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "relucent/base/message.h"

namespace relucent::venue {

struct Scene;

/// A device that looks elsewhere than it did.
struct Turned {
  std::size_t device = 0;   // from 0 on
  double x = 0.0, y = 0.0;  // pixels of its raster by which the middle of its picture moves, right and down
  double degrees = 0.0;     // by which its picture turns, clockwise
};

/// A place on what the first camera sees, as shares of its picture's width and height.
struct SeenPlace {
  double x = 0.5, y = 0.5;
};

/// Paint on whatever is within `radius` of a place.
struct Painted {
  SeenPlace place;
  double radius = 0.1;  // m
  std::array<double, 3> colour{0.20, 0.45, 0.30};
};

/// The surface that is seen at a place, moved to the right as the first camera sees it.
struct Moved {
  SeenPlace place;
  double distance = 0.05;  // m
};

/// A ball of cardboard that lies on what is seen at a place.
struct Added {
  SeenPlace place;
  double diameter = 0.15;  // m
};

/// What has become of a venue since it was measured: of the scene and its devices, which are traced anew.
/// Nothing by default.
struct Changes {
  std::vector<Turned> cameras, projectors;
  /// What is left of all lamps' light at long, middle and short wavelengths.
  std::array<double, 3> lamps{1.0, 1.0, 1.0};
  /// What a filter lets pass that all cameras have had before their lenses since.
  std::array<double, 3> filter{1.0, 1.0, 1.0};
  double dust = 0.0;  // share of light that the thickest of it takes, on every projector's lens
  std::vector<Painted> painted;
  std::vector<Moved> moved;
  std::vector<Added> added;
  std::optional<double> ambient;  // room light, see DeviceModelSettings; none: as it was

  bool any() const;
  /// Whether light takes other ways, or is another: all but the room's.
  bool ofTransport() const;
};
std::vector<Message> problems(const Changes& changes);

/// In the order: moved, added, painted, then the devices; places are those of the scene as it was.
/// Contract: no problems(), devices that there are; places where nothing is seen change nothing.
void apply(const Changes& changes, Scene& scene);

}  // namespace relucent::venue
