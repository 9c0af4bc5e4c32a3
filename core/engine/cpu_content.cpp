// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include "relucent/base/parallel.h"
#include "relucent/engine/cpu_backend.h"

namespace relucent::engine {
namespace {

/// Lines of content as linear light, four floats a pixel.
template <int bytes, int red, int blue>
struct EncodedPixels {
  const float* linear;  // of each code
  void decode(const unsigned char* line, std::size_t count, float* to) const {
    for (std::size_t i = 0; i < count; ++i, line += bytes, to += 4) {
      to[0] = linear[line[red]];
      to[1] = linear[line[1]];
      to[2] = linear[line[blue]];
    }
  }
};

struct LinearPixels {
  static float light(float value) { return value > 0.0f ? std::min(value, 1.0f) : 0.0f; }
  void decode(const unsigned char* line, std::size_t count, float* to) const {
    const auto* pixel = reinterpret_cast<const float*>(line);
    for (std::size_t i = 0; i < count; ++i, pixel += 3, to += 4)
      for (std::size_t c = 0; c < 3; ++c) to[c] = light(pixel[c]);
  }
};

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

void CpuBackend::takeGains(const compensation::BrightnessField& field) noexcept {
  if (field == field_) return;
  field_ = field;
  parallelFor(0, content_->place.size(), 4096, [&](std::size_t i) {
    if (content_->warp.inside(i))
      known_[8 * i + 7] =
          field_.gain(content_->place[i][0], content_->place[i][1]) * content_->unmaskedShare(i);
  });
}

void CpuBackend::placeContent(const ContentFrame& frame, const FrameRequest& request) noexcept {
  takeGains(request.field != nullptr ? *request.field : compensation::BrightnessField());
  const float white = content_->white * request.brightness,
              lift = std::max(content_->blackLift, request.blackLift);
  const transport::ColourBlock mixing = white * (1.0f - lift) * engine_.mixing;
  ContentTarget target;
  std::copy_n(mixing.data(), target.mixing.size(), target.mixing.begin());
  target.offset = white * lift;
  target.unreachable = unreachableWeightOf(content_->target);
  if (content_->target.objective == compensation::Objective::seen && white > 0.0f)
    target.perWhite = 1.0f / white;
  target.sharedLoss = compensation::sharedLoss(content_->target.clipping);
  target.known = known_.data();
  target.unmix = windows_.unmix;
  target.wanted = wanted_.data();
  target.held = held_.data();
  target.unmixed = unmixed_.data();
  target.placed = request.compensated ? nullptr : placed_.data();
  withPixels(frame.format, linearOfSrgb_.data(), [&](const auto& pixels) {
    parallelFor(0, warp_.tiles.size(), 1, [&](std::size_t i) {
      const WarpTiles::Tile& tile = warp_.tiles[i];
      ScratchPool::BorrowedBuffer part(contentScratch_);
      const auto* line = static_cast<const unsigned char*>(frame.data) +
                         static_cast<std::size_t>(tile.y) * frame.bytesPerLine +
                         static_cast<std::size_t>(tile.x) * bytesPerPixel(frame.format);
      float* to = part.data();
      for (std::uint32_t y = 0; y < tile.height; ++y, line += frame.bytesPerLine, to += 4 * tile.width)
        pixels.decode(line, tile.width, to);
      kernels_.place(warp_, tile, part.data(), target);
    });
  });
}

}  // namespace relucent::engine
