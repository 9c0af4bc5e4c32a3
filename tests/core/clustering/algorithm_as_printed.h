// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "relucent/clustering/clustering.h"
#include "relucent/image/colour.h"

namespace relucent {

/// Algorithm 1, transcribed line by line on a dense table, as slow as it reads.
class AsPrinted {
 public:
  AsPrinted(const transport::TransportMatrix& transport, double thresh1, double thresh2)
      : projectors_(transport.projectors()),
        rows_(transport.cameras().count()),
        columns_(projectors_.count()),
        luminance_(rows_ * columns_, 0.0f),
        connected_(rows_ * columns_, false) {
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t e = transport.ownLeaves().rowBegin(i); e < transport.ownLeaves().rowBegin(i + 1);
           ++e) {
        transport::ColourBlock b = transport.ownLeaves().block(i, e);
        std::array<int, 3> sum{};
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t p = 0; p < 3; ++p) sum[c] += transport.ownLeaves().code(e)[3 * c + p];
        at(i, transport.ownLeaves().column(e)) =
            transport.ownLeaves().scale(i) * image::luminanceOf(static_cast<float>(sum[0]),
                                                                static_cast<float>(sum[1]),
                                                                static_cast<float>(sum[2]));
        connected_[i * columns_ + transport.ownLeaves().column(e)] = b.sum() > 0;
      }
    std::vector<bool> original = connected_;
    for (std::size_t ci = 0; ci < rows_; ++ci) {  // line 1
      std::vector<bool> labelled(columns_, false);
      std::vector<std::vector<std::size_t>> patches;
      while (!allLabelled(ci, labelled)) {                           // line 2
        std::size_t centre = findBrightestUnlabelled(ci, labelled);  // line 3
        labelled[centre] = true;                                     // line 4
        patches.push_back({centre});
        for (std::size_t pj = 0; pj < columns_; ++pj) {  // line 5
          if (!connected(ci, pj) || labelled[pj]) continue;
          if (distance(centre, pj) <= thresh1) {  // line 6
            patches.back().push_back(pj);         // line 7
            labelled[pj] = true;                  // line 8
          }
        }
      }
      for (const auto& patch : patches) {  // line 12
        double highest = at(ci, patch.front());
        for (std::size_t pk : patch)                                                    // line 13
          if (at(ci, pk) <= thresh2 * highest) connected_[ci * columns_ + pk] = false;  // lines 14, 15
      }
    }
    for (std::size_t pj = 0; pj < columns_; ++pj) {  // line 20
      std::size_t most = rows_;
      bool cutOff = true;
      for (std::size_t ci = 0; ci < rows_; ++ci) {
        if (connected(ci, pj)) cutOff = false;
        if (original[ci * columns_ + pj] && (most == rows_ || at(ci, pj) > at(most, pj))) most = ci;
      }
      if (cutOff && most < rows_) connected_[most * columns_ + pj] = true;
    }
  }

  bool connected(std::size_t i, std::size_t j) const { return connected_[i * columns_ + j]; }

  /// Components by flooding.
  std::vector<std::uint32_t> projectorClusters() const {
    std::vector<std::uint32_t> cluster(columns_, clustering::noCluster);
    std::uint32_t next = 0;
    for (std::size_t start = 0; start < columns_; ++start) {
      if (cluster[start] != clustering::noCluster || !anyRow(start)) continue;
      std::vector<std::size_t> front{start};
      cluster[start] = next;
      while (!front.empty()) {
        std::size_t j = front.back();
        front.pop_back();
        for (std::size_t i = 0; i < rows_; ++i)
          for (std::size_t k = 0; k < columns_ && connected(i, j); ++k)
            if (connected(i, k) && cluster[k] == clustering::noCluster) {
              cluster[k] = next;
              front.push_back(k);
            }
      }
      ++next;
    }
    return cluster;
  }

 private:
  float& at(std::size_t i, std::size_t j) { return luminance_[i * columns_ + j]; }
  bool anyRow(std::size_t j) const {
    for (std::size_t i = 0; i < rows_; ++i)
      if (connected(i, j)) return true;
    return false;
  }
  bool allLabelled(std::size_t i, const std::vector<bool>& labelled) const {
    for (std::size_t j = 0; j < columns_; ++j)
      if (connected(i, j) && !labelled[j]) return false;
    return true;
  }
  std::size_t findBrightestUnlabelled(std::size_t i, const std::vector<bool>& labelled) {
    std::size_t best = columns_;
    for (std::size_t j = 0; j < columns_; ++j)
      if (connected(i, j) && !labelled[j] && (best == columns_ || at(i, j) > at(i, best))) best = j;
    return best;
  }
  double distance(std::size_t a, std::size_t b) const {
    std::size_t device = 0;
    auto deviceOf = [&](std::size_t pixel) {
      device = 0;
      while (device + 1 < projectors_.devices() && pixel >= projectors_.offset(device + 1)) ++device;
      return device;
    };
    std::size_t da = deviceOf(a), db = deviceOf(b);
    if (da != db) return std::numeric_limits<double>::infinity();
    Pixel p = pixelAt(projectors_.size(da), a - projectors_.offset(da));
    Pixel q = pixelAt(projectors_.size(da), b - projectors_.offset(da));
    return std::hypot(p.x - q.x, p.y - q.y);
  }

  Rasters projectors_;
  std::size_t rows_, columns_;
  std::vector<float> luminance_;
  std::vector<bool> connected_;
};

}  // namespace relucent
