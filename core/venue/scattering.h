// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "relucent/venue/spectra.h"
#include "relucent/venue/texture.h"

namespace relucent::venue {

/// What a surface is made of: diffuse with some gloss, or clear glass.
struct Material {
  Texture texture;               // diffuse reflectance
  float gloss = 0.0f;            // share of light that is reflected glossily, without colour
  float glossExponent = 40.0f;   // larger is sharper
  float refractiveIndex = 0.0f;  // above 1: glass; the other fields are ignored

  bool isGlass() const { return refractiveIndex > 1.0f; }
};

/// A point where light meets an opaque surface. Both normals point to the side of `outgoing`.
struct ScatteringPoint {
  Eigen::Vector3f normal;           // of the smooth surface
  Eigen::Vector3f geometricNormal;  // of its triangle
  Eigen::Vector3f outgoing;         // unit vector in the direction of the reflected light
  Spectrum diffuse;                 // reflectance
  float gloss = 0.0f;
  float glossExponent = 0.0f;

  /// BRDF, 1/sr, for light from `incoming` (unit vector towards the light):
  ///   (1 - g) rho / pi + g (n + 2) / (2 pi) cos^n(angle to the mirror direction)
  /// Reciprocal and energy-conserving.
  /// Source: Lafortune & Willems, "Using the modified Phong reflectance model for physically based
  /// rendering", 1994.
  Spectrum brdf(const Eigen::Vector3f& incoming) const;
  float cosine(const Eigen::Vector3f& incoming) const;
};

/// A sampled direction of incoming light.
struct Bounce {
  Eigen::Vector3f direction;
  float density = 0.0f;  // of directions, 1/sr
  Spectrum weight;       // brdf * cosine / density; 0: no light from this direction
};

/// Samples a direction roughly in proportion to its contribution.
Bounce sampleBounce(const ScatteringPoint& point, const Eigen::Vector2f& sample, float choice);

/// Continues a ray at a boundary of clear glass, reflected or refracted with Fresnel's probabilities, so that
/// its weight stays 1. `normal`: outwards from the glass. `choice`: in [0, 1).
Eigen::Vector3f throughGlass(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal,
                             float refractiveIndex, float choice);

}  // namespace relucent::venue
