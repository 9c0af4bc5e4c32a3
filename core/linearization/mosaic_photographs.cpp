// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic_photographs.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/hdr/isotonic.h"
#include "relucent/linearization/test_light.h"

namespace relucent::linearization {
namespace {

constexpr std::size_t mostPixels = 100000;  // of all cameras, that are evaluated
constexpr double leastLight = 0.02;         // of the 99th percentile of white, of values that are evaluated
// Of white, of a channel that cameras see: less may be noise that is cut off below zero.
constexpr double leastShare = 0.02;
constexpr double mostDim = 0.9;          // of flood light, over what longer exposures gain
constexpr double mostEarly = 0.75;       // of that, of levels that are shown before
constexpr double leastGain = 1.5;        // of longer exposures, to be worth it
constexpr int coarseBits = 8;            // of a linear camera
constexpr double fewestInRegion = 60.0;  // values
constexpr double leastPart = 0.15;       // of the light of all projectors
constexpr double certain = 6.0;          // deviations

// Of one projector alone: white and its nine lights. After all of them one of all first groups in white.
constexpr std::size_t ownPhotographs = 1 + mosaicLights;

std::size_t whiteOf(std::size_t projector) {
  return projector * ownPhotographs;
}
std::size_t lightOf(std::size_t projector, std::size_t light) {
  return whiteOf(projector) + 1 + light;
}
std::size_t groupsOf(std::size_t projectors) {
  return projectors * ownPhotographs;
}

std::size_t divided(std::size_t a, std::size_t b) {
  return (a + b - 1) / b;
}

/// Photographs less black, at the values that all of them show.
struct Lights {
  std::vector<std::size_t> at;                       // which values
  std::vector<std::vector<double>> light, variance;  // [photograph][value]
  std::vector<std::vector<bool>> lit;                // [projector][value]: by more than noise could

  /// Of every projector's white.
  double whiteVariance(std::size_t value) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < lit.size(); ++p) sum += variance[whiteOf(p)][value];
    return sum;
  }
};

/// Values that white raises by more than noise could.
std::vector<bool> litBy(const hdr::HdrFrame& white, const hdr::HdrFrame& black) {
  std::vector<float> rise(white.radiance.size());
  for (std::size_t i = 0; i < rise.size(); ++i) rise[i] = white.radiance[i] - black.radiance[i];
  std::vector<float> sorted = rise;
  auto high = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
  std::nth_element(sorted.begin(), high, sorted.end());
  std::vector<bool> lit;
  for (std::size_t i = 0; i < rise.size(); ++i) {
    double light = rise[i], noise = std::sqrt(static_cast<double>(white.variance[i] + black.variance[i]));
    lit.push_back(light > leastLight * static_cast<double>(*high) && light > 5.0 * noise);
  }
  return lit;
}

Lights lightsOf(const MosaicPhotographs& photographs, const std::vector<hdr::CameraModel>& cameras,
                const Rasters& rasters) {
  std::vector<hdr::HdrFrame> frames;
  for (const rig::Shot& shot : photographs.shots) frames.push_back(hdr::mergeBracket(shot, cameras, rasters));
  const hdr::HdrFrame before = hdr::mergeBracket(photographs.blackBefore, cameras, rasters),
                      after = photographs.blackAfter.frames.empty()
                                  ? before
                                  : hdr::mergeBracket(photographs.blackAfter, cameras, rasters);
  const double begin = photographs.blackBefore.id.number,
               end = std::max<double>(begin + 1.0, photographs.blackAfter.id.number);

  // While they are being taken, some projectors' own are still missing.
  const std::size_t projectors = std::min(photographs.drives.size(), frames.size() / ownPhotographs);
  std::vector<std::vector<bool>> lit;
  for (std::size_t p = 0; p < projectors; ++p) lit.push_back(litBy(frames[whiteOf(p)], before));

  Lights lights;
  lights.lit.resize(projectors);
  for (std::size_t i = 0; i < before.valid.size(); ++i) {
    bool usable = before.valid[i] != 0;
    for (const hdr::HdrFrame& frame : frames) usable = usable && frame.valid[i] != 0;
    if (!usable || std::ranges::none_of(lit, [i](const std::vector<bool>& by) { return by[i]; })) continue;
    lights.at.push_back(i);
    for (std::size_t p = 0; p < projectors; ++p) lights.lit[p].push_back(lit[p][i]);
  }
  for (std::size_t m = 0; m < frames.size(); ++m) {
    double share = std::clamp((photographs.what[m].time - begin) / (end - begin), 0.0, 1.0);
    std::vector<double>& light = lights.light.emplace_back();
    std::vector<double>& variance = lights.variance.emplace_back();
    for (std::size_t i : lights.at) {
      double last = after.valid[i] != 0 ? static_cast<double>(after.radiance[i])
                                        : static_cast<double>(before.radiance[i]);
      double black = static_cast<double>(before.radiance[i]);
      black += share * (last - black);
      light.push_back(static_cast<double>(frames[m].radiance[i]) - black);
      variance.push_back(static_cast<double>(frames[m].variance[i]));
    }
  }
  return lights;
}

