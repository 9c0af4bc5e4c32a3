// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "relucent/multiplexing/regression.h"

namespace relucent::acquisition {

/// How photographs of patterns go together with the rows that were solved from all of them: where a hand, a
/// flash or a passer-by spoilt one, and how much brighter than the others the lamp was in each.
///   A camera pixel contradicts a photograph where |shown - predicted| > max(0.1 F, 5 standard deviations).
///   A photograph's gain is sum(w shown predicted) / sum(w predicted^2) over the pixels that do not, w =
///   1 / variance, relative to the mean of all photographs: what is common to them is the floods' to say.
class PhotographReview {
 public:
  explicit PhotographReview(std::size_t photographs) : photographs_(photographs) {}

  /// A camera pixel: what it showed and what the fit of its row predicts. Units: as RowLight.
  /// Shapes: the photographs are the last rows of `seen`, predictions have a row each.
  void add(std::size_t row, const multiplexing::RowLight& seen, const Eigen::ArrayX3f& predictions,
           float excess);
  /// Camera pixels that another review looked at. In order, for the same bits on every machine.
  void add(const PhotographReview& other);

  /// Camera pixels and the photographs that they contradict.
  const std::vector<std::pair<std::size_t, std::uint32_t>>& contradictions() const { return contradictions_; }
  /// Photographs that at least 1 % of the camera pixels contradict, and nearly as many as the worst one.
  /// By number.
  std::vector<std::size_t> spoilt() const;
  /// Light of each photograph relative to all, within 10 %.
  std::vector<float> gains() const;

 private:
  struct Photograph {
    double shown = 0.0, predicted = 0.0;
    std::size_t contradicting = 0;
  };
  std::vector<Photograph> photographs_;
  std::size_t rows_ = 0;
  std::vector<std::pair<std::size_t, std::uint32_t>> contradictions_;
};

}  // namespace relucent::acquisition
