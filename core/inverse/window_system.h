// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "inverse/near_field.h"

namespace relucent {

/// The linear system of one window at a time,
///   G = T_W T_W^T   and   T_J,   one colour channel,
/// from the near fields of the window's camera pixels W, whatever the levels of their leaves. Pixels are told
/// apart up to 8 beyond the tile J; what is further off (refraction, mirrors) enters G by areas of 8 x 8
/// pixels or its own size: its detail is of no use to the tile, but must not pass for the tile's light
/// either. Kept between windows so that nothing is allocated for each.
class WindowSystem {
 public:
  /// Keeps references: both outlive it.
  WindowSystem(const NearField& near, const NodeLayout& layout) : near_(near), layout_(layout) {}

  /// `tile`: pixels of a projector. `rows`: camera pixels, the order of G.
  void gather(const Block& tile, int side, int projector, std::span<const std::uint32_t> rows);
  /// Fills gram() and columns() for a channel.
  void correlate(std::size_t channel);

  /// G, lower triangle. Shape: rows x rows.
  Eigen::MatrixXf& gram() { return gram_; }
  /// T_J. Shape: rows x pixels of a whole tile, row by row; zero where the tile leaves the projector.
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
    Node place;
    float pixels;
    std::size_t begin, end;
    Eigen::Index beyond = -1;  // of the areas beyond all regions, the one that it lies in
  };
  /// The part of a projector whose pixels are told apart.
  struct Region {
    int projector;
    Block block;
    Size size() const { return {block.x1 - block.x0, block.y1 - block.y0}; }
  };

  void gatherLeaves(std::span<const std::uint32_t> rows);
  void chooseRegions();
  void gatherBeyond();
  void expand(const Region& region, std::size_t channel);
  void expandBeyond(std::size_t channel);

  const NearField& near_;
  const NodeLayout& layout_;
  Block tile_;
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

}  // namespace relucent
