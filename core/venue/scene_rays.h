// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/venue/ray_caster.h"
#include "relucent/venue/scene.h"

namespace relucent::venue {

/// Where a ray meets a surface of a scene.
struct SurfacePoint {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;           // of the smooth surface, outwards
  Eigen::Vector3f geometricNormal;  // of its triangle, outwards
  Eigen::Vector2f map;
  float distance = 0.0f;
  const Material* material = nullptr;

  /// The surface point for a ray that arrives along `direction`.
  ScatteringPoint scatteringTowards(const Eigen::Vector3f& direction) const;
};

/// Rays through a scene, which must outlive this.
class SceneRays {
 public:
  explicit SceneRays(const Scene& scene);

  std::optional<SurfacePoint> nearest(const Ray& ray) const;
  /// Whether light passes freely from `point` along `direction` for `distance`. Glass blocks it.
  bool free(const SurfacePoint& point, const Eigen::Vector3f& direction, float distance) const;
  /// The ray that leaves `point` along `direction`.
  static Ray leaving(const SurfacePoint& point, const Eigen::Vector3f& direction);

 private:
  const Scene& scene_;
  RayCaster caster_;
};

}  // namespace relucent::venue
