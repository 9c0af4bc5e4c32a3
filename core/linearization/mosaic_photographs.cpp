// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic_photographs.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/hdr/isotonic.h"
#include "relucent/linearization/test_light.h"

namespace relucent::linearization {
namespace {

constexpr std::size_t mostPixels = 100000;  // of all cameras, that are evaluated
constexpr double leastLight = 0.02;         // of the 99th percentile of white, of values that are evaluated
constexpr double leastShare = 0.01;         // of white, of a channel that cameras see
constexpr double mostDim = 0.9;             // of flood light, over what longer exposures gain
constexpr double mostEarly = 0.75;          // of that, of levels that are shown before
constexpr double leastGain = 1.5;           // of longer exposures, to be worth it
constexpr int coarseBits = 8;               // of a linear camera
constexpr double fewestInRegion = 60.0;     // values
constexpr double certain = 6.0;             // deviations

std::size_t divided(std::size_t a, std::size_t b) {
  return (a + b - 1) / b;
}

/// Photographs less black, at the values that all of them show.
struct Lights {
  std::vector<std::size_t> at;                       // which values
  std::vector<std::vector<double>> light, variance;  // [photograph][value]
};

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

  const hdr::HdrFrame& white = frames.front();
  std::vector<float> rise(white.radiance.size());
  for (std::size_t i = 0; i < rise.size(); ++i) rise[i] = white.radiance[i] - before.radiance[i];
  std::vector<float> sorted = rise;
  auto high = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
  std::nth_element(sorted.begin(), high, sorted.end());

