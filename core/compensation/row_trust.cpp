// SPDX-License-Identifier: MIT
#include "relucent/compensation/row_trust.h"

#include <algorithm>
#include <random>

#include "relucent/base/parallel.h"

namespace relucent::compensation {
namespace {

// Chosen on seven venues, see the README.
constexpr double ofVariance = 0.1;
constexpr double unit = 0.01;  // of white
// Of a coarse measurement all rows are doubtful: none of them decides what the others show.
constexpr double leastTrust = 0.35;
constexpr int squaresAcross = 16;

/// Linear light, more dark than bright ones, as in pictures. The same on every computer.
ProjectorStack mosaic(const Rasters& projectors) {
  ProjectorStack light(3 * projectors.count());
  std::mt19937 random(1);
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    const Size size = projectors.size(device);
    const int side = std::max(1, size.width / squaresAcross);
    const Size squares{(size.width + side - 1) / side, (size.height + side - 1) / side};
    std::vector<float> colours(3 * squares.count());
    for (float& colour : colours) {
      const double code = static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
      colour = static_cast<float>(code * code);
    }
    float* to = &light[3 * projectors.offset(device)];
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x, to += 3)
        std::copy_n(&colours[3 * indexOf(squares, {x / side, y / side})], 3, to);
  }
  return light;
}

/// What 85 % of the usable pixels can show in every channel; 0 if none is usable.
double whiteOf(const MeasuredVenue& venue) {
  std::vector<float> most;
  for (std::size_t i = 0; i < venue.usable.size(); ++i) {
    if (venue.usable[i] == 0) continue;
    const auto of = [&](std::size_t channel) {
      return venue.black[3 * i + channel] + venue.flood[3 * i + channel];
    };
    most.push_back(std::min({of(0), of(1), of(2)}));
  }
  if (most.empty()) return 0.0;
  const auto darkest15 = most.begin() + static_cast<std::ptrdiff_t>(most.size() * 15 / 100);
  std::nth_element(most.begin(), darkest15, most.end());
  return static_cast<double>(*darkest15);
}

}  // namespace

std::vector<float> trustIn(const MeasuredVenue& venue, const TransportVariance& variance) {
  const double white = whiteOf(venue);
  if (variance.leaf.empty() || !(white > 0.0)) return {};
  const CameraStack deviation =
      expectedDeviation(venue.transport, variance, mosaic(venue.transport.projectors()));
  std::vector<float> trust(deviation.size() / 3);
  parallelFor(0, trust.size(), 4096, [&](std::size_t i) {
    double square = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double sigma = static_cast<double>(deviation[3 * i + channel]) / (unit * white);
      square += sigma * sigma / 3.0;
    }
    trust[i] = static_cast<float>(std::max(leastTrust, 1.0 / (1.0 + ofVariance * square)));
  });
  return trust;
}

}  // namespace relucent::compensation
