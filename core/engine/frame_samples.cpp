// SPDX-License-Identifier: MIT
#include "relucent/engine/frame_samples.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"

namespace relucent::engine {
namespace {

constexpr std::size_t mostSamples = 4096;

}  // namespace

FrameSamples::FrameSamples(const EngineVenue& engine, const EngineContent& content)
    : size_(content.warp.content()), mixing_(engine.mixing) {
  for (std::size_t code = 0; code < linearOfSrgb_.size(); ++code)
    linearOfSrgb_[code] = static_cast<float>(image::srgbDecode(static_cast<double>(code) / 255.0));
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < content.warp.footprints().size(); ++i)
    if (content.warp.inside(i) && content.weight[i] > 0.0f) pixels.push_back(i);
  const std::size_t count = std::min(pixels.size(), mostSamples);
  for (std::size_t sample = 0; sample < count; ++sample) {
    pixel_.push_back(pixels[sample * pixels.size() / count]);
    const ContentWarp::Footprint& footprint = content.warp.footprints()[pixel_.back()];
    place_.push_back({footprint.x + footprint.width / 2, footprint.y + footprint.height / 2});
  }
  mixed_.resize(pixel_.size());
}

void FrameSamples::look(const ContentFrame& frame) {
  require(frame.size == size_, "content of {}x{} where {}x{} is prepared", frame.size.width,
          frame.size.height, size_.width, size_.height);
  std::array<float, classes> histogram{};
  const bool encoded = frame.format != ContentFrame::Format::linearFloat;
  const bool blueFirst = frame.format == ContentFrame::Format::bgra8;
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const auto* pixel = static_cast<const unsigned char*>(frame.data) +
                        static_cast<std::size_t>(place_[i].y) * frame.bytesPerLine +
                        static_cast<std::size_t>(place_[i].x) * bytesPerPixel(frame.format);
    std::array<float, 3> colour;
    for (std::size_t c = 0; c < 3; ++c)
      colour[c] = encoded ? linearOfSrgb_[pixel[blueFirst ? 2 - c : c]]
                          : std::min(1.0f, std::max(0.0f, reinterpret_cast<const float*>(pixel)[c]));
    for (std::size_t c = 0; c < 3; ++c) {
      auto row = static_cast<Eigen::Index>(c);
      mixed_[i][c] = mixing_(row, 0) * colour[0] + mixing_(row, 1) * colour[1] + mixing_(row, 2) * colour[2];
    }
    float light = std::min(1.0f, (colour[0] + colour[1] + colour[2]) / 3.0f);
    auto place = static_cast<std::size_t>(std::sqrt(light) * static_cast<float>(classes - 1) + 0.5f);
    histogram[place] += 1.0f / static_cast<float>(place_.size());
  }
  changed_ = 0.0f;
  for (std::size_t i = 0; i < classes; ++i) changed_ += 0.5f * std::abs(histogram[i] - histogram_[i]);
  histogram_ = histogram;
}

}  // namespace relucent::engine
