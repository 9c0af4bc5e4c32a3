// SPDX-License-Identifier: MIT
#include "relucent/venue/tracer.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/venue/caustics.h"
#include "relucent/venue/pi.h"
#include "relucent/venue/scene_rays.h"

namespace relucent::venue {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float cameraBlur = 0.4f;     // pixels, beside the pixel's own width
constexpr int longestGlassChain = 16;  // boundaries that one path may cross
/// Bounced light varies slowly over the picture; so may its sampling error, which hardly moves from pixel to
/// pixel.
constexpr float bouncedShift = 0.15f;
constexpr int coarsestAcross = 8;  // indirect light is resolved into at least so many nodes

Rasters projectorRasters(const Scene& scene) {
  std::vector<Size> sizes;
  for (const ProjectorOptics& projector : scene.projectors) sizes.push_back(projector.raster);
  return Rasters(std::move(sizes));
}

Rasters cameraRasters(const Scene& scene) {
  std::vector<Size> sizes;
  for (const CameraOptics& camera : scene.cameras) sizes.push_back(camera.raster);
  return Rasters(std::move(sizes));
}

/// Photons are gathered within less than a pixel of any camera.
float causticRadius(const Scene& scene) {
  float widest = 0.0f, finest = 0.0f;
  for (const ProjectorOptics& projector : scene.projectors) widest = std::max(widest, projector.focus);
  for (const CameraOptics& camera : scene.cameras)
    finest = std::max(finest, camera.throwRatio * static_cast<float>(camera.raster.width));
  return 0.8f * widest / finest;
}

}  // namespace

/// A path under way: where it is, what the camera sees of light that arrives there.
struct Tracer::Path {
  int sample = 0;
  int pair = 0;  // next pair of dimensions
  Vector2f shift;
  Ray ray;
  Spectrum throughput;
  int bounces = 0;
  float spread = 0.0f;    // solid angle between this path and its neighbours at the last bounce
  float sinceBounce = 0;  // m
  SurfacePoint point;
  ScatteringPoint scattering;
};

Tracer::Tracer(const Scene& scene, const TracerSettings& settings)
    : scene_(scene),
      settings_(settings),
      layout_(projectorRasters(scene)),
      cameras_(cameraRasters(scene)),
      samples_(settings.pathsPerPixel, settings.seed),
      rays_(std::make_unique<SceneRays>(scene)),
      caustics_(std::make_unique<Caustics>(scene, *rays_, settings.photonsPerPixel, causticRadius(scene))) {}

Tracer::~Tracer() = default;

Spectrum Tracer::trace(std::size_t cameraPixel, TransportRow& row) const {
  std::size_t device = 0;
  while (cameraPixel >= cameras_.offset(device) + cameras_.size(device).count()) ++device;
  const CameraOptics& camera = scene_.cameras[device];
  Pixel pixel = pixelAt(camera.raster, cameraPixel - cameras_.offset(device));
  Random random({settings_.seed, cameraPixel});
  float spacing = 1.0f / std::sqrt(static_cast<float>(samples_.count()));
  Vector2f shift(spacing * random.uniformFloat(), spacing * random.uniformFloat());

  Spectrum seen = Spectrum::Zero();
  float weight = 1.0f / static_cast<float>(samples_.count());
  for (int sample = 0; sample < samples_.count(); ++sample) {
    Path path;
    path.sample = sample;
    path.shift = shift;
    Vector2f within = samples_.point(sample, path.pair++, shift);
    Vector2f blur = cameraBlur * (samples_.point(sample, path.pair++, shift) - Vector2f(0.5f, 0.5f));
    path.ray = camera.ray(Vector2f(static_cast<float>(pixel.x), static_cast<float>(pixel.y)) + within + blur);
    path.throughput = weight * pi * camera.transmission;
    path.scattering.diffuse.setZero();
    followPath(path, row);
    seen += weight * path.scattering.diffuse * camera.transmission;
  }
  return seen;
}

void Tracer::followPath(Path& path, TransportRow& row) const {
  Spectrum first = Spectrum::Zero();
  for (int boundaries = 0; boundaries <= longestGlassChain;) {
    std::optional<SurfacePoint> point = rays_->nearest(path.ray);
    if (!point) break;
    path.point = *point;
    path.sinceBounce += point->distance;
    if (point->material->isGlass()) {
      float choice = samples_.point(path.sample, path.pair++, path.shift).x();
      path.ray = SceneRays::leaving(
          *point, throughGlass(path.ray.direction, point->normal, point->material->refractiveIndex, choice));
      ++boundaries;
      continue;
    }
    path.scattering = point->scatteringTowards(-path.ray.direction);
    if (path.bounces == 0) first = path.scattering.diffuse;
    connect(path, row);
    ++path.pair;
    if (path.bounces == 0 && !caustics_->empty()) gatherCaustics(path, row);
    if (path.bounces == settings_.longestPath || !bounce(path)) break;
  }
  path.scattering.diffuse = first;
}

