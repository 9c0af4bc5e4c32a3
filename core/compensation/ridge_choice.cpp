// SPDX-License-Identifier: MIT
#include "relucent/compensation/ridge_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/image/dead_leaves.h"
#include "relucent/inverse/prepared_windows.h"

namespace relucent::compensation {
namespace {

constexpr double asGoodAs = 0.1;  // dB
constexpr int mostSteps = 4;      // factors of 2 either way
constexpr Size pictureSize{320, 240};

/// The targets of the trial pictures; none where no content fits.
std::vector<Target> trialTargets(const MeasuredVenue& venue) {
  std::vector<Target> targets;
  Size view = venue.transport.cameras().size(0);
  if (!largestUpright(placeable(venue), view, static_cast<double>(pictureSize.width) / pictureSize.height))
    return targets;
  for (std::uint64_t seed : {1, 2})
    targets.push_back(fitTarget(image::deadLeaves(pictureSize, seed), venue, TargetSettings::ofLight()));
  return targets;
}

/// The trials so far, by factors of 2 from the ridge that it starts at.
class Search {
 public:
  Search(const MeasuredVenue& venue, const inverse::WindowSettings& settings, std::vector<Target> targets,
         Progress& progress)
      : venue_(venue),
        startRidge_(settings.ridge),
        prepared_(venue.transport, venue.usable, settings, progress),
        targets_(std::move(targets)) {}

  double ridge(int step) const { return std::ldexp(startRidge_, step); }

  double trial(int step, Progress& progress) {
    Progress computing = progress.part(0.8, progress.stage());
    current_ = prepared_.inverse(ridge(step), computing);
    // Made once, it looks at `current_`, whichever windows these are.
    if (!compensator_) compensator_.emplace(venue_, current_);
    double sum = 0.0;
    for (const Target& target : targets_) {
      Progress solving = progress.part(0.2 / static_cast<double>(targets_.size()), progress.stage());
      Compensation compensation = compensator_->solve(Method::windows, target, solving);
      sum += predict(venue_, target, compensation).psnrReachable;
    }
    double psnr = sum / static_cast<double>(targets_.size());
    psnr_[step] = psnr;
    if (step == best()) kept_ = {step, std::move(current_)};
    return psnr;
  }

  int best() const {
    return std::max_element(psnr_.begin(), psnr_.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }
  int chosen() const {
    double enough = psnr_.at(best()) - asGoodAs;
    int step = best();
    for (const auto& [tried, psnr] : psnr_)
      if (psnr >= enough) step = std::max(step, tried);
    return step;
  }

  /// The windows of the step, from its trial where they were kept.
  inverse::WindowInverse take(int step, Progress& progress) {
    return kept_ && kept_->first == step ? std::move(kept_->second)
                                         : prepared_.inverse(ridge(step), progress);
  }
  std::vector<RidgeTrial> curve() const {
    std::vector<RidgeTrial> trials;
    for (const auto& [step, psnr] : psnr_) trials.push_back({ridge(step), psnr});
    return trials;
  }

 private:
  const MeasuredVenue& venue_;
  double startRidge_;
  inverse::PreparedWindows prepared_;
  std::vector<Target> targets_;
  inverse::WindowInverse current_;
  std::optional<Compensator> compensator_;
  std::map<int, double> psnr_;
  std::optional<std::pair<int, inverse::WindowInverse>> kept_;
};

}  // namespace

RidgeChoice chooseRidge(const MeasuredVenue& venue, const inverse::WindowSettings& settings,
                        Progress& progress) {
  std::vector<Target> targets = trialTargets(venue);
  if (targets.empty())
    return {settings.ridge, {}, inverse::computeWindows(venue.transport, venue.usable, settings, progress)};

  Progress preparing = progress.part(0.1, progress.stage());
  Search search(venue, settings, std::move(targets), preparing);
  // Nobody knows how many trials it takes: each gets a third of what is left.
  double left = 0.9;
  auto trial = [&](int step) {
    Progress part = progress.part(left / 3.0, progress.stage());
    left -= left / 3.0;
    return search.trial(step, part);
  };
  double start = trial(0);
  for (int direction : {1, -1}) {
    double before = start;
    for (int step = direction; std::abs(step) <= mostSteps; step += direction) {
      double psnr = trial(step);
      if (!(psnr > before)) break;
      before = psnr;
    }
    if (search.best() != 0) break;  // better this way: it will not be better the other way too
  }
  RidgeChoice choice{search.ridge(search.chosen()), search.curve(), {}};
  choice.inverse = search.take(search.chosen(), progress);
  progress.report(1.0);
  return choice;
}

}  // namespace relucent::compensation
