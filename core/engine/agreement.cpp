// SPDX-License-Identifier: MIT
#include "relucent/engine/agreement.h"

#include <cstdlib>
#include <vector>

#include "relucent/engine/bench/noise_content.h"

namespace relucent::engine {
namespace {

constexpr double toleratedShare = 1e-3;
constexpr int toleratedCodes = 3;  // of 8 bits

/// Values of a projector's words that are apart.
std::size_t apart(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int bits) {
  const std::uint32_t last = (1u << bits) - 1u;
  const int tolerated = toleratedCodes << (bits - 8);
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int shift = 0; shift < 3 * bits; shift += bits)
      if (std::abs(static_cast<int>(a[i] >> shift & last) - static_cast<int>(b[i] >> shift & last)) >
          tolerated)
        ++count;
  return count;
}

}  // namespace

bool agree(EngineBackend& a, EngineBackend& b, const EngineVenue& engine, const EngineContent& content) {
  const NoiseContent noise(content.warp.content());
  FrameRequest request;
  request.steps = 1;
  std::vector<std::uint32_t> ofA(engine.brightest.size()), ofB(ofA.size());
  FrameReport report;
  if (!a.render(noise.frame(), request, ofA, report) || !b.render(noise.frame(), request, ofB, report))
    return false;
  const Rasters& projectors = engine.venue.transport.projectors();
  std::size_t count = 0;
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    const std::size_t first = projectors.offset(projector), pixels = projectors.size(projector).count();
    count += apart(std::span(ofA).subspan(first, pixels), std::span(ofB).subspan(first, pixels),
                   engine.encoders[projector].bits());
  }
  return static_cast<double>(count) <= toleratedShare * 3.0 * static_cast<double>(ofA.size());
}

}  // namespace relucent::engine
