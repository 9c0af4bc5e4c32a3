// SPDX-License-Identifier: MIT
#include "relucent/venue/changes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/venue/scene_rays.h"

namespace relucent::venue {
namespace {

using Eigen::Array3f;
using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr std::array<double, 3> everything{1.0, 1.0, 1.0};

/// What is seen at a place, and which surface it is.
struct Seen {
  Vector3f position, normal;  // towards the camera
  std::size_t surface = 0;
};

std::optional<Seen> seenAt(const SeenPlace& place, const Scene& scene, const SceneRays& rays) {
  const CameraOptics& camera = scene.cameras.front();
  const Vector2f pixel(static_cast<float>(place.x * camera.raster.width),
                       static_cast<float>(place.y * camera.raster.height));
  const Ray ray = camera.ray(pixel);
  const std::optional<SurfacePoint> point = rays.nearest(ray);
  if (!point) return std::nullopt;
  const Vector3f& normal = point->geometricNormal;
  std::size_t surface = 0;
  while (&scene.surfaces[surface].material != point->material) ++surface;
  return Seen{point->position, normal.dot(ray.direction) < 0.0f ? normal : Vector3f(-normal), surface};
}

/// Its picture moves to the right when a device turns to the left.
template <typename Optics>
void turn(Optics& device, const Turned& turned, float picture) {
  const auto focal = device.throwRatio * static_cast<float>(device.raster.width);
  Pose& pose = device.pose;
  const Vector3f right = pose.right, up = pose.up;
  pose.forward = (pose.forward - picture * static_cast<float>(turned.x) / focal * right +
                  picture * static_cast<float>(turned.y) / focal * up)
                     .normalized();
  const auto angle = picture * static_cast<float>(turned.degrees * std::numbers::pi / 180.0);
  const Vector3f rolled = std::cos(angle) * right + std::sin(angle) * up;
  pose.right = (rolled - rolled.dot(pose.forward) * pose.forward).normalized();
  pose.up = pose.right.cross(pose.forward);
}

void move(Surface& surface, const Vector3f& by) {
  for (Vector3f& position : surface.mesh.positions) position += by;
  surface.material.texture = [texture = surface.material.texture, by](const TexturePoint& point) {
    return texture({point.position - by, point.map});
  };
}

void paint(Scene& scene, const Vector3f& centre, const Painted& painted) {
  const auto radius = static_cast<float>(painted.radius);
  Array3f colour(static_cast<float>(painted.colour[0]), static_cast<float>(painted.colour[1]),
                 static_cast<float>(painted.colour[2]));
  for (Surface& surface : scene.surfaces) {
    if (surface.material.isGlass()) continue;
    surface.material.texture = [=, texture = surface.material.texture](const TexturePoint& point) -> Array3f {
      if ((point.position - centre).squaredNorm() < radius * radius) return colour;
      return texture(point);
    };
  }
}

Spectrum spectrumOf(const std::array<double, 3>& shares) {
  return reflectance(
      {static_cast<float>(shares[0]), static_cast<float>(shares[1]), static_cast<float>(shares[2])});
}

}  // namespace

bool Changes::any() const {
  return ofTransport() || ambient;
}

bool Changes::ofTransport() const {
  return !cameras.empty() || !projectors.empty() || lamps != everything || filter != everything ||
         dust != 0.0 || !painted.empty() || !moved.empty() || !added.empty();
}

std::vector<Message> problems(const Changes& changes) {
  std::vector<Message> found;
  const auto check = [&](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      found.push_back(
          RELUCENT_ENGLISH_MESSAGE("venue.setting-out-of-range", "{} is {}, not between {} and {}")
              .with(name, value, low, high));
  };
  const auto checkPlace = [&](const SeenPlace& place) {
    check("a changed place", place.x, 0.0, 1.0);
    check("a changed place", place.y, 0.0, 1.0);
  };
  for (const auto* devices : {&changes.cameras, &changes.projectors})
    for (const Turned& turned : *devices) {
      check("a device's shift", turned.x, -1000.0, 1000.0);
      check("a device's shift", turned.y, -1000.0, 1000.0);
      check("a device's rotation", turned.degrees, -90.0, 90.0);
    }
  for (double share : changes.lamps) check("the light that is left of a lamp", share, 0.0, 1.0);
  for (double share : changes.filter) check("the light that a filter lets pass", share, 0.0, 1.0);
  check("the light that dust takes", changes.dust, 0.0, 1.0);
  if (changes.ambient) check("the ambient light", *changes.ambient, 0.0, 1e3);
  for (const Painted& painted : changes.painted) {
    checkPlace(painted.place);
    check("the radius of paint", painted.radius, 0.0, 10.0);
    for (double share : painted.colour) check("the colour of paint", share, 0.0, 1.0);
  }
  for (const Moved& moved : changes.moved) {
    checkPlace(moved.place);
    check("the distance of what was moved", moved.distance, -10.0, 10.0);
  }
  for (const Added& added : changes.added) {
    checkPlace(added.place);
    check("the diameter of what was added", added.diameter, 0.001, 10.0);
  }
  return found;
}

void apply(const Changes& changes, Scene& scene) {
  {
    // Found before anything moves; the surfaces stay where they are in memory until then.
    const SceneRays rays(scene);
    const auto find = [&](const SeenPlace& place) { return seenAt(place, scene, rays); };
    std::vector<std::pair<std::size_t, Vector3f>> moves;
    std::vector<Surface> added;
    std::vector<std::pair<Vector3f, Painted>> paints;
    for (const Moved& moved : changes.moved)
      if (const auto seen = find(moved.place))
        moves.emplace_back(seen->surface,
                           static_cast<float>(moved.distance) * scene.cameras.front().pose.right);
    for (const Added& ball : changes.added)
      if (const auto seen = find(ball.place)) {
        const auto radius = static_cast<float>(0.5 * ball.diameter);
        added.push_back({ellipsoid(seen->position + radius * seen->normal, {radius, radius, radius}, 96),
                         {cardboard({0.58f, 0.44f, 0.30f})}});
      }
    for (const Painted& painted : changes.painted)
      if (const auto seen = find(painted.place)) paints.emplace_back(seen->position, painted);
    for (const auto& [surface, by] : moves) move(scene.surfaces[surface], by);
    for (Surface& surface : added) scene.surfaces.push_back(std::move(surface));
    for (const auto& [centre, painted] : paints) paint(scene, centre, painted);
  }
  for (const Turned& turned : changes.cameras) {
    require(turned.device < scene.cameras.size(), "camera {} of {}", turned.device, scene.cameras.size());
    turn(scene.cameras[turned.device], turned, 1.0f);
  }
  for (const Turned& turned : changes.projectors) {
    require(turned.device < scene.projectors.size(), "projector {} of {}", turned.device,
            scene.projectors.size());
    turn(scene.projectors[turned.device], turned, -1.0f);
  }
  for (ProjectorOptics& projector : scene.projectors) {
    if (changes.lamps != everything) projector.transmission *= spectrumOf(changes.lamps);
    projector.dust = static_cast<float>(changes.dust);
  }
  for (CameraOptics& camera : scene.cameras)
    if (changes.filter != everything) camera.transmission *= spectrumOf(changes.filter);
}

}  // namespace relucent::venue
