// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "relucent/base/message.h"

namespace relucent::compensation {

/// Where a camera or a viewer stands: metres, or whatever a plan is drawn in, with any axes; in a plan
/// without heights the third is 0.
using Position = std::array<double, 3>;

bool isFinite(const Position& position);
/// Between any two of them; 0 of one or none.
double widestDistance(std::span<const Position> positions);

/// What the measured views count for a viewer who stands anywhere, from where their cameras stand: the place
/// in the cameras' convex hull that is nearest to him, made of those that are nearest to it,
///   w = argmin |sum_c w_c (x_c - v)|^2 + kappa (sum_c w_c |x_c - v|^2 / D)^2,     w >= 0, sum w = 1,
/// D the largest distance of two cameras, kappa 1e-6: almost the linear interpolation in the Delaunay simplex
/// of the place, which is the lower hull of the lifted points. Where a camera stands, that one alone; between
/// two, by the distances from both; outside the hull as at its border; very far away the nearest. One camera,
/// or all at one place: evenly. Continuous in v, and the same for every unit and axes.  Contract: there are
/// cameras; positions are finite. Source: core/compensation/README.md.
std::vector<double> viewerWeights(std::span<const Position> cameras, const Position& viewer);

/// What views count for a viewer which count `home` when nobody is followed: home times viewerWeights(), as
/// shares of their sum, and a thousandth of home's at the least. What only others see stays theirs: it costs
/// him nothing, and nothing jumps as he passes a camera. Empty: nothing is asked for where he stands.
///   home: 0 or more, one for each camera.
std::vector<double> followedWeights(std::span<const Position> cameras, std::span<const double> home,
                                    const Position& viewer);

/// Why nobody is meant who stands there: further from every camera than twice the widest distance of two,
/// which other units or another origin explain better. Empty: he may be, or the cameras are all at one place.
Message farFromCameras(std::span<const Position> cameras, const Position& viewer);

struct ViewerMotionSettings {
  std::chrono::duration<double> patience{2.0};  // without a word of the viewer he stays where he was
  std::chrono::duration<double> glide{1.0};     // time constant on the way back to the sweet spot
};
std::vector<Message> problems(const ViewerMotionSettings& settings);

/// A viewer whose position is told now and then.
///   a(t) = 1 until t_last + patience, then  exp(-(t - t_last - patience) / glide),  and 0 once below 1/1000
///   x(t) = s + a(t) (x_last - s)
/// Before anything is told he stands at the sweet spot s, and a is 0. Times are of one clock, and do not run
/// back.
class MovingViewer {
 public:
  using Time = std::chrono::duration<double>;

  explicit MovingViewer(const Position& sweetSpot = {}, const ViewerMotionSettings& settings = {});

  /// Positions that are not finite are not listened to: false.
  bool moveTo(const Position& position, Time now);
  Position at(Time now) const;
  /// a: how much the last position still holds.
  double presence(Time now) const;
  /// As it was told; none before.
  const std::optional<Position>& last() const { return last_; }
  /// At the sweet spot again at once.
  void leave() { last_.reset(); }

 private:
  Position sweetSpot_;
  ViewerMotionSettings settings_;
  std::optional<Position> last_;
  Time told_{0.0};
};

}  // namespace relucent::compensation
