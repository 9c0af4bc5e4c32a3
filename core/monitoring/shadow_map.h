// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/monitoring/watched_venue.h"

namespace relucent::monitoring {

/// Which cells of which projectors light the samples that stand for a view: what shadows are looked for in.
/// A cell is a square of projector pixels; cells of all projectors are numbered in turn, row by row.
class ShadowMap {
 public:
  /// A cell and a sample that it lights, with the share of all that the cell's projector sends there at full
  /// drive.
  struct Link {
    std::uint32_t other = 0;  // a cell, of a sample; or a sample, of a cell
    float share = 0.0f;
  };
  struct Grid {
    int side = 1;
    Size cells;
    std::size_t first = 0;  // number of its first cell
  };

  ShadowMap() = default;
  /// `mostAcross`: cells along a projector's longer side.
  explicit ShadowMap(const WatchedVenue& venue, int mostAcross = 32);

  /// As Sampling::even has them, of which those here are numbered.
  const std::vector<std::uint32_t>& samples() const { return samples_; }
  std::size_t projectors() const { return grids_.size(); }
  const std::vector<Grid>& grids() const { return grids_; }
  std::size_t cells() const { return grids_.empty() ? 0 : grids_.back().first + grids_.back().cells.count(); }
  std::size_t projectorOf(std::size_t cell) const { return projectorOf_[cell]; }
  /// Of light that arrives from no wider than about a cell; the rest is indirect, and taken for what it
  /// always is.
  const std::vector<Link>& cellsOf(std::size_t sample) const { return cellsOf_[sample]; }
  const std::vector<Link>& samplesOf(std::size_t cell) const { return samplesOf_[cell]; }
  /// At full drive, the sum of all channels.
  float floodOf(std::size_t sample, std::size_t projector) const {
    return flood_[sample * projectors() + projector];
  }
  /// The cells beside a cell, diagonally too, of the same projector.
  std::vector<std::size_t> around(std::size_t cell) const;

 private:
  std::vector<std::uint32_t> samples_;
  std::vector<Grid> grids_;
  std::vector<std::uint8_t> projectorOf_;
  std::vector<std::vector<Link>> cellsOf_, samplesOf_;
  std::vector<float> flood_;
};

}  // namespace relucent::monitoring
