// SPDX-License-Identifier: MIT
#include "relucent/acquisition/photograph_review.h"

#include <algorithm>
#include <cmath>

namespace relucent::acquisition {
namespace {

constexpr float contradictingLight = 0.1f;  // of the flood, as a flagged pixel's of its light
constexpr float contradictingSigmas = 5.0f;
constexpr double spoiltShare = 0.01;
// What one photograph spoils makes sound ones contradict: the worst are taken out first.
constexpr double relativeShare = 0.3;
constexpr double mostGain = 0.1;

}  // namespace

void PhotographReview::add(std::size_t row, const multiplexing::RowLight& seen,
                           const Eigen::ArrayX3f& predictions, float excess) {
  ++rows_;
  Eigen::Index floods = seen.light.rows() - predictions.rows();
  for (Eigen::Index n = 0; n < predictions.rows(); ++n) {
    Photograph& photograph = photographs_[static_cast<std::size_t>(n)];
    double shown = 0.0, predicted = 0.0;
    bool contradicts = false;
    for (Eigen::Index c = 0; c < 3; ++c) {
      float variance = seen.variance(floods + n, c) + excess;
      if (!std::isfinite(variance)) continue;
      float light = seen.light(floods + n, c), off = light - predictions(n, c);
      contradicts = contradicts ||
                    std::abs(off) > std::max(contradictingLight, contradictingSigmas * std::sqrt(variance));
      shown += static_cast<double>(light * predictions(n, c) / variance);
      predicted += static_cast<double>(predictions(n, c) * predictions(n, c) / variance);
    }
    if (contradicts) {
      ++photograph.contradicting;
      contradictions_.emplace_back(row, static_cast<std::uint32_t>(n));
    } else {
      photograph.shown += shown;
      photograph.predicted += predicted;
    }
  }
}

void PhotographReview::add(const PhotographReview& other) {
  rows_ += other.rows_;
  for (std::size_t n = 0; n < photographs_.size(); ++n) {
    photographs_[n].shown += other.photographs_[n].shown;
    photographs_[n].predicted += other.photographs_[n].predicted;
    photographs_[n].contradicting += other.photographs_[n].contradicting;
  }
  contradictions_.insert(contradictions_.end(), other.contradictions_.begin(), other.contradictions_.end());
}

std::vector<std::size_t> PhotographReview::spoilt() const {
  std::size_t most = 0;
  for (const Photograph& photograph : photographs_) most = std::max(most, photograph.contradicting);
  double limit =
      std::max(spoiltShare * static_cast<double>(rows_), relativeShare * static_cast<double>(most));
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < photographs_.size(); ++n)
    if (static_cast<double>(photographs_[n].contradicting) > limit) numbers.push_back(n);
  return numbers;
}

std::vector<float> PhotographReview::gains() const {
  std::vector<double> gains;
  double sum = 0.0;
  for (const Photograph& photograph : photographs_) {
    gains.push_back(photograph.predicted > 0.0 ? photograph.shown / photograph.predicted : 1.0);
    sum += gains.back();
  }
  double mean = sum / static_cast<double>(std::max<std::size_t>(1, gains.size()));
  std::vector<float> relative;
  for (double gain : gains)
    relative.push_back(
        mean > 0.0 ? static_cast<float>(std::clamp(gain / mean, 1.0 - mostGain, 1.0 + mostGain)) : 1.0f);
  return relative;
}

}  // namespace relucent::acquisition
