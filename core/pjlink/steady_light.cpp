// SPDX-License-Identifier: MIT
#include "relucent/pjlink/steady_light.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::pjlink {
namespace {

constexpr std::size_t leastSamples = 6;
constexpr double leastCovered = 0.9;                            // of the span
constexpr float highest = 0.9f, wanted = 0.4f, lowest = 0.15f;  // signal of the brightest pixels
constexpr double brightest = 0.995;                             // percentile: some may be lamps or gloss
constexpr int mostTries = 12;                                   // at an exposure
constexpr double leastLight = 1e-4;                             // mean signal of a projector that is seen

float bright(const image::Image& signal) {
  std::vector<float> samples = signal.data();
  const auto at =
      samples.begin() + static_cast<std::ptrdiff_t>(brightest * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), at, samples.end());
  return *at;
}

double mean(const image::Image& signal) {
  double sum = 0.0;
  for (float value : signal.data()) sum += static_cast<double>(value);
  return sum / static_cast<double>(signal.data().size());
}

/// The devices, looked at again and again.
class Looks {
 public:
  Looks(rig::Rig& rig, float drive) : rig_(rig), drive_(drive), exposures_(rig.cameras.size()) {}

  /// The exposure of each camera with which all projectors together are bright and do not overflow.
  void chooseExposures(const Progress& progress) {
    show([](std::size_t) { return true; });
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      const rig::ExposureRange range = rig_.cameras[c]->exposures();
      double seconds = std::sqrt(range.shortest * range.longest);
      for (int attempt = 0; attempt < mostTries; ++attempt) {
        progress.checkpoint();
        const float level = bright(photograph(c, seconds).signal);
        if (level >= lowest && level <= highest) break;
        // Of a photograph that overflows nothing is known but that it does.
        const double factor = level > highest ? 0.25 : static_cast<double>(wanted / std::max(level, 0.01f));
        const double next = std::clamp(seconds * factor, range.shortest, range.longest);
        if (next == seconds) break;
        seconds = next;
      }
      exposures_[c] = seconds;
    }
  }

  /// Light of each projector; none: a photograph overflowed.
  std::optional<std::vector<double>> take(const Progress& progress) {
    const std::vector<double> black = lit([](std::size_t) { return false; }, progress);
    std::vector<double> light;
    for (std::size_t p = 0; p < rig_.projectors.size(); ++p) {
      const std::vector<double> seen = lit([p](std::size_t other) { return other == p; }, progress);
      double sum = 0.0, signal = 0.0;
      for (std::size_t c = 0; c < seen.size(); ++c) {
        sum += (seen[c] - black[c]) / exposures_[c];
        signal = std::max(signal, seen[c] - black[c]);
      }
      if (!(signal > leastLight)) failUnseen(p);
      light.push_back(sum);
    }
    if (std::exchange(overflowed_, false)) return std::nullopt;
    return light;
  }

 private:
  template <typename IsLit>
  void show(IsLit isLit) {
    for (std::size_t p = 0; p < rig_.projectors.size(); ++p) {
      image::Image flat(rig_.projectors[p]->size(), 3);
      std::ranges::fill(flat.data(), isLit(p) ? drive_ : 0.0f);
      rig_.projectors[p]->show(flat);
    }
  }

  rig::RawFrame photograph(std::size_t camera, double seconds) {
    rig::CaptureRequest request{{"warm-up", shot_++}, 0, seconds, {}};
    rig::RawFrame frame = rig_.cameras[camera]->capture(request);
    rig::checkFrame(frame, rig_.cameras[camera]->size(), rig_.cameras[camera]->name());
    return frame;
  }

  /// The mean signal of each camera.
  template <typename IsLit>
  std::vector<double> lit(IsLit isLit, const Progress& progress) {
    show(isLit);
    std::vector<double> seen;
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      progress.checkpoint();
      const rig::RawFrame frame = photograph(c, exposures_[c]);
      overflowed_ = overflowed_ || bright(frame.signal) > highest;
      seen.push_back(mean(frame.signal));
    }
    return seen;
  }

  [[noreturn]] void failUnseen(std::size_t projector) const {
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("pjlink.light-unseen", "no camera sees light of projector {}")
                    .with(as::label(projector + 1)),
                RELUCENT_MESSAGE("pjlink.check-lens",
                                 "check lens caps, shutter and input of the projector, and where the "
                                 "camera looks"),
                rig_.projectors[projector]->name());
  }

  rig::Rig& rig_;
  float drive_;
  std::vector<double> exposures_;
  int shot_ = 0;
  bool overflowed_ = false;
};

