// SPDX-License-Identifier: MIT
#include "relucent/monitoring/sampled_transport.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/base/require.h"

namespace relucent::monitoring {
namespace {

constexpr float fullMean = 65535.0f;

/// Parts of a node's side from which a pixel is read each.
int partsOf(int level, bool exact) {
  if (exact || level <= 1) return 1 << level;
  return level == 2 ? 2 : 4;
}

/// The pixels at which a node is read.
void addPixelsOf(const transport::Node& node, const transport::Block& block, const Rasters& rasters,
                 bool exact, std::vector<std::uint32_t>& pixels) {
  const auto projector = static_cast<std::size_t>(node.projector);
  const Size size = rasters.size(projector);
  const int parts = partsOf(node.level, exact), side = (1 << node.level) / parts;
  for (int y = 0; y < parts; ++y)
    for (int x = 0; x < parts; ++x) {
      const int left = block.x0 + x * side, top = block.y0 + y * side;
      if (left >= block.x1 || top >= block.y1) continue;
      // Not the same place in each part: stripes would be seen as one of their colours.
      Random random({static_cast<std::uint64_t>(left), static_cast<std::uint64_t>(top),
                     static_cast<std::uint64_t>(side)});
      const auto across = static_cast<std::uint64_t>(std::min(side, block.x1 - left));
      const auto down = static_cast<std::uint64_t>(std::min(side, block.y1 - top));
      const Pixel at{left + static_cast<int>(random.below(across)),
                     top + static_cast<int>(random.below(down))};
      pixels.push_back(static_cast<std::uint32_t>(rasters.offset(projector) + indexOf(size, at)));
    }
}

}  // namespace

SampledTransport::SampledTransport(const transport::TransportMatrix& transport,
                                   const std::vector<std::uint32_t>& rows, std::size_t mostExact)
    : rasters_(transport.projectors()), layout_(transport.layout()) {
  const transport::NodeLayout& layout = layout_;
  std::vector<std::uint32_t>& nodes = nodes_;
  for (std::uint32_t row : rows) {
    const transport::LeafRow leaves = transport.row(row);
    nodes.insert(nodes.end(), leaves.columns().begin(), leaves.columns().end());
    if (nodes.size() > 4'000'000) {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());

  std::vector<std::size_t> rowStart{0};
  LargeVector<std::uint32_t> column;
  LargeVector<std::array<std::int16_t, 9>> code;
  std::vector<float> scale;
  for (std::uint32_t row : rows) {
    const transport::LeafRow leaves = transport.row(row);
    float largest = 0.0f;
    for (std::size_t entry = 0; entry < leaves.size(); ++entry)
      largest = std::max(largest, leaves.sizeOf(entry).largest);
    scale.push_back(std::max(largest, 1e-30f) / 32767.0f);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
      column.push_back(static_cast<std::uint32_t>(
          std::lower_bound(nodes.begin(), nodes.end(), leaves.column(entry)) - nodes.begin()));
      code.push_back(transport::codeOf(leaves.block(entry), scale.back()));
    }
    rowStart.push_back(column.size());
  }
  leaves_ = transport::BlockSparse::assembled(nodes.size(), std::move(rowStart), std::move(column),
                                              std::move(code), std::move(scale));

  const bool exact = rasters_.count() <= mostExact;
  nodeBegin_.push_back(0);
  for (std::uint32_t index : nodes) {
    const transport::Node node = layout.node(index);
    projectorOf_.push_back(static_cast<std::uint8_t>(node.projector));
    addPixelsOf(node, layout.block(node), rasters_, exact, nodePixels_);
    nodeBegin_.push_back(nodePixels_.size());
  }
  pixels_ = nodePixels_;
  std::sort(pixels_.begin(), pixels_.end());
  pixels_.erase(std::unique(pixels_.begin(), pixels_.end()), pixels_.end());
  for (std::uint32_t& pixel : nodePixels_)
    pixel =
        static_cast<std::uint32_t>(std::lower_bound(pixels_.begin(), pixels_.end(), pixel) - pixels_.begin());
}

std::size_t SampledTransport::bytes() const {
  return leaves_.bytes() + projectorOf_.size() + 4 * (nodes_.size() + pixels_.size() + nodePixels_.size()) +
         8 * nodeBegin_.size();
}

std::vector<SampledTransport::Arrival> SampledTransport::arrivalsOf(std::uint32_t sample) const {
  std::vector<Arrival> arrivals;
  for (std::size_t entry = leaves_.rowBegin(sample); entry < leaves_.rowBegin(sample + 1); ++entry) {
    const std::size_t node = leaves_.column(entry);
    float sum = 0.0f;
    for (std::int16_t value : leaves_.code(entry)) sum += value;
    arrivals.push_back(
        {projectorOf_[node], layout_.block(layout_.node(nodes_[node])), leaves_.scale(sample) * sum});
  }
  return arrivals;
}

FrameMeans SampledTransport::meansOf(std::span<const float> light) const {
  require(light.size() == 3 * pixels_.size(), "{} values for {} pixels", light.size(), pixels_.size());
  FrameMeans means(3 * projectorOf_.size());
  for (std::size_t node = 0; node < projectorOf_.size(); ++node) {
    std::array<float, 3> sum{};
    for (std::size_t i = nodeBegin_[node]; i < nodeBegin_[node + 1]; ++i)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += light[3 * nodePixels_[i] + k];
    const float scale = fullMean / static_cast<float>(nodeBegin_[node + 1] - nodeBegin_[node]);
    for (std::size_t k = 0; k < 3; ++k)
      means[3 * node + k] = static_cast<std::uint16_t>(std::clamp(scale * sum[k], 0.0f, fullMean) + 0.5f);
  }
  return means;
}

FrameMeans SampledTransport::meansOf(const ProjectorStack& linear) const {
  require(linear.size() == 3 * rasters_.count(), "{} values for {} pixels", linear.size(), rasters_.count());
  std::vector<float> light;
  light.reserve(3 * pixels_.size());
  for (std::uint32_t pixel : pixels_)
    light.insert(light.end(), linear.begin() + 3 * pixel, linear.begin() + 3 * pixel + 3);
  return meansOf(std::span<const float>(light));
}

std::vector<float> SampledTransport::lightOf(std::span<const float> means,
                                             std::span<const std::uint32_t> samples) const {
  require(means.size() == 3 * projectorOf_.size(), "{} means of {} nodes", means.size(), projectorOf_.size());
  const std::size_t each = 9 * projectors();
  std::vector<float> light(each * samples.size(), 0.0f);
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const std::size_t row = samples[s];
    float* const parts = &light[each * s];
    for (std::size_t entry = leaves_.rowBegin(row); entry < leaves_.rowBegin(row + 1); ++entry) {
      const std::size_t node = leaves_.column(entry);
      const std::array<std::int16_t, 9>& code = leaves_.code(entry);
      float* const part = parts + 9 * projectorOf_[node];
      const float* const mean = &means[3 * node];
      for (std::size_t i = 0; i < 9; ++i) part[i] += static_cast<float>(code[i]) * mean[i % 3];
    }
    for (std::size_t i = 0; i < each; ++i) parts[i] *= leaves_.scale(row);
  }
  return light;
}

std::vector<float> mixed(std::span<const FrameMeans* const> frames, std::span<const double> weights) {
  require(frames.size() == weights.size() && !frames.empty(), "{} frames, {} weights", frames.size(),
          weights.size());
  std::vector<float> mean(frames.front()->size(), 0.0f);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (weights[k] == 0.0) continue;
    const auto weight = static_cast<float>(weights[k] / fullMean);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += weight * static_cast<float>((*frames[k])[i]);
  }
  return mean;
}

}  // namespace relucent::monitoring
