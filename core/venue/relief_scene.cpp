// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "relucent/venue/pi.h"

#include "relucent/venue/scenes.h"

namespace relucent::venue {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Half an ellipsoid on the slab: how far it stands out, `offset` from its middle in units of its radii.
float halfEllipsoid(float depth, const Vector2f& offset) {
  return depth * std::sqrt(std::max(0.0f, 1.0f - offset.squaredNorm()));
}

/// How far the carved stone stands out of the slab at a place, metres: two fluted half columns, between them
/// a flower in a garland of fruit.
float carvedRelief(const Vector2f& place) {
  float height = 0.03f * fractalNoise(5.0f * Vector3f(place.x(), place.y(), 1.0f), 3);
  for (float middle : {-0.56f, 0.56f}) {
    float across = (place.x() - middle) / 0.10f;
    if (std::abs(across) >= 1.0f) continue;
    float flutes = 0.006f * std::cos(14.0f * std::asin(across));
    height = std::max(height, halfEllipsoid(0.20f, {across, 0.0f}) + flutes);
  }
  float radius = place.norm(), angle = std::atan2(place.y(), place.x());
  float petal = 0.22f + 0.05f * std::cos(8.0f * angle);
  height = std::max(height, halfEllipsoid(0.09f, {radius / petal, 0.0f}));
  height = std::max(height, halfEllipsoid(0.20f, place / 0.10f));
  float fruit = std::round(6.0f * angle / pi) * pi / 6.0f;
  Vector2f middle = 0.36f * Vector2f(std::cos(fruit), std::sin(fruit));
  return std::max(height, halfEllipsoid(0.11f, (place - middle) / 0.06f));
}

/// Glazed as the della Robbias did: white on blue.
Eigen::Array3f glaze(const TexturePoint& point) {
  static const Texture figures = stone({0.76f, 0.72f, 0.62f}), ground = cardboard({0.22f, 0.36f, 0.56f});
  float share = std::clamp((point.position.z() - 0.03f) / 0.012f, 0.0f, 1.0f);
  return share * figures(point) + (1.0f - share) * ground(point);
}

}  // namespace

/// A high relief that two projectors light from both sides: where one throws the shadow of what stands out,
/// the other shines.
Scene reliefScene(const VenueSettings& settings) {
  Scene scene;
  constexpr int columns = 301, rows = 201;
  constexpr float pitch = 0.01f;
  auto map = [](int i, int j) {
    return Vector2f(pitch * static_cast<float>(i), pitch * static_cast<float>(j));
  };
  auto place = [&](int i, int j) -> Vector3f {
    Vector2f slab = map(i, j) - 0.5f * pitch * Vector2f(columns - 1, rows - 1);
    return {slab.x(), slab.y(), carvedRelief(slab)};
  };
  scene.surfaces.push_back({grid(columns, rows, false, place, map), {glaze}});

  const Vector3f target(0.0f, 0.0f, 0.05f);
  constexpr float defocus = 8.0f;
  placeDevices(scene, settings, target, defocus);
  ProjectorOptics projector = scene.projectors.front();
  scene.projectors.clear();
  for (float side : {-1.0f, 1.0f}) {
    projector.pose = Pose::lookingAt({1.25f * side, 0.15f, 2.1f}, target);
    projector.focus = (target - projector.pose.position).norm();
    projector.aperture = defocus * projector.pixelPitch();
    scene.projectors.push_back(projector);
  }
  scene.cameras.front().pose = Pose::lookingAt({0.0f, 0.10f, 2.5f}, target);
  return scene;
}

}  // namespace relucent::venue