[[noreturn]] void failUnsteady(std::size_t projector, const LightDrift& drift,
                               const SteadyLightSettings& settings) {
  throw Error(
      ErrorKind::device,
      RELUCENT_MESSAGE("pjlink.light-drifts",
                       "the light of projector {} still drifts by {} % within {} s after {} s")
          .with(as::label(projector + 1), as::share(drift.drift, as::digits(2)),
                as::seconds(static_cast<double>(settings.span.count()), as::decimals(0)),
                as::seconds(static_cast<double>(settings.longest.count()), as::decimals(0))),
      RELUCENT_MESSAGE(
          "pjlink.end-dimming",
          "switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure "
          "without waiting for its lamp"));
}

}  // namespace

std::vector<Message> problems(const SteadyLightSettings& settings) {
  std::vector<Message> found;
  if (!(settings.share > 0.0 && settings.share < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "pjlink.share-outside", "the share by which light may drift must be above 0 and below 1"));
  if (settings.interval.count() < 1 || settings.span < static_cast<int>(leastSamples) * settings.interval ||
      settings.longest < settings.span)
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "pjlink.span-too-short",
        "the time over which light is watched must be six intervals or more, and the "
        "longest wait no shorter"));
  return found;
}

std::optional<LightDrift> driftOf(std::span<const LightSample> samples, double span) {
  if (samples.size() < leastSamples || samples.back().seconds - samples.front().seconds < leastCovered * span)
    return std::nullopt;
  const auto count = static_cast<double>(samples.size());
  double time = 0.0, light = 0.0;
  for (const LightSample& sample : samples) {
    time += sample.seconds / count;
    light += sample.light / count;
  }
  if (!(light > 0.0)) return std::nullopt;
  double squares = 0.0, products = 0.0;
  for (const LightSample& sample : samples) {
    squares += (sample.seconds - time) * (sample.seconds - time);
    products += (sample.seconds - time) * (sample.light - light);
  }
  const double slope = products / squares;
  double residuals = 0.0;
  for (const LightSample& sample : samples) {
    const double residual = sample.light - light - slope * (sample.seconds - time);
    residuals += residual * residual;
  }
  const double deviation = std::sqrt(residuals / (count - 2.0) / squares);
  return LightDrift{std::abs(slope) * span / light, deviation * span / light};
}

bool isSteady(const LightDrift& drift, double share) {
  return drift.drift <= std::max(share, 2.0 * drift.deviation);
}

SteadyLight awaitSteadyLight(rig::Rig& rig, const SteadyLightSettings& settings, const Waiting& waiting,
                             Progress& progress) {
  const Waiting::Time begin = waiting.now();
  const auto passed = [&] { return std::chrono::duration<double>(waiting.now() - begin).count(); };
  const auto span = static_cast<double>(settings.span.count());
  std::vector<std::vector<LightSample>> samples(rig.projectors.size());
  Looks looks(rig, settings.drive);
  looks.chooseExposures(progress);
  for (;;) {
    const double now = passed();
    if (const std::optional<std::vector<double>> light = looks.take(progress)) {
      for (std::size_t p = 0; p < samples.size(); ++p) {
        samples[p].push_back({now, (*light)[p]});
        // Where a look takes long, the fewest that tell a drift reach further back.
        const auto old = std::ranges::find_if(
            samples[p], [&](const LightSample& sample) { return sample.seconds >= now - span; });
        const std::ptrdiff_t spare = std::ssize(samples[p]) - static_cast<std::ptrdiff_t>(leastSamples);
        samples[p].erase(samples[p].begin(),
                         samples[p].begin() + std::clamp<std::ptrdiff_t>(old - samples[p].begin(), 0,
                                                                         std::max<std::ptrdiff_t>(spare, 0)));
      }
    } else {
      for (std::vector<LightSample>& one : samples) one.clear();
      looks.chooseExposures(progress);
    }

    SteadyLight result{now, {}};
    std::optional<std::size_t> unsteady;
    LightDrift worst;
    for (std::size_t p = 0; p < samples.size(); ++p) {
      const std::optional<LightDrift> drift = driftOf(samples[p], span);
      if (drift) result.drift.push_back(drift->drift);
      if (drift && isSteady(*drift, settings.share)) continue;
      if (unsteady && !(drift && drift->drift > worst.drift)) continue;
      unsteady = p;
      worst = drift.value_or(LightDrift());
    }
    if (!unsteady) {
      progress.report(1.0);
      return result;
    }
    if (now >= static_cast<double>(settings.longest.count())) failUnsteady(*unsteady, worst, settings);
    progress.report(now / static_cast<double>(settings.longest.count()));
    waiting.pause(settings.interval, progress);
  }
}

}  // namespace relucent::pjlink
