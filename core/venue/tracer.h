// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "relucent/transport/node_layout.h"
#include "relucent/venue/sample_pattern.h"
#include "relucent/venue/scene.h"
#include "relucent/venue/transport_row.h"

namespace relucent::venue {

class Caustics;
class SceneRays;

struct TracerSettings {
  int pathsPerPixel = 256;
  int longestPath = 16;         // diffuse bounces
  int finestIndirectLevel = 3;  // of the pyramid, for light that arrives by diffuse bounces
  int photonsPerPixel = 16;     // per projector pixel that meets glass
  std::uint64_t seed = 1;
};

/// Follows light paths from the cameras into a scene. At every vertex the path is connected to a point on
/// every projector's lens; the transport is added to the projector pixel that this path comes from:
///   T[camera pixel, node] += throughput * brdf * cosine * irradiance
/// Paths without a diffuse bounce, those through glass included, land on single projector pixels. Light
/// that has bounced arrives from a wide area of the picture: it is spread over nodes about as large as the
/// distance to the neighbouring paths, with bilinear weights, and rows stay compact and smooth.
/// Every pixel uses the same well-spread set of paths, shifted by less than their spacing, so that the
/// remaining sampling error is smooth too.
/// Units: a white diffuse surface under irradiance 1 has transport 1 in all bands.
/// Source: core/venue/README.md; Veach 1997, chapters 8 to 10.
class Tracer {
 public:
  Tracer(const Scene& scene, const TracerSettings& settings);
  ~Tracer();

  const transport::NodeLayout& layout() const { return layout_; }
  /// The pixels of all cameras, numbered consecutively.
  const Rasters& cameras() const { return cameras_; }
  /// Adds the transport of one camera pixel to `row`; returns the mean reflectance that it sees.
  Spectrum trace(std::size_t cameraPixel, TransportRow& row) const;

 private:
  struct Path;
  void followPath(Path& path, TransportRow& row) const;
  void connect(const Path& path, TransportRow& row) const;
  void gatherCaustics(const Path& path, TransportRow& row) const;
  bool bounce(Path& path) const;
  void addTransport(const Path& path, int projector, const Eigen::Vector2f& place, float pixelsPerPath,
                    const Spectrum& transport, TransportRow& row) const;
  int coarsestLevel(int projector) const;

  const Scene& scene_;
  TracerSettings settings_;
  transport::NodeLayout layout_;
  Rasters cameras_;
  SamplePattern samples_;
  std::unique_ptr<const SceneRays> rays_;
  std::unique_ptr<const Caustics> caustics_;
};

}  // namespace relucent::venue
