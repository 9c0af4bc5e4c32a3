// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/transport/node_layout.h"

namespace relucent::multiplexing {

/// The means of many binary patterns over all nodes, one node's means beside each other: what the regression
/// of a camera pixel reads. A byte for each pixel and channel, two for a coarser node, whose means are
/// rounded to 1/65535: 1024x768 pixels take 4.3 MB a pattern.
class PatternMeans {
 public:
  explicit PatternMeans(transport::NodeLayout layout) : layout_(std::move(layout)) {}

  const transport::NodeLayout& layout() const { return layout_; }
  std::size_t patterns() const { return patterns_; }

  /// Patterns of zeros and ones, after those that are there.
  void add(const std::vector<ProjectorStack>& patterns);

  /// A node's means in each channel, pattern after pattern.  Shapes: patterns() values each.
  void read(std::size_t node, const std::array<float*, 3>& means) const;

 private:
  /// The patterns of one add().
  struct Batch {
    std::size_t patterns = 0;
    std::vector<std::uint8_t> pixels;   // [node][channel][pattern]
    std::vector<std::uint16_t> blocks;  // likewise, from the first node of level 1
  };

  transport::NodeLayout layout_;
  std::size_t patterns_ = 0;
  std::vector<Batch> batches_;
};

}  // namespace relucent::multiplexing
