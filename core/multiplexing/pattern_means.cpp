// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/pattern_means.h"

#include <cmath>

#include "relucent/base/parallel.h"

namespace relucent::multiplexing {
namespace {

constexpr float whole = 65535.0f;

}  // namespace

void PatternMeans::add(const std::vector<ProjectorStack>& patterns) {
  std::size_t pixels = layout_.projectors().count(), nodes = layout_.count();
  std::size_t stride = 3 * patterns.size();
  Batch batch{patterns.size(), std::vector<std::uint8_t>(stride * pixels),
              std::vector<std::uint16_t>(stride * (nodes - pixels))};
  for (std::size_t number = 0; number < patterns.size(); ++number) {
    transport::NodeStack means = layout_.means(patterns[number]);
    parallelFor(0, pixels, 4096, [&](std::size_t node) {
      for (std::size_t c = 0; c < 3; ++c)
        batch.pixels[node * stride + c * batch.patterns + number] = means[3 * node + c] > 0.5f ? 1 : 0;
    });
    parallelFor(pixels, nodes, 4096, [&](std::size_t node) {
      for (std::size_t c = 0; c < 3; ++c)
        batch.blocks[(node - pixels) * stride + c * batch.patterns + number] =
            static_cast<std::uint16_t>(std::lround(whole * means[3 * node + c]));
    });
  }
  patterns_ += patterns.size();
  batches_.push_back(std::move(batch));
}

void PatternMeans::read(std::size_t node, const std::array<float*, 3>& means) const {
  std::size_t pixels = layout_.projectors().count(), at = 0;
  for (const Batch& batch : batches_) {
    std::size_t count = batch.patterns, stride = 3 * count;
    for (std::size_t c = 0; c < 3; ++c) {
      float* to = means[c] + at;
      if (node < pixels) {
        const std::uint8_t* from = &batch.pixels[node * stride + c * count];
        for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>(from[i]);
      } else {
        const std::uint16_t* from = &batch.blocks[(node - pixels) * stride + c * count];
        for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>(from[i]) * (1.0f / whole);
      }
    }
    at += count;
  }
}

}  // namespace relucent::multiplexing
