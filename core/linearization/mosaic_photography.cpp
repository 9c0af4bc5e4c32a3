// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic_photography.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/linearization/photographed_light.h"
#include "relucent/linearization/ramp_levels.h"
#include "relucent/linearization/response_forecast.h"
#include "relucent/linearization/test_light.h"
#include "relucent/linearization/thinning.h"
#include "relucent/rig/projector_names.h"

namespace relucent::linearization {
namespace {

// Of white, of a channel that cameras see: less may be noise that is cut off below zero.
constexpr double leastShare = 0.02;
constexpr double mostDim = 0.9;     // of flood light, over what longer exposures gain
constexpr double mostEarly = 0.75;  // of that, of levels that are shown before
constexpr double leastGain = 1.5;   // of longer exposures, to be worth it
constexpr int coarseBits = 8;       // of a linear camera

Message measuringCurves(const std::string& projectors) {
  return RELUCENT_MESSAGE("stage.measuring-brightness-curves", "Measuring the brightness curves of {}")
      .with(projectors);
}

/// Takes the photographs of all projectors.
class Photographer {
 public:
  Photographer(rig::ShotTaker& shots, const std::vector<hdr::CameraModel>& cameras,
               const ExposureChoice& choice, const LinearizationSettings& settings)
      : shots_(shots),
        cameras_(cameras),
        choice_(choice),
        thinning_(shots.rig().cameraRasters()),
        order_{shots.rig().projectors.size()} {
    const rig::Rig& rig = shots.rig();
    const std::size_t groups = mosaicGroupsOf(count());
    for (std::size_t p = 0; p < rig.projectors.size(); ++p) {
      result_.drives.push_back(rampLevels(settings, rig.projectors[p]->bits()));
      projectors_.push_back(
          {Mosaic(rig.projectors[p]->size(), Random{settings.seed, 7, p}, count() > 1, groups),
           LevelQueue(result_.drives.back().size(), groups, Random{settings.seed, 8, p}), std::nullopt});
    }
  }

  MosaicPhotographs run(rig::Shot blackBefore, Progress& progress) {
    result_.blackBefore = std::move(blackBefore);
    // Each projector's own; groups in white; the levels; white and black.
    const double ownShare = static_cast<double>(order_.own()),
                 together = 3.0 + std::ceil(3.0 * static_cast<double>(mostLevels()) /
                                            (static_cast<double>(order_.lights()) - 0.75)),
                 all = ownShare * static_cast<double>(count()) + together;
    for (std::size_t p = 0; p < count(); ++p) {
      const std::string name = shots_.rig().projectors[p]->name();
      Progress own = progress.part(ownShare / all, measuringCurves(name));
      photographLights(p, own);
      requireAllChannels(p, name, own);
    }
    Progress joint = progress.part(together / all, measuringCurves(rig::projectorNames(shots_.rig())));
    photographGroups(joint);
    photographLevels(together, joint);
    photographWhite(joint);
    const rig::Shot black = shots_.take(evenPatterns(shots_.rig(), {0, 0, 0}), choice_.dim, joint);
    result_.blackAfter = thinning_.of(black);
    return std::move(result_);
  }

 private:
  struct Measured {
    Mosaic mosaic;
    LevelQueue queue;
    std::optional<ResponseForecast> forecast;
  };

  std::size_t count() const { return shots_.rig().projectors.size(); }
  std::size_t full(std::size_t projector) const { return result_.drives[projector].size(); }
  std::size_t mostLevels() const {
    std::size_t most = 0;
    for (const std::vector<double>& drives : result_.drives) most = std::max(most, drives.size() - 1);
    return most;
  }
  MosaicShot dark() const { return {std::vector<MosaicLevels>(count(), MosaicLevels{}), 0.0}; }
  MosaicShot white(std::size_t projector) const {
    MosaicShot shot = dark();
    std::fill_n(shot.level[projector].begin(), order_.lights(), full(projector));
    return shot;
  }

