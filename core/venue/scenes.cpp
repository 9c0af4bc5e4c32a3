// SPDX-License-Identifier: MIT
#include "relucent/venue/scenes.h"

#include <cmath>

#include "relucent/base/error.h"
#include "relucent/venue/pi.h"

namespace relucent::venue {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

Surface wall(float z, Texture texture) {
  return {rectangle({-2.5f, -1.5f, z}, {5.0f, 0.0f, 0.0f}, {0.0f, 3.0f, 0.0f}), {std::move(texture)}};
}

Surface floorAt(float y, Texture texture) {
  return {rectangle({-2.5f, y, 3.5f}, {5.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -5.0f}), {std::move(texture)}};
}

Scene plainScene(const VenueSettings& settings) {
  Scene scene;
  scene.surfaces.push_back(wall(0.0f, harlequin(0.34f)));
  placeDevices(scene, settings, {0.0f, 0.0f, 0.0f}, 3.0f);
  return scene;
}

Scene cornerScene(const VenueSettings& settings) {
  Scene scene;
  scene.surfaces.push_back(wall(-0.45f, wallpaper({0.64f, 0.58f, 0.44f}, {0.56f, 0.26f, 0.26f}, 0.26f)));
  scene.surfaces.push_back(floorAt(-0.50f, wood()));

  // Two cardboard wings that open towards the devices at 95 degrees.
  Vector3f crease(0.0f, -0.50f, -0.38f), up(0.0f, 0.92f, 0.0f);
  float half = 47.5f / 180.0f * pi;
  Vector3f left(-0.74f * std::sin(half), 0.0f, 0.74f * std::cos(half));
  Vector3f right(0.74f * std::sin(half), 0.0f, 0.74f * std::cos(half));
  Material glossy{cardboard({0.76f, 0.30f, 0.10f}), 0.06f, 40.0f};
  Material matt{cardboard({0.18f, 0.42f, 0.66f})};
  scene.surfaces.push_back({rectangle(crease + left, -left, up), glossy});
  scene.surfaces.push_back({rectangle(crease, right, up), matt});
  placeDevices(scene, settings, {0.0f, -0.05f, -0.15f}, 8.0f);
  return scene;
}

Scene depthScene(const VenueSettings& settings) {
  Scene scene;
  scene.surfaces.push_back(wall(-0.95f, wallpaper({0.52f, 0.60f, 0.62f}, {0.66f, 0.48f, 0.24f}, 0.30f)));
  scene.surfaces.push_back(floorAt(-0.55f, wood()));
  scene.surfaces.push_back({box({-0.62f, -0.55f, -0.55f}, {0.34f, 0.95f, 0.30f}, 0.4f), {bricks()}});
  scene.surfaces.push_back({box({-0.22f, -0.55f, -0.10f}, {0.32f, 0.62f, 0.26f}, -0.3f), {harlequin(0.16f)}});
  scene.surfaces.push_back(
      {box({0.12f, -0.55f, 0.38f}, {0.24f, 0.36f, 0.24f}, 0.5f), {cardboard({0.70f, 0.56f, 0.38f})}});
  scene.surfaces.push_back(
      {box({0.50f, -0.55f, -0.20f}, {0.26f, 0.86f, 0.26f}, 0.2f), {stone({0.74f, 0.72f, 0.66f})}});
  scene.surfaces.push_back(
      {ellipsoid({0.36f, -0.40f, 0.30f}, {0.15f, 0.15f, 0.15f}, 96), {cardboard({0.62f, 0.30f, 0.28f})}});
  scene.surfaces.push_back(
      {ellipsoid({-0.42f, -0.41f, 0.34f}, {0.14f, 0.14f, 0.14f}, 96), {cardboard({0.34f, 0.52f, 0.36f})}});
  placeDevices(scene, settings, {0.0f, -0.05f, -0.10f}, 20.0f);
  return scene;
}

Scene domeScene(const VenueSettings& settings) {
  Scene scene;
  // The middle of a dome of 2.6 m, seen from about its centre; the floor is carpet.
  constexpr float radius = 2.6f;
  scene.surfaces.push_back({ellipsoid({0.0f, 0.0f, 0.0f}, {radius, radius, radius}, 160), {domePaint()}});
  scene.surfaces.push_back({rectangle({-3.0f, -0.9f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}),
                            {cardboard({0.26f, 0.24f, 0.24f})}});
  placeDevices(scene, settings, {0.0f, 0.55f, -2.4f}, 6.0f);
  ProjectorOptics& projector = scene.projectors.front();
  projector.throwRatio = 0.60f;
  projector.pose = Pose::lookingAt({0.25f, -0.35f, 0.3f}, {0.0f, 0.5f, -2.5f});
  projector.focus = 2.75f;
  projector.aperture = 6.0f * projector.pixelPitch();
  CameraOptics& camera = scene.cameras.front();
  camera.throwRatio = 0.60f;
  camera.pose = Pose::lookingAt({-0.30f, -0.25f, 0.35f}, {0.0f, 0.5f, -2.5f});
  return scene;
}

/// Four projectors share the dome, a quarter each and a little more; two cameras see all of it. A viewer
/// stands between them.
Scene dome4Scene(const VenueSettings& settings) {
  Scene scene = domeScene(settings);
  const ProjectorOptics one = scene.projectors.front();
  scene.projectors.clear();
  for (float up : {1.15f, -0.15f})
    for (float side : {-1.0f, 1.0f}) {
      const Vector3f target(0.85f * side, up, -2.2f);
      ProjectorOptics& projector = scene.projectors.emplace_back(one);
      projector.throwRatio = 1.0f;
      projector.pose = Pose::lookingAt({0.35f * side, -0.35f, 0.3f}, target);
      projector.focus = (target - projector.pose.position).norm();
      projector.aperture = 6.0f * projector.pixelPitch();
    }
  const CameraOptics camera = scene.cameras.front();
  scene.cameras.clear();
  for (float side : {-1.0f, 1.0f})
    scene.cameras.emplace_back(camera).pose =
        Pose::lookingAt({0.55f * side, -0.25f, 0.35f}, {0.0f, 0.5f, -2.5f});
  scene.hidden.emplace_back(camera).pose = Pose::lookingAt({0.0f, -0.25f, 0.35f}, {0.0f, 0.5f, -2.5f});
  return scene;
}

/// Round a statue: two projectors, and three cameras where viewers stand; others stand between them.
Scene statue3Scene(const VenueSettings& settings) {
  Scene scene = statueScene(settings);
  const Vector3f target(0.0f, -0.10f, -0.10f);
  const auto around = [&](float degrees, float height, float distance) -> Vector3f {
    const float angle = degrees / 180.0f * pi;
    return {target.x() + distance * std::sin(angle), height, target.z() + distance * std::cos(angle)};
  };
  const ProjectorOptics one = scene.projectors.front();
  scene.projectors.clear();
  for (float degrees : {-35.0f, 35.0f}) {
    ProjectorOptics& projector = scene.projectors.emplace_back(one);
    projector.pose = Pose::lookingAt(around(degrees, 0.25f, 2.4f), target);
    projector.focus = (target - projector.pose.position).norm();
    projector.aperture = 8.0f * projector.pixelPitch();
  }
  const CameraOptics camera = scene.cameras.front();
  scene.cameras.clear();
  for (float degrees : {0.0f, -45.0f, 45.0f})
    scene.cameras.emplace_back(camera).pose = Pose::lookingAt(around(degrees, 0.10f, 2.5f), target);
  for (float degrees : {-22.5f, 22.5f})
    scene.hidden.emplace_back(camera).pose = Pose::lookingAt(around(degrees, 0.10f, 2.5f), target);
  return scene;
}

struct Offer {
  VenueDescription description;
  Scene (*build)(const VenueSettings&);
};

const std::vector<Offer>& offers() {
  static const std::vector<Offer> all = {
      {{"corner", "two cardboard wings, one glossy, meet in a corner before wallpaper: they light each other",
        1},
       cornerScene},
      {{"depth", "boxes and balls at many distances before wallpaper: the projector is out of focus on most",
        1},
       depthScene},
      {{"statue", "a stone bust before a brick wall: curved, weathered, with shadows", 1}, statueScene},
      {{"glass", "a filled wine glass before wallpaper: light is refracted both ways", 1}, glassScene},
      {{"dome", "the inside of a painted dome: everything lights everything", 1}, domeScene},
      {{"relief", "carved stone, lit from both sides: each projector shines into the other's shadows", 2},
       reliefScene},
      {{"plain", "a flat wall, painted in diamonds", 1}, plainScene},
      {{"dome4", "the painted dome, shared by four projectors that overlap, seen from two places", 4, 2},
       dome4Scene},
      {{"statue3",
        "the bust between two projectors that shine into each other's shadows, seen from three sides", 2, 3},
       statue3Scene},
  };
  return all;
}

}  // namespace

