// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/transport/node_layout.h"

namespace relucent::multiplexing {

/// The means of many binary patterns over all nodes, one node's means beside each other: what the regression
/// of a camera pixel reads. Nodes inside a block share its value, so that only patterns of single pixels need
/// a value for each pixel: a bit for each of its channels. A coarser node needs two bytes, its means are
/// rounded to 1/65535. Patterns of 1024x768 pixels take 1.9 MB each, those in blocks of 2 pixels 1.6 MB, of 4
/// 0.4 MB.
class PatternMeans {
 public:
  explicit PatternMeans(transport::NodeLayout layout) : layout_(std::move(layout)) {}

  const transport::NodeLayout& layout() const { return layout_; }
  std::size_t patterns() const { return patterns_; }

  /// Patterns of zeros and ones, one value in every node of `level`, after those that are there. A projector
  /// whose pyramid is lower has one value.
  void add(int level, const std::vector<ProjectorStack>& patterns);
  /// Forgets all but the first ones.
  void keep(std::size_t count);

  /// A node's means in each channel, pattern after pattern.  Shapes: patterns() values each.
  void read(const transport::Node& node, const std::array<float*, 3>& means) const;

 private:
  /// The patterns of one add().
  struct Batch {
    int level = 0;
    std::size_t patterns = 0;           // that are stored ...
    std::size_t used = 0;               // ... and not forgotten
    std::size_t first = 0;              // of the nodes in `blocks`
    std::vector<std::uint8_t> pixels;   // [node][channel][pattern / 8], bits of patterns of single pixels
    std::vector<std::uint16_t> blocks;  // [node][channel][pattern], from the first node on
  };

  std::size_t storedNode(const Batch& batch, std::size_t index, const transport::Node& node) const;

  transport::NodeLayout layout_;
  std::size_t patterns_ = 0;
  std::vector<Batch> batches_;
};

}  // namespace relucent::multiplexing
