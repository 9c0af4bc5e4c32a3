// SPDX-License-Identifier: MIT
#include "relucent/importing/agreement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace relucent::importing {
namespace {

constexpr int reach = 4;            // projector pixels within which equal places are one set
constexpr float outlier = 2.5f;     // projector pixels off the plane
constexpr int leastInliers = 12;    // for three unknowns
constexpr float spanWanted = 8.0f;  // projector pixels that a window should cover: more than a set does
constexpr int leastRadius = 3, mostRadius = 10;

using Place = Eigen::Vector2f;

class Agreement {
 public:
  Agreement(const SequencePyramid& pyramid, Size camera, const std::vector<Decoded>& decoded)
      : pyramid_(pyramid),
        projector_(pyramid.levels.front().grid),
        camera_(camera),
        decoded_(decoded),
        middle_(decoded.size(), Place::Zero()),
        undecided_(decoded.size(), 0) {
    parallelFor(0, decoded.size(), 256, [&](std::size_t pixel) {
      if (decoded[pixel].pixel < 0) return;
      std::vector<Pixel> alike = placesLike(decoded[pixel].pixel);
      for (const Pixel& place : alike) middle_[pixel] += centreOf(place);
      middle_[pixel] /= static_cast<float>(alike.size());
      undecided_[pixel] = alike.size() > 1 ? 1 : 0;
    });
    float step = typicalStep();
    radius_ = std::clamp(static_cast<int>(std::ceil(0.5f * spanWanted / std::max(step, 0.1f))), leastRadius,
                         mostRadius);
    nearby_ = 2.0f * step * static_cast<float>(radius_) + static_cast<float>(reach);
  }

  Decoded settled(std::size_t pixel) const {
    Decoded own = decoded_[pixel];
    if (own.pixel < 0) return own;
    Place centre = centreOf(pixelAt(projector_, static_cast<std::size_t>(own.pixel)));
    own.x = centre[0], own.y = centre[1];
    Place wanted;
    if (undecided_[pixel] == 0 || !onPlane(pixel, wanted)) return own;
    float nearest = 1e30f;
    for (const Pixel& place : placesLike(own.pixel)) {
      float apart = (centreOf(place) - wanted).squaredNorm();
      if (apart >= nearest) continue;
      nearest = apart;
      own.pixel = static_cast<std::int32_t>(indexOf(projector_, place));
      own.x = std::clamp(wanted[0], static_cast<float>(place.x), static_cast<float>(place.x) + 1.0f);
      own.y = std::clamp(wanted[1], static_cast<float>(place.y), static_cast<float>(place.y) + 1.0f);
    }
    return own;
  }

 private:
  static Place centreOf(Pixel place) {
    return {static_cast<float>(place.x) + 0.5f, static_cast<float>(place.y) + 0.5f};
  }

  /// Places around one whose patterns are the same, itself among them.
  std::vector<Pixel> placesLike(std::int32_t pixel) const {
    const SequencePyramid::Level& level = pyramid_.levels.front();
    Pixel at = pixelAt(projector_, static_cast<std::size_t>(pixel));
    const float* own = level.node(static_cast<std::size_t>(pixel), pyramid_.samples);
    std::vector<Pixel> alike;
    for (int y = std::max(0, at.y - reach); y <= std::min(projector_.height - 1, at.y + reach); ++y)
      for (int x = std::max(0, at.x - reach); x <= std::min(projector_.width - 1, at.x + reach); ++x) {
        const float* other = level.node(indexOf(projector_, {x, y}), pyramid_.samples);
        if (std::equal(own, own + pyramid_.samples, other)) alike.push_back({x, y});
      }
    return alike;
  }

  /// Median distance between the places of camera pixels side by side, over a distance that rounding does not
  /// matter to.
  float typicalStep() const {
    constexpr int apart = 16;
    std::vector<float> steps;
    for (int y = 0; y < camera_.height; y += 3)
      for (int x = 0; x + apart < camera_.width; x += 5) {
        std::size_t a = indexOf(camera_, {x, y}), b = indexOf(camera_, {x + apart, y});
        if (decoded_[a].pixel >= 0 && decoded_[b].pixel >= 0)
          steps.push_back((middle_[a] - middle_[b]).norm() / static_cast<float>(apart));
      }
    if (steps.empty()) return 1.0f;
    auto half = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), half, steps.end());
    return *half;
  }

  /// Where the neighbours' plane has this pixel. False if too few agree on one.
  bool onPlane(std::size_t pixel, Place& place) const {
    Pixel at = pixelAt(camera_, pixel);
    Eigen::Matrix<float, 3, 2> plane = Eigen::Matrix<float, 3, 2>::Zero();
    plane.row(0) = middle_[pixel];
    float tolerated = nearby_;
    for (int round = 0; round < 3; ++round) {
      Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
      Eigen::Matrix<float, 3, 2> right = Eigen::Matrix<float, 3, 2>::Zero();
      int inliers = 0;
      for (int y = std::max(0, at.y - radius_); y <= std::min(camera_.height - 1, at.y + radius_); ++y)
        for (int x = std::max(0, at.x - radius_); x <= std::min(camera_.width - 1, at.x + radius_); ++x) {
          std::size_t other = indexOf(camera_, {x, y});
          if (decoded_[other].pixel < 0) continue;
          Eigen::Vector3f where(1.0f, static_cast<float>(x - at.x), static_cast<float>(y - at.y));
          if ((middle_[other] - plane.transpose() * where).norm() > tolerated) continue;
          normal += where * where.transpose();
          right += where * middle_[other].transpose();
          ++inliers;
        }
      if (inliers < leastInliers) return false;
      normal.diagonal().array() += 1e-3f;  // a line of pixels says nothing across
      plane = normal.ldlt().solve(right);
      tolerated = round == 0 ? 2.0f * outlier : outlier;
    }
    place = plane.row(0).transpose();
    return place.allFinite();
  }

  const SequencePyramid& pyramid_;
  Size projector_, camera_;
  const std::vector<Decoded>& decoded_;
  std::vector<Place> middle_;            // of each pixel's set of places
  std::vector<std::uint8_t> undecided_;  // there are several
  int radius_ = leastRadius;
  float nearby_ = 0.0f;  // projector pixels within which a neighbour may be on the same surface
};

}  // namespace

void agreeOnPlaces(const SequencePyramid& pyramid, Size camera, std::vector<Decoded>& decoded) {
  Agreement agreement(pyramid, camera, decoded);
  std::vector<Decoded> settled(decoded.size());
  parallelFor(0, decoded.size(), 256, [&](std::size_t pixel) { settled[pixel] = agreement.settled(pixel); });
  decoded = std::move(settled);
}

}  // namespace relucent::importing
