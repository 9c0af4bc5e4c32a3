// SPDX-License-Identifier: MIT
#include "relucent/pipeline/watched_calibration.h"

#include <algorithm>

#include "relucent/base/error.h"

namespace relucent::pipeline {

monitoring::WatchedVenue watchedVenueOf(const MeasuredCalibration& measured, std::size_t camera,
                                        const monitoring::SamplingSettings& settings) {
  const compensation::MeasuredVenue& venue = measured.venue;
  const Rasters& cameras = venue.transport.cameras();
  require(camera < cameras.devices(), "camera {} of {}", camera, cameras.devices());
  const std::size_t offset = cameras.offset(camera);
  const Size size = cameras.size(camera);
  std::vector<std::uint8_t> usable(size.count());
  for (std::size_t i = 0; i < usable.size(); ++i) usable[i] = venue.usable[offset + i];
  monitoring::Sampling sampling = monitoring::sampledPixels(size, usable, settings);

  std::vector<std::uint32_t> rows;
  std::vector<float> black, flood;
  for (std::uint32_t pixel : sampling.pixels) {
    const std::size_t row = offset + pixel;
    rows.push_back(static_cast<std::uint32_t>(row));
    for (std::size_t c = 0; c < 3; ++c) {
      black.push_back(venue.black[3 * row + c]);
      flood.push_back(venue.flood[3 * row + c]);
    }
  }
  monitoring::SampledTransport transport(venue.transport, rows);
  monitoring::WatchedVenue watched{std::move(sampling),
                                   std::move(transport),
                                   std::move(black),
                                   std::move(flood),
                                   measured.linearization.cameras[camera]};
  watched.wrong = std::max(watched.wrong, measured.acquisition.verificationError);
  return watched;
}

CodeLights lightOfCodes(const linearization::Linearization& linearization) {
  CodeLights lights;
  for (const linearization::ProjectorResponse& projector : linearization.projectors) {
    auto& own = lights.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t code = 0; code < 256; ++code)
        own[c][code] = static_cast<float>(projector.channels[c](static_cast<double>(code) / 255.0));
  }
  return lights;
}

}  // namespace relucent::pipeline