/// Products of the values that `wanted` says.
template <typename Wanted>
LightProducts productsOf(const Lights& lights, const Wanted& wanted) {
  LightProducts products(lights.light.size());
  std::vector<double> light(lights.light.size()), variance(lights.light.size());
  for (std::size_t i = 0; i < lights.at.size(); ++i) {
    if (!wanted(lights.at[i])) continue;
    for (std::size_t m = 0; m < light.size(); ++m) {
      light[m] = lights.light[m][i];
      variance[m] = lights.variance[m][i];
    }
    products.add(light, variance, 1.0 / lights.whiteVariance(i));
  }
  return products;
}

/// The levels that photographs show, and the photographs in terms of these alone.
struct Shown {
  std::vector<std::vector<double>> drives;  // per projector
  std::vector<MosaicShot> what;
};
Shown shownBy(const MosaicPhotographs& photographs) {
  Shown shown{{}, photographs.what};
  for (std::size_t p = 0; p < photographs.drives.size(); ++p) {
    const std::vector<double>& all = photographs.drives[p];
    std::vector<bool> used(all.size() + 1, false);
    used.back() = true;
    for (const MosaicShot& shot : photographs.what)
      for (std::size_t level : shot.level[p]) used[level] = true;
    std::vector<std::size_t> place(used.size(), 0);
    std::vector<double>& drives = shown.drives.emplace_back();
    for (std::size_t level = 1; level < used.size(); ++level) {
      if (!used[level]) continue;
      drives.push_back(all[level - 1]);
      place[level] = drives.size();
    }
    for (MosaicShot& shot : shown.what)
      for (std::size_t& level : shot.level[p]) level = place[level];
  }
  return shown;
}

std::vector<LevelLights> usualLights(const std::vector<std::vector<double>>& drives) {
  std::vector<LevelLights> start(drives.size());
  for (std::size_t p = 0; p < drives.size(); ++p)
    for (std::vector<double>& channel : start[p])
      for (double drive : drives[p]) channel.push_back(std::pow(drive, 2.2));
  return start;
}

/// What is known of a response while it is being measured: enough to tell how bright a level will be.
class Forecast {
 public:
  Forecast(const Shown& shown, std::size_t projector, LevelLights light)
      : drives_(shown.drives[projector]), light_(std::move(light)) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<bool>& seen = seen_[c];
      seen.assign(drives_.size(), false);
      seen.back() = true;
      for (const MosaicShot& shot : shown.what)
        for (std::size_t group = 0; group < mosaicGroups; ++group)
          if (std::size_t level = shot.level[projector][3 * group + c]; level > 0) seen[level - 1] = true;
    }
  }

  /// As the power law between the two lowest levels that were seen goes on.
  double lightOf(std::size_t channel, double drive) const {
    std::optional<std::size_t> low, next;
    for (std::size_t k = drives_.size(); k-- > 0;) {
      if (!seen_[channel][k]) continue;
      next = low;
      low = k;
    }
    if (!next) return 1.0;
    double dark = std::max(light_[channel][*low], 1e-6), bright = std::max(light_[channel][*next], 1e-6);
    double exponent =
        std::clamp(std::log(bright / dark) / std::log(drives_[*next] / drives_[*low]), 0.3, 6.0);
    return dark * std::pow(drive / drives_[*low], exponent);
  }

 private:
  std::vector<double> drives_;
  LevelLights light_;
  std::array<std::vector<bool>, 3> seen_;
};

/// Which levels to show next.
class LevelQueue {
 public:
  LevelQueue(std::size_t levels, Random random) : random_(random) {
    for (std::deque<std::size_t>& channel : open_)
      for (std::size_t level = levels; level-- > 1;) channel.push_back(level);
  }

