// SPDX-License-Identifier: MIT
#include "relucent/venue/caustics.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/parallel.h"

namespace relucent::venue {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int longestChain = 16;  // boundaries of glass that one path may cross

/// Where a path from the projector ends after at least one boundary of glass; power 0: nowhere.
Caustics::Photon follow(const SceneRays& rays, Ray ray, const SamplePattern& samples, int sample,
                        const Vector2f& shift) {
  Caustics::Photon photon;
  for (int boundary = 0; boundary <= longestChain; ++boundary) {
    std::optional<SurfacePoint> point = rays.nearest(ray);
    if (!point) return photon;
    if (!point->material->isGlass()) {
      if (boundary == 0) return photon;
      photon.position = point->position;
      photon.direction = ray.direction;
      photon.power = 1.0f;
      return photon;
    }
    float choice = samples.point(sample, 2 + boundary, shift).x();
    ray = SceneRays::leaving(
        *point, throughGlass(ray.direction, point->normal, point->material->refractiveIndex, choice));
  }
  return photon;
}

}  // namespace

Caustics::Caustics(const Scene& scene, const SceneRays& rays, int perPixel, float radius) : radius_(radius) {
  bool anyGlass = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                              [](const Surface& surface) { return surface.material.isGlass(); });
  if (!anyGlass) return;
  SamplePattern samples(perPixel, 0xca057);
  for (std::size_t p = 0; p < scene.projectors.size(); ++p) {
    const ProjectorOptics& projector = scene.projectors[p];
    std::vector<std::vector<Photon>> lines(static_cast<std::size_t>(projector.raster.height));
    parallelFor(0, lines.size(), 4, [&](std::size_t y) {
      for (int x = 0; x < projector.raster.width; ++x) {
        for (int sample = 0; sample < perPixel; ++sample) {
          Vector2f shift(std::fmod(0.618034f * static_cast<float>(x), 1.0f),
                         std::fmod(0.7548777f * static_cast<float>(y), 1.0f));
          Vector2f place =
              Vector2f(static_cast<float>(x), static_cast<float>(y)) + samples.point(sample, 0, shift);
          Emission emission = projector.emission(place, samples.point(sample, 1, shift));
          Photon photon = follow(rays, emission.ray, samples, sample, shift);
          if (photon.power <= 0.0f) continue;
          photon.power = emission.power / static_cast<float>(perPixel);
          photon.x = static_cast<std::uint16_t>(x);
          photon.y = static_cast<std::uint16_t>(y);
          photon.projector = static_cast<std::uint16_t>(p);
          lines[y].push_back(photon);
        }
      }
    });
    for (const auto& line : lines) photons_.insert(photons_.end(), line.begin(), line.end());
  }
  sortIntoCells();
}

Eigen::Vector3i Caustics::cellOf(const Vector3f& position) const {
  return (position / radius_).array().floor().cast<int>();
}

std::uint64_t Caustics::cellKey(int x, int y, int z) const {
  auto part = [](int value) { return static_cast<std::uint64_t>(value + (1 << 20)) & 0x1fffffu; };
  return part(x) << 42 | part(y) << 21 | part(z);
}

void Caustics::sortIntoCells() {
  auto keyOf = [&](const Photon& photon) {
    Eigen::Vector3i cell = cellOf(photon.position);
    return cellKey(cell.x(), cell.y(), cell.z());
  };
  std::stable_sort(photons_.begin(), photons_.end(),
                   [&](const Photon& a, const Photon& b) { return keyOf(a) < keyOf(b); });
  for (std::uint32_t i = 0; i < photons_.size(); ++i) {
    auto [cell, fresh] = cells_.try_emplace(keyOf(photons_[i]), i, i);
    cell->second.second = i + 1;
  }
}

}  // namespace relucent::venue
