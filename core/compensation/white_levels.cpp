// SPDX-License-Identifier: MIT
#include "relucent/compensation/white_levels.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::compensation {

WhiteLevels::WhiteLevels(const MeasuredVenue& venue, const CameraMask& inside) {
  const Rasters& cameras = venue.transport.cameras();
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    std::vector<float>& most = most_.emplace_back();
    const std::size_t begin = cameras.offset(camera), end = begin + cameras.size(camera).count();
    for (std::size_t i = begin; i < end; ++i) {
      if (!inside[i] || !venue.usable[i]) continue;
      float least = venue.flood[3 * i] + venue.black[3 * i];
      for (std::size_t c = 1; c < 3; ++c)
        least = std::min(least, venue.flood[3 * i + c] + venue.black[3 * i + c]);
      most.push_back(least);
    }
    std::ranges::sort(most);
  }
}

bool WhiteLevels::isPossible(std::size_t view, double percentile) const {
  const std::vector<float>& most = most_[view];
  const auto share =
      static_cast<std::size_t>(std::ceil(percentile / 100.0 * static_cast<double>(most.size())));
  return !most.empty() && most[share > 0 ? share - 1 : 0] > 0.0f;
}

float WhiteLevels::at(std::span<const float> viewWeights, double percentile) const {
  require(viewWeights.size() == most_.size(), "{} weights of {} views", viewWeights.size(), most_.size());
  double all = 0.0, pixels = 0.0;
  float chosen = 0.0f;
  for (std::size_t camera = 0; camera < most_.size(); ++camera) {
    const auto count = static_cast<double>(most_[camera].size());
    if (!(viewWeights[camera] > 0.0f) || count == 0.0) continue;
    chosen = pixels == 0.0 ? most_[camera].back() : std::max(chosen, most_[camera].back());
    all += static_cast<double>(viewWeights[camera]) * count;
    pixels += count;
  }
  if (pixels == 0.0)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("compensation.corners-enclose-nothing-lit",
                                 "the corners of the content enclose no pixel that the projector lights"),
        RELUCENT_ENGLISH_MESSAGE("compensation.move-corners-into-lit-part",
                                 "move the corners into the lit part of the camera's view"));

  const double share = percentile / 100.0 * (all - all / pixels);
  const auto isPassed = [&](float level) {
    double passed = 0.0;
    for (std::size_t camera = 0; camera < most_.size(); ++camera)
      if (viewWeights[camera] > 0.0f)
        passed += static_cast<double>(viewWeights[camera]) *
                  static_cast<double>(std::ranges::upper_bound(most_[camera], level) - most_[camera].begin());
    return passed > share;
  };
  // Of each view's first pixel with which more than that share is passed, the first of all; else the last.
  for (std::size_t camera = 0; camera < most_.size(); ++camera) {
    if (!(viewWeights[camera] > 0.0f)) continue;
    const auto first =
        std::ranges::partition_point(most_[camera], [&](float level) { return !isPassed(level); });
    if (first != most_[camera].end()) chosen = std::min(chosen, *first);
  }
  if (!(chosen > 0.0f))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("compensation.colour-hardly-seen",
                                 "some colour of the projector hardly reaches the camera within the content"),
        RELUCENT_ENGLISH_MESSAGE("compensation.move-corners-into-lit-part",
                                 "move the corners into the lit part of the camera's view"));
  return chosen;
}

}  // namespace relucent::compensation
