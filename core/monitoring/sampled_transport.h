// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::monitoring {

/// A picture of all projectors as some rows of T need it: the means over the nodes that these see, in linear
/// light, 65535 at full drive. Shape: 3 values a node.
using FrameMeans = std::vector<std::uint16_t>;

/// Some rows of T, for predictions that cost as little as these rows: a picture is read at the pixels alone
/// that they need, and nodes wider than two pixels are estimated from pixels spread over them, one in each of
/// at most 4x4 parts.
class SampledTransport {
 public:
  SampledTransport() = default;
  /// `rows`: of T. `mostExact`: with no more projector pixels than this all of them are read.
  SampledTransport(const transport::TransportMatrix& transport, const std::vector<std::uint32_t>& rows,
                   std::size_t mostExact = 400'000);

  std::size_t rows() const { return leaves_.rows(); }
  std::size_t projectors() const { return rasters_.devices(); }
  const Rasters& rasters() const { return rasters_; }
  std::size_t bytes() const;
  /// The pixels of all projectors (indices of Rasters, ascending) at which a picture is read.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

  /// Of linear light at pixels(), three values each, 0 to 1.
  FrameMeans meansOf(std::span<const float> light) const;
  /// The same of whole pictures.
  FrameMeans meansOf(const ProjectorStack& linear) const;

  /// What these samples (rows as given) see of each projector's channels:
  ///   light[((s P + j) 3 + c) 3 + k] = sum over j's leaves of T_s,leaf(c, k) v_leaf,k
  /// c: camera's channel, k: projector's. The sum over j and k is T p. `means`: 0 to 1.
  std::vector<float> lightOf(std::span<const float> means, std::span<const std::uint32_t> samples) const;

  /// Light at full drive that a sample sees of a part of a projector: the sum of a leaf's nine values.
  struct Arrival {
    std::size_t projector = 0;
    transport::Block from;
    float light = 0.0f;
  };
  /// Of all leaves of a sample.
  std::vector<Arrival> arrivalsOf(std::uint32_t sample) const;

 private:
  Rasters rasters_;
  transport::NodeLayout layout_;
  std::vector<std::uint32_t> nodes_;       // of the layout, as they are numbered here
  transport::BlockSparse leaves_;          // of nodes that are used, numbered anew
  std::vector<std::uint8_t> projectorOf_;  // per node
  std::vector<std::uint32_t> pixels_;
  std::vector<std::size_t> nodeBegin_;     // into nodePixels_, one more than nodes
  std::vector<std::uint32_t> nodePixels_;  // indices into pixels_
};

/// Weighted mean of frames: what an exposure sees that lasts over several. Contract: as many weights.
std::vector<float> mixed(std::span<const FrameMeans* const> frames, std::span<const double> weights);

}  // namespace relucent::monitoring