  Lights lights;
  for (std::size_t i = 0; i < rise.size(); ++i) {
    double light = rise[i], noise = std::sqrt(static_cast<double>(white.variance[i] + before.variance[i]));
    bool usable =
        light > leastLight * static_cast<double>(*high) && light > 5.0 * noise && before.valid[i] != 0;
    for (const hdr::HdrFrame& frame : frames) usable = usable && frame.valid[i] != 0;
    if (usable) lights.at.push_back(i);
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
    products.add(light, variance, 1.0 / variance.front());
  }
  return products;
}

/// The levels that photographs show, and the photographs in terms of these alone.
struct Shown {
  std::vector<double> drives;
  std::vector<MosaicShot> what;
};
Shown shownBy(const MosaicPhotographs& photographs) {
  std::vector<bool> used(photographs.drives.size() + 1, false);
  used.back() = true;
  for (const MosaicShot& shot : photographs.what)
    for (std::size_t level : shot.level) used[level] = true;
  std::vector<std::size_t> place(used.size(), 0);
  Shown shown{{}, photographs.what};
  for (std::size_t level = 1; level < used.size(); ++level) {
    if (!used[level]) continue;
    shown.drives.push_back(photographs.drives[level - 1]);
    place[level] = shown.drives.size();
  }
  for (MosaicShot& shot : shown.what)
    for (std::size_t& level : shot.level) level = place[level];
  return shown;
}

LevelLights usualLights(const std::vector<double>& drives) {
  LevelLights start;
  for (std::vector<double>& channel : start)
    for (double drive : drives) channel.push_back(std::pow(drive, 2.2));
  return start;
}

/// What is known of the response while it is being measured: enough to tell how bright a level will be.
class Forecast {
 public:
  Forecast(const MosaicPhotographs& photographs, const Lights& lights) {
    Shown shown = shownBy(photographs);
    drives_ = shown.drives;
    light_ = fitResponse(drives_, shown.what, productsOf(lights, [](std::size_t) { return true; }),
                         usualLights(drives_))
                 .light;
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<bool>& seen = seen_[c];
      seen.assign(drives_.size(), false);
      seen.back() = true;
      for (const MosaicShot& shot : shown.what)
        for (std::size_t group = 0; group < mosaicGroups; ++group)
          if (std::size_t level = shot.level[3 * group + c]; level > 0) seen[level - 1] = true;
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

  bool empty() const {
    return std::ranges::all_of(open_, [](const auto& channel) { return channel.empty(); });
  }
  /// The highest of a channel that is still open; 0: none.
  std::size_t next(std::size_t channel) const { return open_[channel].empty() ? 0 : open_[channel].front(); }
  std::size_t left(std::size_t channel) const { return open_[channel].size(); }

  /// One channel's next levels in random groups, while `wanted` says so; one group is full if `reference`.
  template <typename Wanted>
  void show(MosaicShot& shot, std::size_t channel, bool reference, std::size_t full, const Wanted& wanted) {
    std::array<std::size_t, mosaicGroups> groups{};
    for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = i;
    for (std::size_t i = groups.size(); i > 1; --i) std::swap(groups[i - 1], groups[random_.below(i)]);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      std::size_t& level = shot.level[3 * groups[i] + channel];
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

/// Takes one projector's photographs.
class Photographer {
 public:
  Photographer(rig::ShotTaker& shots, std::size_t projector, const std::vector<hdr::CameraModel>& cameras,
               const ExposureChoice& choice, const LinearizationSettings& settings, Progress& progress)
      : shots_(shots),
        projector_(projector),
        cameras_(cameras),
        choice_(choice),
        progress_(progress),
        thinning_(shots.rig().cameraRasters()),
        mosaic_(shots.rig().projectors[projector]->size(), Random{settings.seed, 7, projector}),
        queue_(rampLevels(settings, shots.rig().projectors[projector]->bits()).size(),
               Random{settings.seed, 8, projector}) {
    result_.drives = rampLevels(settings, shots.rig().projectors[projector]->bits());
    // White and its nine lights, a group in white, the levels, white and black.
    expected_ = 13.0 + std::ceil(static_cast<double>(queue_.left(0)) / 2.75);
  }

  MosaicPhotographs run(rig::Shot blackBefore) {
    result_.blackBefore = std::move(blackBefore);
    photographLights();
    requireAllChannels();
    photographLevels();
    take(white(), choice_.flood);
    const rig::Shot after = shots_.take(evenPatterns(shots_.rig(), {0, 0, 0}), choice_.dim, progress_);
    result_.blackAfter = thinning_.of(after);
    return std::move(result_);
  }

 private:
  std::size_t full() const { return result_.drives.size(); }
  MosaicShot white() const {
    MosaicShot shot;
    shot.level.fill(full());
    return shot;
  }

  void take(MosaicShot what, const std::vector<double>& exposures) {
    std::vector<image::Image> patterns = evenPatterns(shots_.rig(), {0, 0, 0});
    MosaicDrive drive{};
    for (std::size_t q = 0; q < mosaicLights; ++q)
      drive[q] = what.level[q] > 0 ? result_.drives[what.level[q] - 1] : 0.0;
    patterns[projector_] = mosaic_.pattern(drive);
    keep(what, thinning_.of(shots_.take(patterns, exposures, progress_)));
  }
  void keep(MosaicShot what, rig::Shot shot) {
    what.time = shot.id.number;
    result_.what.push_back(what);
    result_.shots.push_back(std::move(shot));
    progress_.report(std::min(1.0, static_cast<double>(result_.what.size()) / expected_));
  }

  void photographLights() {
    std::optional<rig::Shot> taken;
    if (shots_.rig().projectors.size() == 1) taken = atExposures(choice_.whites, choice_.flood);
    if (taken)
      keep(white(), *std::move(taken));
    else
      take(white(), choice_.flood);
    // Where a light does not fall, there is hardly more than black: less than a code of a coarse camera,
    // which rounds all of it down. Longer exposures tell.
    const bool coarse = isCoarse();
    std::vector<double> floodAndDim = choice_.dim;
    for (double seconds : choice_.flood)
      if (std::ranges::count(floodAndDim, seconds) == 0) floodAndDim.push_back(seconds);
    for (std::size_t q = 0; q < mosaicLights; ++q) {
      MosaicShot light;
      light.level[q] = full();
      take(light, coarse ? floodAndDim : choice_.flood);
    }
    MosaicShot group;
    std::fill_n(group.level.begin(), 3, full());
    take(group, choice_.flood);
  }

  bool isCoarse() const {
    const std::vector<rig::RawFrame>& frames = choice_.whites.front().frames.front();
    for (std::size_t camera = 0; camera < frames.size(); ++camera)
      if (frames[camera].bits > 0 && frames[camera].bits <= coarseBits &&
          cameras_[camera].response[0].isIdentity())
        return true;
    return false;
  }

  void requireAllChannels() const {
    const Lights lights = lightsOf(result_, cameras_, thinning_.rasters());
    const std::string name = shots_.rig().projectors[projector_]->name();
    if (static_cast<double>(lights.at.size()) < 3.0 * static_cast<double>(mosaicLights))
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("linearization.white-not-measurable",
                                   "no camera can measure the white of this projector"),
          RELUCENT_ENGLISH_MESSAGE(
              "linearization.check-view-and-exposure",
              "check that its picture is in view and not overexposed: close the aperture or lower the gain"),
          name);
    for (std::size_t c = 0; c < 3; ++c) {
      double light = 0.0, variance = 0.0, all = 0.0;
      for (std::size_t i = 0; i < lights.at.size(); ++i) {
        double weight = 1.0 / lights.variance[0][i];
        all += weight * lights.light[0][i];
        for (std::size_t group = 0; group < mosaicGroups; ++group) {
          light += weight * lights.light[1 + 3 * group + c][i];
          variance += weight * weight * lights.variance[1 + 3 * group + c][i];
        }
      }
      if (light > leastShare * all && light > 5.0 * std::sqrt(variance)) continue;
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
  double nextLight(std::size_t channel) const {
    const std::size_t level = queue_.next(channel);
    return level > 0 ? lightOf(channel, level) : 0.0;
  }
  double lightOf(std::size_t channel, std::size_t level) const {
    return forecast_ ? forecast_->lightOf(channel, result_.drives[level - 1]) : 1.0;
  }

  /// The channel with the fewest levels left has room for a full light.
  std::size_t referenceChannel() const {
    std::size_t found = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (std::pair(queue_.left(c), nextLight(c)) < std::pair(queue_.left(found), nextLight(found)))
        found = c;
    return found;
  }

  /// White, the lights, the group in white, and the last two mosaics.
  MosaicPhotographs lastPhotographs() const {
    constexpr std::size_t first = 2 + mosaicLights, last = 2;
    MosaicPhotographs result{result_.drives, {}, {}, result_.blackBefore, {}};
    for (std::size_t m = 0; m < result_.what.size(); ++m) {
      if (m >= first && m + last < result_.what.size()) continue;
      result.what.push_back(result_.what[m]);
      result.shots.push_back(result_.shots[m]);
    }
    return result;
  }

  void photographLevels() {
    // Light that longer exposures make as bright as the flood image.
    const double dim = choice_.dimmerBy > leastGain ? mostDim / choice_.dimmerBy : 0.0;
    while (!queue_.empty()) {
      const bool bright = std::max({nextLight(0), nextLight(1), nextLight(2)}) > dim;
      const std::size_t reference = referenceChannel();
      MosaicShot shot;
      for (std::size_t c = 0; c < 3; ++c)
        queue_.show(shot, c, bright && c == reference, full(), [&](std::size_t channel, std::size_t level) {
          return !bright || lightOf(channel, level) > dim * mostEarly;
        });
      take(shot, bright ? choice_.flood : choice_.dim);
      if (!bright) continue;
      const MosaicPhotographs last = lastPhotographs();
      forecast_.emplace(last, lightsOf(last, cameras_, thinning_.rasters()));
    }
  }

  rig::ShotTaker& shots_;
  std::size_t projector_;
  const std::vector<hdr::CameraModel>& cameras_;
  const ExposureChoice& choice_;
  Progress& progress_;
  Thinning thinning_;
  Mosaic mosaic_;
  LevelQueue queue_;
  std::optional<Forecast> forecast_;
  double expected_ = 1.0;
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

Additivity additivityIn(const MosaicPhotographs& photographs, const Lights& lights, double drift) {
  std::vector<ChannelSums> sums(lights.light.size(), ChannelSums{});
  for (std::size_t m = 0; m < sums.size(); ++m)
    for (std::size_t i = 0; i < lights.at.size(); ++i) sums[m][lights.at[i] % 3] += lights.light[m][i];
  for (std::size_t m = 0; m < sums.size(); ++m)
    for (double& sum : sums[m])
      sum /= 1.0 + drift * (photographs.what[m].time - photographs.what.front().time);
  std::array<ChannelSums, mosaicLights> single{};
  std::copy_n(sums.begin() + 1, mosaicLights, single.begin());
  return additivityOf(sums.front(), single, sums[1 + mosaicLights]);
}

}  // namespace

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

MosaicPhotographs photographMosaics(rig::ShotTaker& shots, std::size_t projector,
                                    const std::vector<hdr::CameraModel>& cameras,
                                    const ExposureChoice& choice, rig::Shot blackBefore,
                                    const LinearizationSettings& settings, Progress& progress) {
  return Photographer(shots, projector, cameras, choice, settings, progress).run(std::move(blackBefore));
}

MosaicResult evaluate(const MosaicPhotographs& photographs, const std::vector<hdr::CameraModel>& cameras,
                      const Thinning& thinning) {
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

  MosaicResult result;
  const Shown shown = shownBy(photographs);
  const ResponseFit fit =
      fitResponse(shown.drives, shown.what, sumOf(0, regions.size()), usualLights(shown.drives));
  result.additivity = additivityIn(photographs, lights, fit.drift);
  for (std::size_t c = 0; c < 3; ++c)
    result.response.channels[c] = curveOf(shown.drives, fit.light[c], fit.deviation[c]);

  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    const LightProducts seen = sumOf(9 * camera, 9 * camera + 9);
    if (cameras.size() == 1 || seen.values() < fewestInRegion)
      result.flicker.push_back(fit.flicker);
    else
      result.flicker.push_back(fitResponse(shown.drives, shown.what, seen, fit.light).flicker);
  }
  for (const LightProducts& region : regions) {
    if (region.values() < fewestInRegion) continue;
    RegionDeviation deviation = deviationOf(fit, shown.what, region);
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(deviation.amplitude[c]) > certain * deviation.deviation[c])
        result.unevenness = std::max(result.unevenness, std::abs(deviation.amplitude[c]));
  }
  return result;
}

}  // namespace relucent::linearization