  bool isOpen() const {
    return std::ranges::any_of(open_, [](const auto& channel) { return !channel.empty(); });
  }
  /// The highest of a channel that is still open; 0: none.
  std::size_t next(std::size_t channel) const { return open_[channel].empty() ? 0 : open_[channel].front(); }
  std::size_t left(std::size_t channel) const { return open_[channel].size(); }

  /// One channel's next levels in random groups, while `wanted` says so; one group is full if `reference`.
  template <typename Wanted>
  void show(MosaicLevels& levels, std::size_t channel, bool reference, std::size_t full,
            const Wanted& wanted) {
    std::array<std::size_t, mosaicGroups> groups{};
    for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = i;
    for (std::size_t i = groups.size(); i > 1; --i) std::swap(groups[i - 1], groups[random_.below(i)]);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      std::size_t& level = levels[3 * groups[i] + channel];
      if (i == 0 && reference)
        level = full;
      else if (!open_[channel].empty() && wanted(channel, open_[channel].front())) {
        level = open_[channel].front();
        open_[channel].pop_front();
      }
    }
  }

 private:
  std::array<std::deque<std::size_t>, 3> open_;
  Random random_;
};

Message measuringCurves(const std::string& projectors) {
  return RELUCENT_MESSAGE("stage.measuring-brightness-curves", "Measuring the brightness curves of {}")
      .with(projectors);
}

/// Takes the photographs of all projectors.
class Photographer {
 public:
  Photographer(rig::ShotTaker& shots, const std::vector<hdr::CameraModel>& cameras,
               const ExposureChoice& choice, const LinearizationSettings& settings)
      : shots_(shots), cameras_(cameras), choice_(choice), thinning_(shots.rig().cameraRasters()) {
    const rig::Rig& rig = shots.rig();
    for (std::size_t p = 0; p < rig.projectors.size(); ++p) {
      result_.drives.push_back(rampLevels(settings, rig.projectors[p]->bits()));
      projectors_.push_back({Mosaic(rig.projectors[p]->size(), Random{settings.seed, 7, p}, count() > 1),
                             LevelQueue(result_.drives.back().size(), Random{settings.seed, 8, p}),
                             std::nullopt});
    }
  }

