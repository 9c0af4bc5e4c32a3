// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <unordered_map>
#include <vector>

#include "relucent/venue/pi.h"
#include "relucent/venue/sample_pattern.h"
#include "relucent/venue/scene_rays.h"

namespace relucent::venue {

/// Light that reaches opaque surfaces through glass, traced from the projectors and stored where it lands:
/// paths that no connection from the camera's side can find.
/// Source: Jensen, "Global illumination using photon maps", 1996.
class Caustics {
 public:
  struct Photon {
    Eigen::Vector3f position;
    Eigen::Vector3f direction;   // of travel
    float power = 0.0f;          // at full drive
    std::uint16_t x = 0, y = 0;  // projector pixel
    std::uint16_t projector = 0;
  };

  /// None. For scenes without glass.
  Caustics() = default;
  /// `perPixel` photons for every projector pixel that meets glass, gathered within `radius` metres.
  Caustics(const Scene& scene, const SceneRays& rays, int perPixel, float radius);

  bool empty() const { return photons_.empty(); }
  std::size_t count() const { return photons_.size(); }

  /// Calls visit(photon, irradiance) for every photon that lights a surface around `position`; the
  /// irradiances add up to the caustic's density there (cone kernel).
  template <typename Visit>
  void gather(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, const Visit& visit) const;

 private:
  std::uint64_t cellKey(int x, int y, int z) const;
  Eigen::Vector3i cellOf(const Eigen::Vector3f& position) const;
  void sortIntoCells();

  float radius_ = 1.0f;
  std::vector<Photon> photons_;                                                       // by cell
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> cells_;  // begin, end
};

template <typename Visit>
void Caustics::gather(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                      const Visit& visit) const {
  Eigen::Vector3i centre = cellOf(position);
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        auto cell = cells_.find(cellKey(centre.x() + dx, centre.y() + dy, centre.z() + dz));
        if (cell == cells_.end()) continue;
        for (std::uint32_t i = cell->second.first; i < cell->second.second; ++i) {
          const Photon& photon = photons_[i];
          float squared = (photon.position - position).squaredNorm();
          if (squared >= radius_ * radius_ || photon.direction.dot(normal) >= 0.0f) continue;
          float distance = std::sqrt(squared);
          visit(photon, photon.power * 3.0f * (1.0f - distance / radius_) / (pi * radius_ * radius_));
        }
      }
    }
  }
}

}  // namespace relucent::venue
