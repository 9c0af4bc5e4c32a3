// SPDX-License-Identifier: MIT
#include "relucent/devices/check/light_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/devices/whole_frames.h"

namespace relucent::devices {
namespace {

constexpr int mostBands = 8;
constexpr double briefShare = 1.0 / 8.0;  // of a frame
constexpr double litShare = 0.25;         // of the brightest step: pixels that count
constexpr double leastGain = 0.004;       // signal that a brief exposure must gain by white
constexpr double leastLit = 0.25;         // of a colour's usual signal
constexpr double golden = 0.381966;       // phases that never repeat

struct Moments {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  void add(double value) { sum += value, squares += value * value, ++count; }
  double mean() const { return count > 0 ? sum / count : 0.0; }
  double variance() const {
    return count > 1 ? std::max(0.0, (squares - sum * sum / count) / (count - 1)) : 0.0;
  }
  double relative() const { return mean() > 0.0 ? std::sqrt(variance()) / mean() : 0.0; }
};

/// Pixels that the projector lights, in bands of rows.
struct Lit {
  struct Spot {
    Pixel place;
    std::size_t band = 0;
  };
  std::vector<Spot> spots;
  std::array<int, mostBands> inBand{};
};

using Bands = std::array<std::array<double, 3>, mostBands>;  // sums of signals, per colour

/// Photographs of one flat field.
struct Series {
  std::vector<image::Image> pictures;  // less black
  std::vector<Bands> bands;
};

Lit litOf(const image::Image& step) {
  auto brightness = [&](int x, int y) {
    return static_cast<double>(step.at(x, y, 0) + step.at(x, y, 1) + step.at(x, y, 2)) / 3.0;
  };
  double brightest = 0.0;
  for (int y = 0; y < step.height(); ++y)
    for (int x = 0; x < step.width(); ++x) brightest = std::max(brightest, brightness(x, y));
  Lit lit;
  for (int y = 0; y < step.height(); ++y)
    for (int x = 0; x < step.width(); ++x) {
      if (!(brightness(x, y) >= litShare * brightest && brightest > 0.0)) continue;
      const auto band = static_cast<std::size_t>(y * mostBands / step.height());
      lit.spots.push_back({{x, y}, band});
      ++lit.inBand[band];
    }
  return lit;
}

image::Image meanOf(const std::vector<image::Image>& pictures) {
  image::Image mean(pictures.front().size(), 3, 0.0f);
  for (const image::Image& picture : pictures)
    for (std::size_t i = 0; i < mean.data().size(); ++i)
      mean.data()[i] += picture.data()[i] / static_cast<float>(pictures.size());
  return mean;
}

Bands bandsOf(const image::Image& picture, const Lit& lit) {
  Bands sums{};
  for (const Lit::Spot& spot : lit.spots)
    for (int c = 0; c < 3; ++c)
      sums[spot.band][static_cast<std::size_t>(c)] +=
          static_cast<double>(picture.at(spot.place.x, spot.place.y, c));
  return sums;
}

double sumOf(const Bands& bands, std::size_t colour) {
  double sum = 0.0;
  for (const auto& band : bands) sum += band[colour];
  return sum;
}
double sumOf(const Bands& bands) {
  return sumOf(bands, 0) + sumOf(bands, 1) + sumOf(bands, 2);
}

double flickerOf(const Series& series) {
  Moments totals;
  for (const Bands& bands : series.bands) totals.add(sumOf(bands));
  return totals.relative();
}

/// Mean variance of single pixels around what their band and colour does in each photograph, absolute.
double pixelVariance(const Series& series, const Lit& lit) {
  double sum = 0.0;
  for (const Lit::Spot& spot : lit.spots)
    for (int c = 0; c < 3; ++c) {
      const auto colour = static_cast<std::size_t>(c);
      Moments residual;
      double mean = 0.0, bandMean = 0.0;
      for (std::size_t k = 0; k < series.pictures.size(); ++k) {
        mean += static_cast<double>(series.pictures[k].at(spot.place.x, spot.place.y, c));
        bandMean += series.bands[k][spot.band][colour];
      }
      if (!(bandMean > 0.0)) continue;
      for (std::size_t k = 0; k < series.pictures.size(); ++k)
        residual.add(static_cast<double>(series.pictures[k].at(spot.place.x, spot.place.y, c)) -
                     mean / bandMean * series.bands[k][spot.band][colour]);
      sum += residual.variance() / 3.0;
    }
  return lit.spots.empty() ? 0.0 : sum / static_cast<double>(lit.spots.size());
}

/// Of S_kcg / S_kg, the worst colour, less what the noise of `variance` a pixel explains.
double colourChangeOf(const Series& series, const Lit& lit, double variance) {
  double worst = 0.0;
  for (std::size_t colour = 0; colour < 3; ++colour) {
    Moments changes;
    for (std::size_t band = 0; band < mostBands; ++band) {
      Moments shares, noise;
      for (const Bands& bands : series.bands) {
        const double all = bands[band][0] + bands[band][1] + bands[band][2];
        if (lit.inBand[band] == 0 || !(all > 0.0)) continue;
        shares.add(bands[band][colour] / all);
        noise.add(variance * lit.inBand[band] / (all * all));
      }
      if (shares.mean() > 0.0)
        changes.add(std::max(0.0, shares.variance() - noise.mean()) / (shares.mean() * shares.mean()));
    }
    worst = std::max(worst, std::sqrt(changes.mean()));
  }
  return worst;
}

/// Of S_kcg / S_kc, less what the noise of `variance` a pixel explains. Photographs in which a colour was
/// hardly lit say nothing about it.
double bandsChangeOf(const Series& series, const Lit& lit, double variance) {
  double changes = 0.0;
  int count = 0;
  for (std::size_t colour = 0; colour < 3; ++colour) {
    Moments usual;
    for (const Bands& bands : series.bands) usual.add(sumOf(bands, colour));
    for (std::size_t band = 0; band < mostBands; ++band) {
      Moments shares, noise;
      for (const Bands& bands : series.bands) {
        const double all = sumOf(bands, colour);
        if (lit.inBand[band] == 0 || !(all > leastLit * usual.mean())) continue;
        shares.add(bands[band][colour] / all);
        noise.add(variance * lit.inBand[band] / (all * all));
      }
      if (!(shares.mean() > 0.0)) continue;
      changes += std::max(0.0, shares.variance() - noise.mean()) / (shares.mean() * shares.mean());
      ++count;
    }
  }
  return count > 0 ? std::sqrt(changes / count) : 0.0;
}

/// The variance by which `grey` is beyond `white`; 0 where that may be chance. Both are means of `samples`.
double varianceBeyond(double grey, double white, double samples) {
  constexpr double sigmas = 4.0;
  const double uncertainty = std::sqrt(2.0 / samples * (grey * grey + white * white));
  return grey - white > sigmas * uncertainty ? grey - white : 0.0;
}

class LightMeasurement {
 public:
  LightMeasurement(rig::Projector& projector, rig::Camera& camera, const LightCheckSettings& settings,
                   const Wait& wait, Progress& progress)
      : projector_(projector), camera_(camera), settings_(settings), wait_(wait), progress_(progress) {}