  MosaicPhotographs run(rig::Shot blackBefore, Progress& progress) {
    result_.blackBefore = std::move(blackBefore);
    // Each projector's own; groups in white; the levels; white and black.
    const double ownShare = static_cast<double>(ownPhotographs),
                 together = 3.0 + std::ceil(static_cast<double>(mostLevels()) / 2.75),
                 all = ownShare * static_cast<double>(count()) + together;
    for (std::size_t p = 0; p < count(); ++p) {
      const std::string name = shots_.rig().projectors[p]->name();
      Progress own = progress.part(ownShare / all, measuringCurves(name));
      photographLights(p, own);
      requireAllChannels(p, name);
    }
    Progress joint = progress.part(together / all, measuringCurves(namesOf(shots_.rig())));
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
    std::optional<Forecast> forecast;
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
    shot.level[projector].fill(full(projector));
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
      progress.report(static_cast<double>(result_.what.size() - whiteOf(projector)) /
                      static_cast<double>(ownPhotographs));
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
    for (std::size_t q = 0; q < mosaicLights; ++q) {
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

  void requireAllChannels(std::size_t projector, const std::string& name) const {
    const Lights lights = lightsOf(result_, cameras_, thinning_.rasters());
    const std::vector<bool>& lit = lights.lit[projector];
    if (static_cast<double>(std::ranges::count(lit, true)) < 3.0 * static_cast<double>(mosaicLights))
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
      double weight = 1.0 / lights.variance[whiteOf(projector)][i];
      for (std::size_t q = 0; q < mosaicLights; ++q) {
        light[q % 3] += weight * lights.light[lightOf(projector, q)][i];
        variance[q % 3] += weight * weight * lights.variance[lightOf(projector, q)][i];
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
    const std::optional<Forecast>& forecast = projectors_[projector].forecast;
    return forecast ? forecast->lightOf(channel, result_.drives[projector][level - 1]) : 1.0;
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
    const std::size_t first = groupsOf(count()) + 1;
    MosaicPhotographs result{result_.drives, {}, {}, {}, result_.blackBefore, {}};
    for (std::size_t m = 0; m < result_.what.size(); ++m) {
      if (m >= first && m + last < result_.what.size()) continue;
      result.what.push_back(result_.what[m]);
      result.shots.push_back(result_.shots[m]);
    }
    return result;
  }

  void forecast() {
    const MosaicPhotographs last = lastPhotographs();
    const Lights lights = lightsOf(last, cameras_, thinning_.rasters());
    const Shown shown = shownBy(last);
    std::vector<ResponseFit> fits =
        fitResponses(shown.drives, shown.what, productsOf(lights, [](std::size_t) { return true; }),
                     usualLights(shown.drives));
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
          projectors_[p].queue.show(shot.level[p], c, bright && c == reference, full(p),
                                    [&](std::size_t channel, std::size_t level) {
                                      return !bright || forecastOf(p, channel, level) > dim * mostEarly;
                                    });
      }
      take(shot, bright ? choice_.flood : choice_.dim, progress);
      progress.report(std::min(1.0, taken / expected));
      if (bright) forecast();
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
  std::vector<Measured> projectors_;
  MosaicPhotographs result_;
};

hdr::ResponseCurve curveOf(const std::vector<double>& drives, const std::vector<double>& light,
                           const std::vector<double>& deviation) {
  std::vector<double> x{0.0}, y{0.0}, weights{0.0};
  double most = 0.0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    x.push_back(drives[i]);
    y.push_back(light[i]);
    weights.push_back(1.0 / std::pow(std::max(deviation[i], 1e-7), 2.0));
    if (i + 1 < drives.size()) most = std::max(most, weights.back());
  }
  // Black is the zero and full drive the one by definition, not by measurements.
  weights.front() = weights.back() = 100.0 * std::max(most, 1.0);
  return hdr::curveFromRamp(x, y, weights);
}

/// Sums of every photograph over values that `wanted` says.
template <typename Wanted>
std::vector<ChannelSums> sumsOf(const Lights& lights, const Wanted& wanted) {
  std::vector<ChannelSums> sums(lights.light.size(), ChannelSums{});
  for (std::size_t m = 0; m < sums.size(); ++m)
    for (std::size_t i = 0; i < lights.at.size(); ++i)
      if (wanted(i)) sums[m][lights.at[i] % 3] += lights.light[m][i];
  return sums;
}

/// What sums say of the additivity of projectors' light, the drift of their lamps divided out.
class Additivities {
 public:
  Additivities(const MosaicPhotographs& photographs, const Lights& lights,
               const std::vector<ResponseFit>& fits)
      : photographs_(photographs), lights_(lights), fits_(fits) {}

  /// White where each projector shines; its first group where that is the brightest of all first groups.
  std::vector<Additivity> run() const {
    const std::vector<std::size_t> brightest = brightestGroups();
    std::vector<Groups> groups;
    for (std::size_t p = 0; p < fits_.size(); ++p) groups.push_back(groupsAt(p, brightest));
    takeOffOthers(groups);
    std::vector<Additivity> result;
    for (std::size_t p = 0; p < fits_.size(); ++p) {
      const auto sums = sumsOf(lights_, [&](std::size_t i) { return lights_.lit[p][i]; });
      result.push_back(additivityOf(inUnits(sums, p, whiteOf(p)), lightsOf(sums, p, mosaicLights),
                                    groups[p].inWhite, groups[p].lights[p]));
    }
    return result;
  }

 private:
  /// At one projector's place, in units of its lamp.
  struct Groups {
    ChannelSums inWhite{};            // all first groups
    std::vector<ChannelSums> lights;  // of each projector's first group, one by one
  };

  double lampIn(std::size_t projector, std::size_t shot) const {
    return 1.0 + fits_[projector].drift *
                     (photographs_.what[shot].time - photographs_.what[whiteOf(projector)].time);
  }
  ChannelSums inUnits(const std::vector<ChannelSums>& sums, std::size_t projector, std::size_t shot) const {
    ChannelSums result = sums[shot];
    for (double& sum : result) sum /= lampIn(projector, shot);
    return result;
  }
  ChannelSums lightsOf(const std::vector<ChannelSums>& sums, std::size_t projector, std::size_t count) const {
    ChannelSums result{};
    for (std::size_t q = 0; q < count; ++q) {
      const ChannelSums light = inUnits(sums, projector, lightOf(projector, q));
      for (std::size_t c = 0; c < 3; ++c) result[c] += light[c];
    }
    return result;
  }

  std::vector<std::size_t> brightestGroups() const {
    std::vector<std::size_t> brightest;
    for (std::size_t i = 0; i < lights_.at.size(); ++i) {
      std::vector<double> light(fits_.size(), 0.0);
      for (std::size_t p = 0; p < light.size(); ++p)
        for (std::size_t q = 0; q < 3; ++q) light[p] += lights_.light[lightOf(p, q)][i];
      brightest.push_back(static_cast<std::size_t>(std::ranges::max_element(light) - light.begin()));
    }
    return brightest;
  }

  Groups groupsAt(std::size_t projector, const std::vector<std::size_t>& brightest) const {
    const std::size_t shot = groupsOf(fits_.size());
    const auto sums = sumsOf(
        lights_, [&](std::size_t i) { return brightest[i] == projector && lights_.lit[projector][i]; });
    Groups groups{inUnits(sums, projector, shot), {}};
    for (std::size_t p = 0; p < fits_.size(); ++p) {
      groups.lights.push_back(lightsOf(sums, p, 3));
      for (double& light : groups.lights.back()) light *= lampIn(p, shot) / lampIn(projector, shot);
    }
    return groups;
  }

  /// Takes off what the other groups add at each one's place, which their own places tell:
  ///   in white_p = sum_o e_o lights_po,   p the places, o the projectors,   solved for e.
  static void takeOffOthers(std::vector<Groups>& groups) {
    const auto count = static_cast<Eigen::Index>(groups.size());
    auto at = [&groups](Eigen::Index p) -> Groups& { return groups[static_cast<std::size_t>(p)]; };
    for (std::size_t c = 0; c < 3; ++c) {
      Eigen::MatrixXd lights(count, count);
      Eigen::VectorXd inWhite(count);
      for (Eigen::Index p = 0; p < count; ++p) {
        inWhite[p] = at(p).inWhite[c];
        for (Eigen::Index o = 0; o < count; ++o) lights(p, o) = at(p).lights[static_cast<std::size_t>(o)][c];
      }
      const Eigen::VectorXd excess = lights.completeOrthogonalDecomposition().solve(inWhite);
      for (Eigen::Index p = 0; p < count; ++p)
        for (Eigen::Index o = 0; o < count; ++o)
          if (o != p) at(p).inWhite[c] -= excess[o] * lights(p, o);
    }
  }

  const MosaicPhotographs& photographs_;
  const Lights& lights_;
  const std::vector<ResponseFit>& fits_;
};

/// A projector's white in one region.
struct RegionLight {
  double values = 0.0;  // that it lights
  double light = 0.0;
};

std::vector<RegionLight> regionLights(const Lights& lights, std::size_t projector, const Thinning& thinning) {
  std::vector<RegionLight> regions(thinning.regions());
  for (std::size_t i = 0; i < lights.at.size(); ++i) {
    RegionLight& region = regions[thinning.regionOf(lights.at[i] / 3)];
    region.light += lights.light[whiteOf(projector)][i];
    if (lights.lit[projector][i]) region.values += 1.0;
  }
  return regions;
}

/// Whether a projector lights regions [first, end) enough to tell its response from what is not exactly known
/// of the others'. `lights`: [projector][region].
bool shinesIn(const std::vector<std::vector<RegionLight>>& lights, std::size_t projector, std::size_t first,
              std::size_t end) {
  double values = 0.0, own = 0.0, all = 0.0;
  for (std::size_t region = first; region < end; ++region) {
    values += lights[projector][region].values;
    own += lights[projector][region].light;
    for (const std::vector<RegionLight>& each : lights) all += each[region].light;
  }
  return values >= fewestInRegion && own >= leastPart * all;
}

}  // namespace

std::string namesOf(const rig::Rig& rig) {
  std::string names;
  for (const auto& projector : rig.projectors) names += (names.empty() ? "" : ", ") + projector->name();
  return names;
}

Thinning::Thinning(const Rasters& cameras)
    : cameras_(cameras), stride_(std::max<std::size_t>(1, divided(cameras.count(), mostPixels))) {
  std::vector<Size> sizes;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    Size size = cameras.size(camera);
    sizes.push_back({static_cast<int>(divided(size.count(), stride_)), 1});
    for (std::size_t i = 0; i < size.count(); i += stride_) {
      Pixel pixel = pixelAt(size, i);
      regions_.push_back(9 * camera +
                         static_cast<std::size_t>(3 * pixel.y / size.height * 3 + 3 * pixel.x / size.width));
    }
  }
  thin_ = Rasters(std::move(sizes));
}