  void take(MosaicShot what, const std::vector<double>& exposures, const Progress& progress) {
    std::vector<image::Image> patterns;
    for (std::size_t p = 0; p < count(); ++p) {
      MosaicDrive drive{};
      for (std::size_t q = 0; q < mosaicLights; ++q)
        drive[q] = what.level[p][q] > 0 ? result_.drives[p][what.level[p][q] - 1] : 0.0;
      patterns.push_back(projectors_[p].mosaic.pattern(drive));
    }
    keep(std::move(what), thinning_.of(shots_.take(patterns, exposures, progress)));
  }
  void keep(MosaicShot what, rig::Shot shot) {
    what.time = shot.id.number;
    result_.what.push_back(std::move(what));
    result_.shots.push_back(std::move(shot));
  }

  /// White of all projectors, as it was photographed to choose the exposures.
  rig::Shot firstWhite() const {
    std::optional<rig::Shot> taken = atExposures(choice_.whites, choice_.flood);
    require(taken.has_value(), "white was not photographed at the exposures for flood light");
    return *std::move(taken);
  }

  void photographLights(std::size_t projector, Progress& progress) {
    auto report = [&] {
      progress.report(static_cast<double>(result_.what.size() - order_.white(projector)) /
                      static_cast<double>(order_.own()));
    };
    // Of one projector alone, the cells make up all of white.
    if (count() == 1)
      keep(white(projector), firstWhite());
    else
      take(white(projector), choice_.flood, progress);
    report();
    // Where a light does not fall, there is hardly more than black: less than a code of a coarse camera,
    // which rounds all of it down. Longer exposures tell.
    const bool coarse = isCoarse();
    std::vector<double> floodAndDim = choice_.dim;
    for (double seconds : choice_.flood)
      if (std::ranges::count(floodAndDim, seconds) == 0) floodAndDim.push_back(seconds);
    for (std::size_t q = 0; q < order_.lights(); ++q) {
      MosaicShot light = dark();
      light.level[projector][q] = full(projector);
      take(light, coarse ? floodAndDim : choice_.flood, progress);
      report();
    }
  }

  void photographGroups(const Progress& progress) {
    MosaicShot groups = dark();
    for (std::size_t p = 0; p < count(); ++p) std::fill_n(groups.level[p].begin(), 3, full(p));
    take(groups, choice_.flood, progress);
  }

  bool isCoarse() const {
    const std::vector<rig::RawFrame>& frames = choice_.whites.front().frames.front();
    for (std::size_t camera = 0; camera < frames.size(); ++camera)
      if (frames[camera].bits > 0 && frames[camera].bits <= coarseBits &&
          cameras_[camera].response[0].isIdentity())
        return true;
    return false;
  }

  void requireAllChannels(std::size_t projector, const std::string& name, Progress& progress) const {
    Progress reading = progress.part(0.0, progress.stage());
    const PhotographedLight lights = photographedLight(result_, cameras_, thinning_.rasters(), reading);
    const std::vector<bool>& lit = lights.lit[projector];
    if (static_cast<double>(std::ranges::count(lit, true)) < 3.0 * static_cast<double>(order_.lights()))
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("linearization.white-not-measurable",
                                   "no camera can measure the white of this projector"),
          RELUCENT_ENGLISH_MESSAGE(
              "linearization.check-view-and-exposure",
              "check that its picture is in view and not overexposed: close the aperture or lower the gain"),
          name);
    std::array<double, 3> light{}, variance{};
    for (std::size_t i = 0; i < lights.at.size(); ++i) {
      if (!lit[i]) continue;
      double weight = 1.0 / lights.variance[order_.white(projector)][i];
      for (std::size_t q = 0; q < order_.lights(); ++q) {
        light[q % 3] += weight * lights.light[order_.light(projector, q)][i];
        variance[q % 3] += weight * weight * lights.variance[order_.light(projector, q)][i];
      }
    }
    const double all = light[0] + light[1] + light[2];
    for (std::size_t c = 0; c < 3; ++c) {
      if (light[c] > leastShare * all && light[c] > 5.0 * std::sqrt(variance[c])) continue;
      static constexpr std::array<const char*, 3> names{"red", "green", "blue"};
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("linearization.colour-not-seen",
                                           "no camera sees the {} light of this projector")
                      .with(names[c]),
                  RELUCENT_ENGLISH_MESSAGE(
                      "linearization.check-cable-and-colours",
                      "check its cable and colour settings, and that a camera looks at its picture"),
                  name);
    }
  }

