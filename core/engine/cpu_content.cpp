// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include "relucent/base/parallel.h"
#include "relucent/engine/cpu_backend.h"

namespace relucent::engine {
namespace {

constexpr std::size_t pixelsOfATask = 1024;

/// A weighted sum of colours, passed by value: it stays in registers.
struct Colour {
  float red = 0.0f, green = 0.0f, blue = 0.0f;
};

template <int bytes, int red, int blue>
struct EncodedPixels {
  const float* linear;  // of each code
  Colour plus(Colour sum, const unsigned char* line, std::size_t count, const std::uint16_t* weight) const {
    for (std::size_t i = 0; i < count; ++i, line += bytes) {
      const auto w = static_cast<float>(weight[i]);
      sum.red += w * linear[line[red]];
      sum.green += w * linear[line[1]];
      sum.blue += w * linear[line[blue]];
    }
    return sum;
  }
};

struct LinearPixels {
  static float light(float value) { return value > 0.0f ? std::min(value, 1.0f) : 0.0f; }
  Colour plus(Colour sum, const unsigned char* line, std::size_t count, const std::uint16_t* weight) const {
    const auto* pixel = reinterpret_cast<const float*>(line);
    for (std::size_t i = 0; i < count; ++i, pixel += 3) {
      const auto w = static_cast<float>(weight[i]);
      sum.red += w * light(pixel[0]);
      sum.green += w * light(pixel[1]);
      sum.blue += w * light(pixel[2]);
    }
    return sum;
  }
};

/// The content's mean over one camera pixel.
template <typename Pixels>
Colour meanOver(const ContentWarp::Footprint& footprint, const std::uint16_t* weight,
                const ContentFrame& frame, const Pixels& pixels) {
  const auto* line = static_cast<const unsigned char*>(frame.data) +
                     static_cast<std::size_t>(footprint.y) * frame.bytesPerLine +
                     static_cast<std::size_t>(footprint.x) * bytesPerPixel(frame.format);
  weight += footprint.weight;
  Colour sum;
  for (int y = 0; y < footprint.height; ++y, line += frame.bytesPerLine, weight += footprint.width)
    sum = pixels.plus(sum, line, footprint.width, weight);
  return {footprint.scale * sum.red, footprint.scale * sum.green, footprint.scale * sum.blue};
}

template <typename Visit>
void withPixels(ContentFrame::Format format, const float* linear, const Visit& visit) {
  switch (format) {
    case ContentFrame::Format::rgb8:
      return visit(EncodedPixels<3, 0, 2>{linear});
    case ContentFrame::Format::rgba8:
      return visit(EncodedPixels<4, 0, 2>{linear});
    case ContentFrame::Format::bgra8:
      return visit(EncodedPixels<4, 2, 0>{linear});
    case ContentFrame::Format::linearFloat:
      return visit(LinearPixels{});
  }
}

}  // namespace

void CpuBackend::placeContent(const ContentFrame& frame, const FrameRequest& request) noexcept {
  const ContentWarp& warp = content_->warp;
  const float white = content_->white * request.brightness, lift = request.blackLift;
  const transport::ColourBlock mixing = white * (1.0f - lift) * engine_.mixing;
  const std::size_t count = warp.footprints().size();
  reachable_ = unreachable_ = 0;
  withPixels(frame.format, linearOfSrgb_.data(), [&](const auto& pixels) {
    auto place = [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (warp.inside(i)) {
          const Colour c = meanOver(warp.footprints()[i], warp.weights().data(), frame, pixels);
          placed_[3 * i] = c.red;
          placed_[3 * i + 1] = c.green;
          placed_[3 * i + 2] = c.blue;
        }
      fitTarget(begin, end, mixing, white * lift);
    };
    parallelChunks(0, count, (count + pixelsOfATask - 1) / pixelsOfATask, place);
  });
}

void CpuBackend::fitTarget(std::size_t begin, std::size_t end, const transport::ColourBlock& mixing,
                           float offset) noexcept {
  const compensation::MeasuredVenue& venue = engine_.venue;
  const auto unreachable = static_cast<float>(engine_.settings.target.unreachableWeight);
  const bool isWeighted = content_->isWeighted;
  std::size_t usable = 0, reached = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!content_->warp.inside(i)) continue;
    const float *c = &placed_[3 * i], *black = &venue.black[3 * i], *flood = &venue.flood[3 * i];
    float wanted[3], held[3];
    // Without branches: content decides them, and no processor guesses content.
    unsigned reachable = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      const float* k = mixing.data() + 3 * d;
      const float value = offset + (k[0] * c[0] + k[1] * c[1] + k[2] * c[2]);
      reachable &=
          static_cast<unsigned>(value >= black[d]) & static_cast<unsigned>(value <= black[d] + flood[d]);
      wanted[d] = value - black[d];
      const float most = flood[d] > 0.0f ? flood[d] : 0.0f;
      const float positive = wanted[d] > 0.0f ? wanted[d] : 0.0f;
      held[d] = positive < most ? positive : most;
    }
    const float weight = content_->weight[i], share = reachable != 0 ? 1.0f : unreachable;
    usable += weight > 0.0f;
    reached += weight > 0.0f ? reachable : 0u;
    weight_[i] = weight * share;
    if (isWeighted) reach_[i] = weight > 0.0f ? share : 0.0f;

    const float* u = windows_.unmix + 9 * i;
    for (std::size_t d = 0; d < 3; ++d) {
      wanted_[3 * i + d] = wanted[d];
      held_[3 * i + d] = held[d];
      unmixed_[4 * i + d] = u[3 * d] * held[0] + u[3 * d + 1] * held[1] + u[3 * d + 2] * held[2];
    }
  }
  reachable_.fetch_add(reached, std::memory_order_relaxed);
  unreachable_.fetch_add(usable - reached, std::memory_order_relaxed);
}

}  // namespace relucent::engine
