// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "relucent/venue/mesh.h"

namespace relucent::venue {

struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;  // unit vector
};

/// Where a ray meets a triangle.
struct RayHit {
  float distance = 0.0f;
  std::uint32_t mesh = 0;
  std::uint32_t triangle = 0;
  float u = 0.0f, v = 0.0f;  // weights of the triangle's second and third vertex
  Eigen::Vector3f normal;    // geometric, unit vector, outwards
};

/// Finds the first intersection of rays with meshes. The only class that uses Embree.
class RayCaster {
 public:
  explicit RayCaster(const std::vector<const Mesh*>& meshes);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  std::optional<RayHit> nearest(const Ray& ray) const;
  /// Whether anything lies on the ray nearer than `distance`.
  bool blocked(const Ray& ray, float distance) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relucent::venue