rig::Shot Thinning::of(const rig::Shot& shot) const {
  rig::Shot result{shot.id, shot.fingerprint, {}, shot.exposuresAsked};
  for (const std::vector<rig::RawFrame>& exposure : shot.frames) {
    std::vector<rig::RawFrame>& frames = result.frames.emplace_back();
    for (std::size_t camera = 0; camera < exposure.size(); ++camera) {
      const rig::RawFrame& frame = exposure[camera];
      rig::RawFrame& thin =
          frames.emplace_back(rig::RawFrame{image::Image(thin_.size(camera), 3), frame.bits, frame.seconds});
      for (std::size_t i = 0; i < thin.signal.pixels(); ++i)
        std::ranges::copy(frame.signal.pixel(i * stride_), thin.signal.pixel(i).begin());
    }
  }
  return result;
}

std::vector<double> rampLevels(const LinearizationSettings& settings, int bits) {
  double codes = std::ldexp(1.0, bits) - 1.0;
  std::vector<double> levels;
  for (int k = 1; k < settings.levels; ++k) {
    double drive = std::pow(static_cast<double>(k) / (settings.levels - 1), settings.shadowPower);
    double code = std::round(drive * codes);
    if (code > 0.0 && (levels.empty() || code / codes > levels.back())) levels.push_back(code / codes);
  }
  return levels;
}