const std::vector<VenueDescription>& venues() {
  static const std::vector<VenueDescription> descriptions = [] {
    std::vector<VenueDescription> all;
    for (const Offer& offer : offers()) all.push_back(offer.description);
    return all;
  }();
  return descriptions;
}

void placeDevices(Scene& scene, const VenueSettings& settings, const Vector3f& target, float defocus) {
  ProjectorOptics projector;
  projector.raster = settings.projector;
  projector.pose = Pose::lookingAt({0.35f, 0.20f, 2.4f}, target);
  projector.throwRatio = 1.5f;
  projector.focus = (target - projector.pose.position).norm();
  // The blur at depth d has aperture * |d - focus| / focus metres, a pixel there pixelPitch() * d / focus:
  // their quotient tends to aperture / pixelPitch(). So the picture is the same at every resolution.
  projector.aperture = defocus * projector.pixelPitch();
  projector.vignetting = static_cast<float>(settings.devices.vignetting);
  scene.projectors.push_back(projector);

  CameraOptics camera;
  camera.raster = settings.camera;
  camera.pose = Pose::lookingAt({-0.40f, 0.12f, 2.5f}, target);
  camera.throwRatio = 1.68f;
  scene.cameras.push_back(camera);
}

Scene buildScene(const VenueSettings& settings) {
  for (const Offer& offer : offers())
    if (offer.description.name == settings.name) return offer.build(settings);
  require(false, "no venue is called {}", settings.name);
  return {};
}

}  // namespace relucent::venue
