// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "relucent/base/random.h"
#include "relucent/monitoring/light_fit.h"
#include "relucent/monitoring/view_shift.h"

namespace relucent::monitoring {

inline constexpr Size syntheticSize{40, 30};  // of the camera and of each projector

/// Two projectors, one bright on the left and one on the right half, both somewhat on the other; camera pixel
/// by projector pixel, a wider leaf of near surroundings and one of the whole raster. `other`: of the
/// brighter one's light.
inline transport::TransportMatrix syntheticTransport(float other = 0.3f) {
  const Rasters camera(syntheticSize), projectors(std::vector<Size>{syntheticSize, syntheticSize});
  const transport::NodeLayout layout(projectors);
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 60.0f));
  for (std::size_t i = 0; i < camera.count(); ++i) {
    const Pixel at = pixelAt(syntheticSize, i);
    // A surface with a pattern of its own.
    const float paint =
        0.6f + 0.3f * std::sin(0.9f * static_cast<float>(at.x)) * std::sin(0.7f * static_cast<float>(at.y));
    for (std::size_t j = 0; j < 2; ++j) {
      const bool isNear = (at.x < syntheticSize.width / 2) == (j == 0);
      transport::ColourBlock block = transport::ColourBlock::Constant(0.5f);
      block.diagonal() = Eigen::Vector3f(9.0f, 10.0f, 8.0f);
      block *= paint * (isNear ? 1.0f : other);
      builder.add(i, projectors.offset(j) + i, block);
      for (int level : {3, layout.levels(j) - 1})
        builder.add(i, layout.index(layout.nodeOver(projectors.offset(j) + i, level)), 0.1f * block);
    }
  }
  return transport::TransportMatrix(camera, projectors, builder.build());
}

inline WatchedVenue syntheticVenue(const transport::TransportMatrix& transport) {
  WatchedVenue venue;
  venue.sampling = sampledPixels(syntheticSize, std::vector<std::uint8_t>(syntheticSize.count(), 1));
  venue.transport = SampledTransport(transport, venue.sampling.pixels);
  const CameraStack flood = transport.floodlight();
  venue.flood.assign(flood.begin(), flood.end());
  for (float value : venue.flood) venue.black.push_back(0.01f * value + 0.05f);
  venue.camera.readNoise = 1e-4;
  venue.camera.gain = 1e-5;
  return venue;
}

/// Blobs that move with `time`, 1 a frame; never quite dark.
inline ProjectorStack syntheticPicture(double time, std::uint64_t seed = 1) {
  ProjectorStack picture(3 * 2 * syntheticSize.count(), 0.1f);
  for (std::size_t j = 0; j < 2; ++j)
    for (std::uint64_t blob = 0; blob < 12; ++blob) {
      Random random({seed, j, blob});
      const double x =
          random.uniform() * syntheticSize.width + 0.8 * std::sin(0.37 * time + 6.0 * random.uniform());
      const double y =
          random.uniform() * syntheticSize.height + 1.5 * std::sin(0.23 * time + 6.0 * random.uniform());
      const double radius = 2.0 + 3.0 * random.uniform();
      const std::array<double, 3> colour{random.uniform(), random.uniform(), random.uniform()};
      for (std::size_t i = 0; i < syntheticSize.count(); ++i) {
        const Pixel at = pixelAt(syntheticSize, i);
        const double d2 = (at.x - x) * (at.x - x) + (at.y - y) * (at.y - y);
        for (std::size_t c = 0; c < 3; ++c) {
          float& value = picture[3 * (j * syntheticSize.count() + i) + c];
          value = std::min(1.0f, value + static_cast<float>(colour[c] * std::exp(-d2 / (radius * radius))));
        }
      }
    }
  return picture;
}

/// What is photographed: radiance at all samples, with little noise.
inline Observed observed(const std::vector<float>& radiance, std::uint64_t seed = 1, double relative = 1e-3) {
  Observed seen;
  Random random({seed, 77});
  for (float value : radiance) {
    const double deviation = relative * value + 1e-4;
    seen.radiance.push_back(value + static_cast<float>(deviation * random.normal()));
    seen.variance.push_back(static_cast<float>(deviation * deviation));
    seen.valid.push_back(1);
  }
  return seen;
}

/// T p + e with the gains of projectors and channels, three each.
inline std::vector<float> radianceOf(const transport::TransportMatrix& transport, const WatchedVenue& venue,
                                     ProjectorStack picture, const std::vector<double>& gains = {}) {
  if (!gains.empty())
    for (std::size_t i = 0; i < picture.size(); ++i)
      picture[i] *= static_cast<float>(gains[3 * (i / (3 * syntheticSize.count())) + i % 3]);
  const CameraStack light = transport.apply(picture);
  std::vector<float> radiance;
  for (std::size_t i = 0; i < light.size(); ++i) radiance.push_back(light[i] + venue.black[i]);
  return radiance;
}

}  // namespace relucent::monitoring