void Tracer::connect(const Path& path, TransportRow& row) const {
  Vector2f lens = samples_.point(path.sample, path.pair, path.shift);
  for (std::size_t i = 0; i < scene_.projectors.size(); ++i) {
    std::optional<LensConnection> connection = scene_.projectors[i].connect(path.point.position, lens);
    if (!connection) continue;
    float cosine = path.scattering.cosine(connection->direction);
    if (cosine <= 0.0f || !rays_->free(path.point, connection->direction, connection->distance)) continue;

    float arrival = std::abs(path.scattering.geometricNormal.dot(path.scattering.outgoing));
    float area = path.sinceBounce * path.sinceBounce * path.spread / std::max(arrival, 0.1f);
    addTransport(path, static_cast<int>(i), connection->place, area * cosine / connection->pixelArea,
                 path.throughput * path.scattering.brdf(connection->direction) *
                     scene_.projectors[i].transmission * (cosine * connection->irradiance),
                 row);
  }
}

void Tracer::gatherCaustics(const Path& path, TransportRow& row) const {
  const ScatteringPoint& scattering = path.scattering;
  caustics_->gather(path.point.position, scattering.geometricNormal,
                    [&](const Caustics::Photon& photon, float irradiance) {
                      row.add({photon.projector, 0, photon.x, photon.y},
                              path.throughput * scattering.brdf(-photon.direction) *
                                  scene_.projectors[photon.projector].transmission * irradiance);
                    });
}

bool Tracer::bounce(Path& path) const {
  if (path.bounces == 0) path.shift *= bouncedShift;
  Vector2f direction = samples_.point(path.sample, path.pair++, path.shift);
  Vector2f choices = samples_.point(path.sample, path.pair++, path.shift);
  Bounce bounce = sampleBounce(path.scattering, direction, choices.x());
  path.throughput *= bounce.weight;

  // Paths that carry little end early, the others carry their share on; means stay as they are. Not at the
  // first bounce, which decides how smooth a picture is.
  float carried = path.throughput.maxCoeff() * static_cast<float>(samples_.count()) / pi;
  float survival = path.bounces == 0 && carried > 0.0f ? 1.0f : std::min(1.0f, 1.5f * carried);
  if (choices.y() >= survival) return false;
  path.throughput /= survival;

  path.spread = 1.0f / (static_cast<float>(samples_.count()) * survival * bounce.density);
  path.sinceBounce = 0.0f;
  path.ray = SceneRays::leaving(path.point, bounce.direction);
  ++path.bounces;
  return true;
}

int Tracer::coarsestLevel(int projector) const {
  int level = 0;
  while (layout_.gridSize(static_cast<std::size_t>(projector), level).width > coarsestAcross) ++level;
  return level;
}

void Tracer::addTransport(const Path& path, int projector, const Vector2f& place, float pixelsPerPath,
                          const Spectrum& transport, TransportRow& row) const {
  if (path.bounces == 0) {
    row.add({projector, 0, static_cast<int>(place.x()), static_cast<int>(place.y())}, transport);
    return;
  }
  int coarsest = coarsestLevel(projector);
  int level = static_cast<int>(std::ceil(0.5f * std::log2(std::max(1.0f, pixelsPerPath))));
  level = std::clamp(level, std::min(settings_.finestIndirectLevel, coarsest), coarsest);

  Size grid = layout_.gridSize(static_cast<std::size_t>(projector), level);
  float side = static_cast<float>(1 << level);
  float x = place.x() / side - 0.5f, y = place.y() / side - 0.5f;
  int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  float tx = x - static_cast<float>(x0), ty = y - static_cast<float>(y0);
  for (int dy = 0; dy <= 1; ++dy) {
    for (int dx = 0; dx <= 1; ++dx) {
      float weight = (dx ? tx : 1.0f - tx) * (dy ? ty : 1.0f - ty);
      if (weight <= 0.0f) continue;
      // What would land beside the picture lands on its border: energy stays.
      transport::Node node{projector, level, std::clamp(x0 + dx, 0, grid.width - 1),
                           std::clamp(y0 + dy, 0, grid.height - 1)};
      row.add(node, weight * transport);
    }
  }
}

}  // namespace relucent::venue
