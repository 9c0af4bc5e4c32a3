// SPDX-License-Identifier: MIT
#include "relucent/venue/scene_rays.h"

namespace relucent::venue {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Rays begin and end this far from surfaces, metres: well above the rounding of floats at a room's size.
constexpr float clearance = 5e-5f;

std::vector<const Mesh*> meshesOf(const Scene& scene) {
  std::vector<const Mesh*> meshes;
  for (const Surface& surface : scene.surfaces) meshes.push_back(&surface.mesh);
  return meshes;
}

}  // namespace

ScatteringPoint SurfacePoint::scatteringTowards(const Vector3f& direction) const {
  ScatteringPoint point;
  float side = geometricNormal.dot(direction) < 0.0f ? -1.0f : 1.0f;
  point.geometricNormal = side * geometricNormal;
  point.normal = side * normal;
  point.outgoing = direction;
  point.diffuse = reflectance(material->texture({position, map}));
  point.gloss = material->gloss;
  point.glossExponent = material->glossExponent;
  return point;
}

SceneRays::SceneRays(const Scene& scene) : scene_(scene), caster_(meshesOf(scene)) {}

std::optional<SurfacePoint> SceneRays::nearest(const Ray& ray) const {
  std::optional<RayHit> hit = caster_.nearest(ray);
  if (!hit) return std::nullopt;
  const Surface& surface = scene_.surfaces[hit->mesh];
  const auto& corners = surface.mesh.triangles[hit->triangle];
  float weights[3] = {1.0f - hit->u - hit->v, hit->u, hit->v};

  SurfacePoint point;
  point.position = ray.origin + hit->distance * ray.direction;
  point.distance = hit->distance;
  point.geometricNormal = hit->normal;
  point.normal = hit->normal;
  point.material = &surface.material;
  point.map = Vector2f::Zero();
  for (std::size_t i = 0; i < 3; ++i) point.map += weights[i] * surface.mesh.map[corners[i]];
  if (!surface.mesh.normals.empty()) {
    Vector3f normal = Vector3f::Zero();
    for (std::size_t i = 0; i < 3; ++i) normal += weights[i] * surface.mesh.normals[corners[i]];
    point.normal = normal.normalized();
  }
  return point;
}

Ray SceneRays::leaving(const SurfacePoint& point, const Vector3f& direction) {
  float side = point.geometricNormal.dot(direction) < 0.0f ? -clearance : clearance;
  return {point.position + side * point.geometricNormal, direction};
}

bool SceneRays::free(const SurfacePoint& point, const Vector3f& direction, float distance) const {
  return !caster_.blocked(leaving(point, direction), distance - 2.0f * clearance);
}

}  // namespace relucent::venue
