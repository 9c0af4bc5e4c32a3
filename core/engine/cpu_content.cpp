// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include "base/parallel.h"
#include "engine/cpu_backend.h"

namespace relucent {
namespace {

/// Light of a channel of an encoded pixel.
template <int bytes, int red, int blue>
struct EncodedPixels {
  const float* linear;
  void add(const unsigned char* line, std::size_t count, const std::uint16_t* weight, float* sum) const {
    for (std::size_t i = 0; i < count; ++i, line += bytes) {
      auto w = static_cast<float>(weight[i]);
      sum[0] += w * linear[line[red]];
      sum[1] += w * linear[line[1]];
      sum[2] += w * linear[line[blue]];
    }
  }
};

struct LinearPixels {
  static float light(float value) { return value > 0.0f ? std::min(value, 1.0f) : 0.0f; }
  void add(const unsigned char* line, std::size_t count, const std::uint16_t* weight, float* sum) const {
    const auto* pixel = reinterpret_cast<const float*>(line);
    for (std::size_t i = 0; i < count; ++i, pixel += 3)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<float>(weight[i]) * light(pixel[c]);
  }
};

/// The content's mean over one camera pixel.
template <typename Pixels>
void meanOver(const ContentWarp::Footprint& footprint, const std::uint16_t* weight, const ContentFrame& frame,
              const Pixels& pixels, float* mean) {
  mean[0] = mean[1] = mean[2] = 0.0f;
  const auto* line = static_cast<const unsigned char*>(frame.data) +
                     static_cast<std::size_t>(footprint.y) * frame.bytesPerLine +
                     static_cast<std::size_t>(footprint.x) * bytesPerPixel(frame.format);
  weight += footprint.weight;
  for (int y = 0; y < footprint.height; ++y, line += frame.bytesPerLine, weight += footprint.width)
    pixels.add(line, footprint.width, weight, mean);
  for (std::size_t c = 0; c < 3; ++c) mean[c] *= footprint.scale;
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
  const MeasuredVenue& venue = engine_.venue;
  const ContentWarp& warp = content_->warp;
  const ColourBlock& k = engine_.mixing;
  const float white = content_->white * request.brightness, lift = request.blackLift;
  const auto unreachable = static_cast<float>(engine_.settings.target.unreachableWeight);
  withPixels(frame.format, linearOfSrgb_.data(), [&](const auto& pixels) {
    parallelFor(0, warp.footprints().size(), 1024, [&](std::size_t i) {
      if (!warp.inside(i)) return;
      float* c = &placed_[3 * i];
      meanOver(warp.footprints()[i], warp.weights().data(), frame, pixels, c);
      float* wanted = &wanted_[3 * i];
      float* held = &held_[3 * i];
      bool reachable = true;
      for (std::size_t d = 0; d < 3; ++d) {
        auto row = static_cast<Eigen::Index>(d);
        float value =
            white * (lift + (1.0f - lift) * (k(row, 0) * c[0] + k(row, 1) * c[1] + k(row, 2) * c[2]));
        const float black = venue.black[3 * i + d], flood = venue.flood[3 * i + d];
        reachable = reachable && value >= black && value <= black + flood;
        wanted[d] = value - black;
        held[d] = std::clamp(wanted[d], 0.0f, std::max(0.0f, flood));
      }
      weight_[i] = venue.usable[i] ? (reachable ? 1.0f : unreachable) : 0.0f;
      const float* u = windows_.unmix + 9 * i;
      float* unmixed = &unmixed_[4 * i];
      for (std::size_t d = 0; d < 3; ++d)
        unmixed[d] = u[3 * d] * held[0] + u[3 * d + 1] * held[1] + u[3 * d + 2] * held[2];
    });
  });
}

}  // namespace relucent
