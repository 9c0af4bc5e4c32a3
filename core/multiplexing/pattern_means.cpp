// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/pattern_means.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/parallel.h"

namespace relucent::multiplexing {
namespace {

constexpr float whole = 65535.0f;

std::size_t bytesOf(std::size_t bits) {
  return (bits + 7) / 8;
}

using EightValues = std::array<float, 8>;
/// The bits of every byte as numbers.
const std::array<EightValues, 256>& valuesOfBits() {
  static const auto table = [] {
    std::array<EightValues, 256> values{};
    for (std::size_t byte = 0; byte < values.size(); ++byte)
      for (std::size_t bit = 0; bit < 8; ++bit) values[byte][bit] = static_cast<float>((byte >> bit) & 1U);
    return values;
  }();
  return table;
}

void readBits(const std::uint8_t* from, std::size_t count, float* to) {
  const std::array<EightValues, 256>& values = valuesOfBits();
  for (; count >= 8; count -= 8, to += 8) std::ranges::copy(values[*from++], to);
  if (count > 0) std::copy_n(values[*from].begin(), count, to);
}

/// The node of `level` that holds one, or the last of its projector.
transport::Node ancestor(const transport::NodeLayout& layout, transport::Node node, int level) {
  int last = std::min(level, layout.levels(static_cast<std::size_t>(node.projector)) - 1);
  if (node.level >= last) return node;
  int up = last - node.level;
  return {node.projector, last, node.x >> up, node.y >> up};
}

}  // namespace

void PatternMeans::add(int level, const std::vector<ProjectorStack>& patterns) {
  if (patterns.empty()) return;
  std::size_t pixels = layout_.projectors().count(), nodes = layout_.count(), first = nodes;
  for (std::size_t projector = 0; projector < layout_.projectors().devices(); ++projector)
    first = std::min(first, layout_.index(ancestor(layout_, {static_cast<int>(projector), 0, 0, 0}, level)));
  Batch batch{level, patterns.size(), patterns.size(), std::max(first, pixels), {}, {}};
  std::size_t stride = 3 * batch.patterns, bytes = bytesOf(batch.patterns);
  if (first < pixels) batch.pixels.resize(3 * bytes * pixels);
  batch.blocks.resize(stride * (nodes - batch.first));
  for (std::size_t number = 0; number < patterns.size(); ++number) {
    transport::NodeStack means = layout_.means(patterns[number]);
    if (!batch.pixels.empty())
      parallelFor(0, pixels, 4096, [&](std::size_t node) {
        for (std::size_t c = 0; c < 3; ++c)
          if (means[3 * node + c] > 0.5f)
            batch.pixels[(3 * node + c) * bytes + number / 8] |=
                static_cast<std::uint8_t>(1U << (number % 8));
      });
    parallelFor(batch.first, nodes, 4096, [&](std::size_t node) {
      for (std::size_t c = 0; c < 3; ++c)
        batch.blocks[(node - batch.first) * stride + c * batch.patterns + number] =
            static_cast<std::uint16_t>(std::lround(whole * means[3 * node + c]));
    });
  }
  patterns_ += patterns.size();
  batches_.push_back(std::move(batch));
}

void PatternMeans::keep(std::size_t count) {
  patterns_ = std::min(count, patterns_);
  std::size_t left = patterns_;
  for (Batch& batch : batches_) {
    batch.used = std::min(batch.used, left);
    left -= batch.used;
  }
  std::erase_if(batches_, [](const Batch& batch) { return batch.used == 0; });
}

std::size_t PatternMeans::storedNode(const Batch& batch, std::size_t index,
                                     const transport::Node& node) const {
  return index >= batch.first || !batch.pixels.empty() ? index
                                                       : layout_.index(ancestor(layout_, node, batch.level));
}

void PatternMeans::read(const transport::Node& node, const std::array<float*, 3>& means) const {
  std::size_t index = layout_.index(node), at = 0;
  for (const Batch& batch : batches_) {
    std::size_t count = batch.patterns, stride = 3 * count, stored = storedNode(batch, index, node);
    for (std::size_t c = 0; c < 3; ++c) {
      float* to = means[c] + at;
      if (stored < batch.first) {
        readBits(&batch.pixels[(3 * stored + c) * bytesOf(count)], batch.used, to);
      } else {
        const std::uint16_t* from = &batch.blocks[(stored - batch.first) * stride + c * count];
        for (std::size_t i = 0; i < batch.used; ++i) to[i] = static_cast<float>(from[i]) * (1.0f / whole);
      }
    }
    at += batch.used;
  }
}

}  // namespace relucent::multiplexing
