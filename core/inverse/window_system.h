// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "relucent/inverse/near_field.h"

namespace relucent::inverse {

/// The linear system of one window at a time,
///   G = T_W T_W^T   and   T_J,   one colour channel,
/// from the near fields of the window's camera pixels W, whatever the levels of their leaves. Single pixels
/// are resolved up to 8 pixels beyond the tile J; leaves further away (refraction, mirrors) enter G as areas
/// of 8 x 8 pixels or their own size: their detail is irrelevant to the tile, but their light must not be
/// attributed to it. Reused for all windows to avoid allocations.
class WindowSystem {
 public:
  /// Keeps references: both outlive it.
  WindowSystem(const NearField& near, const transport::NodeLayout& layout) : near_(near), layout_(layout) {}

  /// `tile`: pixels of a projector. `rows`: camera pixels, the order of G.
  void gather(const transport::Block& tile, int side, int projector, std::span<const std::uint32_t> rows);
  /// Fills gram() and columns() for a channel.
  void correlate(std::size_t channel);

  /// G, lower triangle. Shape: rows x rows.
  Eigen::MatrixXf& gram() { return gram_; }
  /// T_J. Shape: rows x pixels of a whole tile, row by row; zero where the tile extends beyond the projector.
  const Eigen::MatrixXf& columns() const { return columns_; }

 private:
  /// A leaf of one row of the window.
  struct Leaf {
    std::uint32_t node;
    std::uint32_t local;  // row within the window
    NearField::Value value;
  };
  /// All leaves of the window that share a node.
  struct Group {
    std::uint32_t node;
    transport::Node place;
    float pixels;
    std::size_t begin, end;
    Eigen::Index beyond = -1;  // index of the area beyond all regions that contains it
  };
  /// The part of a projector in which single pixels are resolved.
  struct Region {
    int projector;
    transport::Block block;
    Size size() const { return {block.x1 - block.x0, block.y1 - block.y0}; }
  };

  void gatherLeaves(std::span<const std::uint32_t> rows);
  void chooseRegions();
  void gatherBeyond();
  void expand(const Region& region, std::size_t channel);
  void expandBeyond(std::size_t channel);

  const NearField& near_;
  const transport::NodeLayout& layout_;
  transport::Block tile_;
  int side_ = 0;
  int projector_ = 0;
  Eigen::Index rows_ = 0;
  std::vector<Leaf> leaves_;
  std::vector<Group> groups_;
  std::vector<Region> regions_;
  std::vector<float> areaSide_;  // of the areas beyond all regions
  Eigen::MatrixXf beyond_;       // T_W over those areas: rows x areas
  Eigen::MatrixXf seen_;         // T_W over a region: rows x pixels
  Eigen::MatrixXf gram_, columns_;
};

}  // namespace relucent::inverse
