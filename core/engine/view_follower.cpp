// SPDX-License-Identifier: MIT
#include "relucent/engine/view_follower.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/stacks.h"

namespace relucent::engine {
namespace {

/// Each is as large as the words of all projectors and the pictures of all cameras.
constexpr std::size_t mostKept = 8;

CameraMask insideOf(const EngineContent& content, std::size_t pixels) {
  CameraMask inside(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    inside[i] =
        content.warp.inside(i) && (content.masked.empty() || content.masked[i] < compensation::fullyMasked);
  return inside;
}

}  // namespace

ViewFollower::ViewFollower(const EngineVenue& engine, const EngineContent& content)
    : engine_(engine),
      white_(engine.venue, insideOf(content, engine.venue.usable.size())),
      correspondence_(engine.venue.transport, seesProjection(engine.venue),
                      compensation::DirectLightSettings{}) {
  target_.inside = insideOf(content, engine.venue.usable.size());
  target_.placements = content.placements;
  target_.masked = content.masked;
  for (std::size_t view = 0; view < content.viewWeight.size(); ++view)
    shows_.push_back(white_.isPossible(view, content.target.reachablePercentile));
}

const ViewFollower::Lit& ViewFollower::litFor(const std::vector<bool>& views) {
  if (const auto known = lit_.find(views); known != lit_.end()) return known->second;
  if (lit_.size() == mostKept) lit_.clear();
  compensation::ContentCorrespondence found = correspondence_.of(target_);
  const auto full = compensation::stackOf<ProjectorStack>(
      3 * found.free.size(), [&](std::size_t j) { return found.free[j / 3] ? 1.0f : 0.0f; });
  Lit lit{std::move(found.free), std::move(found.brightest), engine_.venue.transport.apply(full),
          ++versions_};
  return lit_.emplace(views, std::move(lit)).first->second;
}

std::vector<double> ViewFollower::weightsFor(std::span<const compensation::Position> cameras,
                                             std::span<const double> home, std::span<const double> rest,
                                             const compensation::Position& viewer, double presence) const {
  std::vector<double> shown(home.begin(), home.end());
  for (std::size_t view = 0; view < shown.size(); ++view)
    if (!shows(view)) shown[view] = 0.0;
  std::vector<double> weights = compensation::followedWeights(cameras, shown, viewer);
  const double all = std::reduce(rest.begin(), rest.end());
  for (std::size_t view = 0; view < weights.size(); ++view)
    weights[view] = presence * weights[view] + (1.0 - presence) * rest[view] / all;
  return weights;
}

void ViewFollower::follow(std::span<const double> weights, EngineContent& content) {
  const Rasters& cameras = engine_.venue.transport.cameras();
  const double most = weights.empty() ? 0.0 : std::ranges::max(weights);
  require(weights.size() == cameras.devices() && most > 0.0, "{} weights, at most {}, of {} views",
          weights.size(), most, cameras.devices());
  std::vector<bool> asked;
  content.viewWeight.clear();
  for (double weight : weights) {
    content.viewWeight.push_back(static_cast<float>(weight / most));
    asked.push_back(content.viewWeight.back() > 0.0f);
  }
  target_.viewWeight = content.viewWeight;
  content.white = white_.at(content.viewWeight, content.target.reachablePercentile);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera), end = begin + cameras.size(camera).count();
    parallelFor(begin, end, 16384, [&](std::size_t i) {
      content.weight[i] =
          content.viewWeight[camera] * compensation::relianceOn(engine_.venue, i) * content.unmaskedShare(i);
    });
  }
  const Lit& lit = litFor(asked);
  if (content.freeVersion == lit.version) return;
  content.free = lit.free;
  content.brightest = lit.brightest;
  content.lit = lit.lit;
  content.freeVersion = lit.version;
  // Where somebody stands in it besides, AvailabilityFollower finds what is missing.
  if (!content.kept.empty() && content.available == content.kept)
    content.missing = missingLight(engine_, content.free, content.kept);
}

}  // namespace relucent::engine