  LightCheck run(double exposure) {
    LightCheck check;
    const rig::ExposureRange range = camera_.exposures();
    const double frame = settings_.frame;
    const double whole = hasWholeFrames(range, frame) ? wholeFrames(exposure, frame, range) : exposure;
    if (range.shortest <= 0.5 * frame) check.brief = std::max(range.shortest, briefShare * frame);

    look(whole, 1.0f);
    check.unsteady = flickerOf(series_);
    if (check.brief > 0.0) lookBriefly(check);
    projector_.show(image::Image(projector_.size(), 3, 0.0f));
    speak(check);
    return check;
  }

 private:
  void lookBriefly(LightCheck& check) {
    look(check.brief, 1.0f);
    if (!(step_ > leastGain)) {
      check.brief = 0.0;  // too dark to tell anything
      return;
    }
    const Series white = series_;
    const double noise = pixelVariance(white, lit_);
    check.flicker = flickerOf(white);
    check.colours = colourChangeOf(white, lit_, noise);
    check.bands = bandsChangeOf(white, lit_, noise);
    look(check.brief, 0.5f);
    Moments grey;
    for (const Bands& bands : series_.bands)
      grey.add(sumOf(bands) / (3.0 * static_cast<double>(lit_.spots.size())));
    // White is brighter and never dithered: its noise is at least that of grey.
    const double samples = 3.0 * static_cast<double>(lit_.spots.size()) * (settings_.photographs - 1);
    const double beyond = varianceBeyond(pixelVariance(series_, lit_), noise, samples);
    check.dither = grey.mean() > 0.0 ? std::sqrt(beyond) / grey.mean() : 0.0;
  }