MosaicPhotographs photographMosaics(rig::ShotTaker& shots, const std::vector<hdr::CameraModel>& cameras,
                                    const ExposureChoice& choice, rig::Shot blackBefore,
                                    const LinearizationSettings& settings, Progress& progress) {
  return Photographer(shots, cameras, choice, settings).run(std::move(blackBefore), progress);
}

std::vector<MosaicResult> evaluate(const MosaicPhotographs& photographs,
                                   const std::vector<hdr::CameraModel>& cameras, const Thinning& thinning) {
  const Lights lights = lightsOf(photographs, cameras, thinning.rasters());
  std::vector<LightProducts> regions;
  for (std::size_t region = 0; region < thinning.regions(); ++region)
    regions.push_back(
        productsOf(lights, [&](std::size_t at) { return thinning.regionOf(at / 3) == region; }));
  auto sumOf = [&](std::size_t first, std::size_t end) {
    LightProducts sum(photographs.what.size());
    for (std::size_t region = first; region < end; ++region) sum += regions[region];
    return sum;
  };

  const Shown shown = shownBy(photographs);
  const std::vector<ResponseFit> fits =
      fitResponses(shown.drives, shown.what, sumOf(0, regions.size()), usualLights(shown.drives));
  std::vector<LevelLights> found;
  std::vector<std::vector<RegionLight>> white;
  std::vector<MosaicResult> results(fits.size());
  const std::vector<Additivity> additivity = Additivities(photographs, lights, fits).run();
  for (std::size_t p = 0; p < fits.size(); ++p) {
    found.push_back(fits[p].light);
    white.push_back(regionLights(lights, p, thinning));
    results[p].additivity = additivity[p];
    for (std::size_t c = 0; c < 3; ++c)
      results[p].response.channels[c] = curveOf(shown.drives[p], fits[p].light[c], fits[p].deviation[c]);
  }

  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    const LightProducts seen = sumOf(9 * camera, 9 * camera + 9);
    std::vector<ResponseFit> own = fits;
    if (cameras.size() > 1 && seen.values() >= fewestInRegion)
      own = fitResponses(shown.drives, shown.what, seen, found);
    for (std::size_t p = 0; p < fits.size(); ++p) {
      const bool enough = shinesIn(white, p, 9 * camera, 9 * camera + 9);
      results[p].flicker.push_back(enough ? own[p].flicker : fits[p].flicker);
    }
  }
  for (std::size_t region = 0; region < regions.size(); ++region) {
    if (regions[region].values() < fewestInRegion) continue;
    const std::vector<RegionDeviation> deviations = deviationsOf(fits, shown.what, regions[region]);
    for (std::size_t p = 0; p < fits.size(); ++p) {
      if (!shinesIn(white, p, region, region + 1)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(deviations[p].amplitude[c]) > certain * deviations[p].deviation[c])
          results[p].unevenness = std::max(results[p].unevenness, std::abs(deviations[p].amplitude[c]));
    }
  }
  return results;
}

}  // namespace relucent::linearization
