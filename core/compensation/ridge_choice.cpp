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
  if (!automaticCorners(venue, static_cast<double>(pictureSize.width) / pictureSize.height)) return targets;
  for (std::uint64_t seed : {1, 2})
    targets.push_back(fitTarget(image::deadLeaves(pictureSize, seed), venue, TargetSettings::ofLight()));
  return targets;
}

/// Where ridges are tried: everywhere, or in squares of tiles all over the projectors.
struct Trials {
  std::vector<std::uint32_t> tiles, others;  // ascending; no others: everywhere
  CameraMask judged;                         // per camera pixel: where it was tried; empty: everywhere
};

/// Every n-th square of every n-th row of squares, n the largest that leaves so many tiles; `windows` without
/// weights. What is next to other ridges' tiles is not judged: pixels that these have a use for.
Trials trialsIn(const inverse::WindowArrays& windows, std::size_t cameraPixels, std::size_t triedTiles) {
  constexpr int side = 8;  // tiles of a square: several times as far as a window reaches
  const Rasters& grids = *windows.tiles;
  const int every = static_cast<int>(std::sqrt(static_cast<double>(grids.count()) /
                                               static_cast<double>(std::max<std::size_t>(1, triedTiles))));
  Trials trials;
  for (std::size_t projector = 0; projector < grids.devices(); ++projector)
    for (std::size_t local = 0; local < grids.size(projector).count(); ++local) {
      const Pixel place = pixelAt(grids.size(projector), local);
      const bool isTried =
          every < 2 || (place.x / side % every == every / 2 && place.y / side % every == every / 2);
      (isTried ? trials.tiles : trials.others)
          .push_back(static_cast<std::uint32_t>(grids.offset(projector) + local));
    }
  if (trials.others.empty()) return trials;
  trials.judged = CameraMask(cameraPixels);
  const auto mark = [&](const std::vector<std::uint32_t>& tiles, std::uint8_t value) {
    for (std::uint32_t tile : tiles)
      for (std::size_t k = windows.start[tile]; k < windows.start[tile + 1]; ++k)
        trials.judged[windows.row[k]] = value;
  };
  mark(trials.tiles, 1);
  mark(trials.others, 0);
  return trials;
}

/// The target as it is judged there, if enough of it is.
std::optional<Target> judgedIn(const CameraMask& judged, const Target& target, const Rasters& cameras) {
  constexpr std::ptrdiff_t enough = 4096;  // of fewer, the best ridge is a matter of chance
  Target there = target;
  for (std::size_t i = 0; i < judged.size(); ++i)
    if (judged[i] == 0) there.inside[i] = there.reachable[i] = 0;
  const auto first = there.reachable.begin();
  const auto reached =
      std::ranges::count_if(first, first + static_cast<std::ptrdiff_t>(cameras.size(0).count()),
                            [](std::uint8_t is) { return is != 0; });
  return reached < enough ? std::nullopt : std::optional(std::move(there));
}

/// The trials so far, by factors of 2 from the ridge that it starts at.
class Search {
 public:
  Search(const MeasuredVenue& venue, const inverse::WindowSettings& settings, std::vector<Target> targets,
         std::size_t triedTiles, Progress& progress)
      : venue_(venue),
        startRidge_(settings.ridge),
        prepared_(venue.transport, venue.usable, settings, progress),
        targets_(std::move(targets)) {
    const Rasters& cameras = venue.transport.cameras();
    trials_ = trialsIn(prepared_.view(), cameras.count(), triedTiles);
    for (const Target& target : targets_) {
      if (trials_.others.empty()) break;
      if (std::optional<Target> judged = judgedIn(trials_.judged, target, cameras))
        judged_.push_back(std::move(*judged));
      else
        trials_ = trialsIn(prepared_.view(), cameras.count(), prepared_.allTiles().size());
    }
    if (trials_.others.empty()) judged_ = targets_;
    // Where some places are enough, so is one picture.
    if (!trials_.others.empty()) targets_.resize(1);
  }

  double ridge(int step) const { return std::ldexp(startRidge_, step); }

  /// The first is that of the start.
  double trial(int step, Progress& progress) {
    Progress computing = progress.part(0.8, progress.stage());
    if (psnr_.empty())
      windows_ = prepared_.inverse(ridge(step), computing);
    else
      prepared_.renew(windows_, ridge(step), trials_.tiles, computing);
    last_ = step;
    // Made once, it looks at `windows_`, whichever weights these have.
    if (!compensator_) compensator_.emplace(venue_, windows_);
    double sum = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      Progress solving = progress.part(0.2 / static_cast<double>(targets_.size()), progress.stage());
      Compensation compensation = compensator_->solve(Method::windows, targets_[i], solving);
      sum += predict(venue_, judged_[i], compensation).psnrReachable;
    }
    double psnr = sum / static_cast<double>(targets_.size());
    psnr_[step] = psnr;
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

  /// The windows of the step, and the end of the trials: what has another ridge is made again.
  inverse::WindowInverse take(int step, Progress& progress) {
    if (last_ != step) {
      Progress tried = progress.part(0.5, progress.stage());
      prepared_.renew(windows_, ridge(step), trials_.tiles, tried);
    }
    if (step != 0) {
      Progress others = progress.part(0.5, progress.stage());
      prepared_.renew(windows_, ridge(step), trials_.others, others);
    }
    return std::move(windows_);
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
  std::vector<Target> targets_, judged_;
  Trials trials_;
  inverse::WindowInverse windows_;
  std::optional<Compensator> compensator_;
  std::map<int, double> psnr_;
  int last_ = 0;
};

}  // namespace

RidgeChoice chooseRidge(const MeasuredVenue& venue, const inverse::WindowSettings& settings,
                        Progress& progress, std::size_t triedTiles) {
  std::vector<Target> targets = trialTargets(venue);
  if (targets.empty())
    return {settings.ridge, {}, inverse::computeWindows(venue.transport, venue.usable, settings, progress)};

  Progress preparing = progress.part(0.1, progress.stage());
  Search search(venue, settings, std::move(targets), triedTiles, preparing);
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