  /// As far as is known, of full; 0 where no level is left.
  double nextLight(std::size_t projector, std::size_t channel) const {
    const std::size_t level = projectors_[projector].queue.next(channel);
    return level > 0 ? forecastOf(projector, channel, level) : 0.0;
  }
  double nextLight(std::size_t projector) const {
    return std::max({nextLight(projector, 0), nextLight(projector, 1), nextLight(projector, 2)});
  }
  double forecastOf(std::size_t projector, std::size_t channel, std::size_t level) const {
    const std::optional<ResponseForecast>& forecast = projectors_[projector].forecast;
    return forecast ? forecast->lightAt(channel, result_.drives[projector][level - 1]) : 1.0;
  }

  /// The channel with the fewest levels left has room for a full light.
  std::size_t referenceChannel(std::size_t projector) const {
    const LevelQueue& queue = projectors_[projector].queue;
    std::size_t found = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (std::pair(queue.left(c), nextLight(projector, c)) <
          std::pair(queue.left(found), nextLight(projector, found)))
        found = c;
    return found;
  }

  /// The projectors' own, the groups in white, and the last two mosaics.
  MosaicPhotographs lastPhotographs() const {
    constexpr std::size_t last = 2;
    const std::size_t first = order_.groupsInWhite() + 1;
    MosaicPhotographs result{result_.drives, {}, {}, {}, result_.blackBefore, {}};
    for (std::size_t m = 0; m < result_.what.size(); ++m) {
      if (m >= first && m + last < result_.what.size()) continue;
      result.what.push_back(result_.what[m]);
      result.shots.push_back(result_.shots[m]);
    }
    return result;
  }

  void forecast(Progress& progress) {
    Progress fitting = progress.part(0.0, progress.stage());  // each photograph has its share already
    const MosaicPhotographs last = lastPhotographs();
    const PhotographedLight lights = photographedLight(last, cameras_, thinning_.rasters(), fitting);
    const ShownLevels shown = shownLevels(last);
    std::vector<ResponseFit> fits =
        fitResponses(shown.drives, shown.what, productsOf(lights, [](std::size_t) { return true; }),
                     usualResponses(shown.drives), fitting);
    for (std::size_t p = 0; p < count(); ++p)
      projectors_[p].forecast.emplace(shown, p, std::move(fits[p].light));
  }

  void photographLevels(double expected, Progress& progress) {
    // Light that longer exposures make as bright as the flood image.
    const double dim = choice_.dimmerBy > leastGain ? mostDim / choice_.dimmerBy : 0.0;
    for (double taken = 1.0; std::ranges::any_of(projectors_, &LevelQueue::isOpen, &Measured::queue);
         ++taken) {
      bool bright = false;
      for (std::size_t p = 0; p < count(); ++p) bright = bright || nextLight(p) > dim;
      MosaicShot shot = dark();
      for (std::size_t p = 0; p < count(); ++p) {
        // The others' brighter levels come first.
        if (bright && nextLight(p) <= dim * mostEarly) continue;
        const std::size_t reference = referenceChannel(p);
        for (std::size_t c = 0; c < 3; ++c)
          projectors_[p].queue.show(
              shot.level[p], c, bright && c == reference, full(p),
              [&](std::size_t level) { return !bright || forecastOf(p, c, level) > dim * mostEarly; });
      }
      take(shot, bright ? choice_.flood : choice_.dim, progress);
      progress.report(std::min(1.0, taken / expected));
      if (bright) forecast(progress);
    }
  }

  void photographWhite(const Progress& progress) {
    const rig::Shot taken = shots_.take(evenPatterns(shots_.rig(), {1, 1, 1}), choice_.flood, progress);
    result_.white = {firstWhite(), thinning_.of(taken)};
    if (count() == 1) keep(white(0), result_.white.second);
  }

  rig::ShotTaker& shots_;
  const std::vector<hdr::CameraModel>& cameras_;
  const ExposureChoice& choice_;
  Thinning thinning_;
  MosaicOrder order_;
  std::vector<Measured> projectors_;
  MosaicPhotographs result_;
};

}  // namespace

MosaicPhotographs photographMosaics(rig::ShotTaker& shots, const std::vector<hdr::CameraModel>& cameras,
                                    const ExposureChoice& choice, rig::Shot blackBefore,
                                    const LinearizationSettings& settings, Progress& progress) {
  return Photographer(shots, cameras, choice, settings).run(std::move(blackBefore), progress);
}

}  // namespace relucent::linearization
