// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "relucent/base/raster.h"
#include "relucent/venue/ray_caster.h"
#include "relucent/venue/spectra.h"

namespace relucent::venue {

/// Position and orientation of a device; right, up and forward are orthonormal.
struct Pose {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector3f right = Eigen::Vector3f::UnitX();
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();
  Eigen::Vector3f forward = -Eigen::Vector3f::UnitZ();

  /// Upright, looking at `target`.
  static Pose lookingAt(const Eigen::Vector3f& position, const Eigen::Vector3f& target);
};

/// A pinhole camera: a pixel's signal is the mean radiance over a trapezoid slightly wider than the pixel.
struct CameraOptics {
  Size raster;
  Pose pose;
  float throwRatio = 1.5f;                   // distance : width of the picture
  Spectrum transmission = Spectrum::Ones();  // of what is before its lens

  /// The ray through a position on the raster (pixels; pixel x covers [x, x + 1)).
  Ray ray(const Eigen::Vector2f& place) const;
};

/// A path from a point of the scene to a projector.
struct LensConnection {
  Eigen::Vector3f direction;  // towards the lens
  float distance = 0.0f;
  Eigen::Vector2f place;    // position on the projector's raster; its pixel determines the light
  float irradiance = 0.0f;  // of a surface that faces the lens, at full drive
  float pixelArea = 0.0f;   // m^2 that one projector pixel covers there, perpendicular to the direction
};

/// A light path that leaves a projector.
struct Emission {
  Ray ray;
  float power = 0.0f;  // of one pixel at full drive, if all its light followed this path
};

/// A projector with a thin lens: a point at depth d is lit by a disc of diameter
///   aperture * |d - focus| / focus     (measured at d)
/// of the picture. Units: a surface at distance `focus` on the axis, facing the lens, has irradiance 1 at
/// full drive; across that plane irradiance falls only by vignetting.
struct ProjectorOptics {
  Size raster;
  Pose pose;
  float throwRatio = 1.6f;                   // distance : width of the picture
  float focus = 2.5f;                        // m
  float aperture = 0.02f;                    // diameter of the lens, m
  float vignetting = 0.0f;                   // loss of light in the corners
  float dust = 0.0f;                         // share of light that the thickest of it takes, in blotches
  Spectrum transmission = Spectrum::Ones();  // of what is left of the lamp's light

  /// Width of one pixel on the focal plane, m.
  float pixelPitch() const { return focus / (throwRatio * static_cast<float>(raster.width)); }

  /// From `point` to the position on the lens given by `lens`, a point of the unit square.
  /// Empty if the path does not come from the picture.
  std::optional<LensConnection> connect(const Eigen::Vector3f& point, const Eigen::Vector2f& lens) const;
  /// From a position on the raster through a position on the lens.
  Emission emission(const Eigen::Vector2f& place, const Eigen::Vector2f& lens) const;

 private:
  Eigen::Vector3f onLens(const Eigen::Vector2f& lens) const;
  /// Radiance times area of the lens, for a position on the raster whose angles from the axis have the
  /// tangents `tangents`.
  float strength(const Eigen::Vector2f& tangents) const;
};

/// Maps the unit square to the unit disc, preserving ratios of areas.
/// Source: Shirley & Chiu, "A low distortion map between disk and square", 1997.
Eigen::Vector2f discFromSquare(const Eigen::Vector2f& square);

}  // namespace relucent::venue