  std::vector<image::Image> photographs(double exposure, float level, int count) {
    projector_.show(image::Image(projector_.size(), 3, level));
    wait_(settings_.settle);
    std::vector<image::Image> pictures;
    for (int i = 0; i < count; ++i) {
      progress_.checkpoint();
      wait_(settings_.frame * std::fmod(golden * ++phase_, 1.0));
      pictures.push_back(camera_.capture({{"light", number_++}, 0, exposure}).signal);
    }
    return pictures;
  }

  /// Fills series_, lit_ and step_. What is lit is told by white.
  void look(double exposure, float level) {
    const image::Image black = meanOf(photographs(exposure, 0.0f, std::max(4, settings_.photographs / 4)));
    series_ = {photographs(exposure, level, settings_.photographs), {}};
    for (image::Image& picture : series_.pictures)
      for (std::size_t i = 0; i < picture.data().size(); ++i) picture.data()[i] -= black.data()[i];
    if (level >= 1.0f) {
      const image::Image step = meanOf(series_.pictures);
      lit_ = litOf(step);
    }
    for (const image::Image& picture : series_.pictures) series_.bands.push_back(bandsOf(picture, lit_));
    Moments steps;
    for (const Bands& bands : series_.bands)
      steps.add(lit_.spots.empty() ? 0.0 : sumOf(bands) / (3.0 * static_cast<double>(lit_.spots.size())));
    step_ = steps.mean();
    progress_.report(static_cast<double>(number_) / (4.0 * settings_.photographs + 1.0));
    if (lit_.spots.empty())
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("device.no-contrast", "the camera sees no difference between white and black"),
          RELUCENT_MESSAGE("device.aim-uncover-and-expose-longer",
                           "aim it at the projection, take off its lens cap, and expose longer"),
          camera_.name());
  }

  void speak(LightCheck& check) const {
    auto say = [&](bool seen, const CheckVerdict& verdict) {
      if (seen) check.verdicts.push_back(verdict);
      return seen;
    };
    bool any = say(check.unsteady > settings_.flicker, {Finding::lightUnsteady, check.unsteady});
    if (!(check.brief > 0.0)) {
      say(true, {Finding::noBriefExposure});
      return;
    }
    auto sayBriefly = [&](bool seen, Finding finding, double share) {
      any |=
          say(seen, {.finding = finding, .share = share, .seconds = check.brief, .frame = settings_.frame});
    };
    sayBriefly(check.flicker > settings_.flicker && check.flicker > 2.0 * check.unsteady,
               Finding::lampFlickers, check.flicker);
    sayBriefly(check.colours > settings_.colours, Finding::colourWheel, check.colours);
    sayBriefly(check.bands > settings_.bands, Finding::rollingShutter, check.bands);
    sayBriefly(check.dither > settings_.dither, Finding::dithering, check.dither);
    say(!any, {Finding::lightEven});
  }

  rig::Projector& projector_;
  rig::Camera& camera_;
  const LightCheckSettings& settings_;
  const Wait& wait_;
  Progress& progress_;
  Series series_;
  Lit lit_;
  double step_ = 0.0;
  int number_ = 0, phase_ = 0;
};

}  // namespace

std::vector<Message> problems(const LightCheckSettings& settings) {
  std::vector<Message> found;
  if (!(settings.frame > 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.frame-time-not-positive",
                                             "the duration of a projector's frame must be above 0 seconds"));
  if (!(settings.settle >= 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.settle-time-negative",
                                             "the time to let a flat field settle cannot be negative"));
  if (settings.photographs < 8)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.too-few-light-photographs",
                                 "at least 8 photographs are needed to tell whether the light is steady"));
  return found;
}

LightCheck checkLight(rig::Projector& projector, rig::Camera& camera, double exposure,
                      const LightCheckSettings& settings, const Wait& wait, Progress& progress) {
  require(problems(settings).empty(), "{}", fmt::join(problems(settings), "; "));
  require(exposure > 0.0, "an exposure of {} s", exposure);
  return LightMeasurement(projector, camera, settings, wait, progress).run(exposure);
}

}  // namespace relucent::devices
