// SPDX-License-Identifier: MIT
#include "relucent/devices/check/screen_proof.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace {

constexpr int length = screenCodeLength, quarters = 4, apart = 8;
/// From here on, seconds, it pays to look first whether there is any light: a camera that sees none is given
/// the longest exposure that it has.
constexpr double longExposure = 0.5;
using Quarters = std::array<double, quarters>;

std::array<int, length> maximalLengthSequence() {
  std::array<int, length> bits{};
  unsigned state = 1;
  for (int& bit : bits) {
    bit = static_cast<int>(state & 1u);
    state = (state >> 1) | (((state ^ (state >> 2)) & 1u) << 4);
  }
  return bits;
}

/// Whether a quarter is white in picture `number`.
bool isWhite(int quarter, int number) {
  static const std::array<int, length> bits = maximalLengthSequence();
  const int at = (number + quarter * apart) % length;
  return bits[static_cast<std::size_t>((at + length) % length)] == 1;
}

/// What a pixel's series owes to the four codes.
struct Following {
  Quarters weights{};      // signal by which each quarter changes it
  double explained = 0.0;  // share of the series' variance
};

/// Least squares of a series without its mean on the four codes without theirs. Their Gram matrix is
///   a I + b J,  a = (N + 1) / 4,  b = -(N + 1) / (4 N):  a quarter of that of signs.
Following followed(const std::array<double, length>& series, int late) {
  constexpr double n = length, a = (n + 1.0) / 4.0, b = -(n + 1.0) / (4.0 * n);
  double mean = 0.0, variance = 0.0;
  for (double value : series) mean += value / n;
  for (double value : series) variance += (value - mean) * (value - mean);
  Following result;
  if (!(variance > 0.0)) return result;

  Quarters projected{};
  double sum = 0.0;
  for (int quarter = 0; quarter < quarters; ++quarter) {
    double& onto = projected[static_cast<std::size_t>(quarter)];
    for (int i = 0; i < length; ++i)
      if (isWhite(quarter, i)) onto += series[static_cast<std::size_t>((i + late) % length)] - mean;
    sum += onto;
  }
  double explained = 0.0;
  for (std::size_t quarter = 0; quarter < quarters; ++quarter) {
    result.weights[quarter] = (projected[quarter] - b / (a + quarters * b) * sum) / a;
    explained += result.weights[quarter] * projected[quarter];
  }
  result.explained = explained / variance;
  return result;
}

/// Where the light of the quarters lands in the photograph.
class Places {
 public:
  void add(const Quarters& weights, Pixel place) {
    const auto strongest =
        static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
    const double weight = weights[strongest];
    sums_[strongest][0] += weight * place.x;
    sums_[strongest][1] += weight * place.y;
    sums_[strongest][2] += weight;
  }
  /// Right before down, as the picture has it, or the other way round; false while that cannot be told.
  bool isMirrored() const {
    std::array<double, 2> right{}, down{};
    auto addTo = [&](std::array<double, 2>& direction, std::size_t from, std::size_t to) {
      if (!(sums_[from][2] > 0.0) || !(sums_[to][2] > 0.0)) return;
      for (std::size_t axis : {0u, 1u})
        direction[axis] += sums_[to][axis] / sums_[to][2] - sums_[from][axis] / sums_[from][2];
    };
    addTo(right, 0, 1), addTo(right, 2, 3);
    addTo(down, 0, 2), addTo(down, 1, 3);
    const double turn = right[0] * down[1] - right[1] * down[0];
    const double lengths = std::hypot(right[0], right[1]) * std::hypot(down[0], down[1]);
    return turn < -0.1 * lengths;
  }

 private:
  std::array<std::array<double, 3>, quarters> sums_{};
};

ScreenSight sightAt(const std::vector<image::Image>& brightness, int late,
                    const ScreenProofSettings& settings) {
  const Size size = brightness.front().size();
  ScreenSight sight;
  sight.late = late;
  Places places;
  std::size_t seen = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      // The first `late` photographs saw what was shown before; those at the end stand for them.
      std::array<double, length> series{};
      for (int i = 0; i < length; ++i) {
        const int taken = i < late ? i + length : i;
        series[static_cast<std::size_t>(i)] =
            static_cast<double>(brightness[static_cast<std::size_t>(taken)].at(x, y, 0));
      }
      const Following pixel = followed(series, late);
      const double step = *std::max_element(pixel.weights.begin(), pixel.weights.end());
      if (!(pixel.explained >= settings.explained && step >= settings.leastStep)) continue;
      ++seen;
      places.add(pixel.weights, {x, y});
    }
  sight.share = static_cast<double>(seen) / static_cast<double>(size.count());
  sight.mirrored = places.isMirrored();
  return sight;
}

/// Mean of the channels.
image::Image brightnessOf(const image::Image& photograph) {
  image::Image one(photograph.size(), 1, 0.0f);
  for (int y = 0; y < photograph.height(); ++y)
    for (int x = 0; x < photograph.width(); ++x)
      for (int c = 0; c < photograph.channels(); ++c)
        one.at(x, y, 0) += photograph.at(x, y, c) / static_cast<float>(photograph.channels());
  return one;
}

/// Whether as many pixels tell white from black as have to see the code, which changes less than all of it.
bool distinguishesWhiteFromBlack(rig::Projector& screen, rig::Camera& camera, double exposure,
                                 const ScreenProofSettings& settings, Progress& progress) {
  int number = 0;
  auto photographOf = [&](float level) {
    image::Image last;
    for (int late = 0; late <= settings.mostLate; ++late) {
      progress.checkpoint();
      screen.show(image::Image(screen.size(), 3, level));
      last = brightnessOf(camera.capture({{"light", number++}, 0, exposure}).signal);
    }
    return last;
  };
  const image::Image white = photographOf(1.0f), black = photographOf(0.0f);
  int lit = 0;
  for (std::size_t i = 0; i < white.data().size(); ++i) {
    const double step = static_cast<double>(white.data()[i] - black.data()[i]);
    // Noise goes both ways.
    if (std::abs(step) >= settings.leastStep) lit += step > 0.0 ? 1 : -1;
  }
  return lit >= settings.leastShare * static_cast<double>(white.data().size());
}

ScreenSight sightThrough(rig::Projector& screen, rig::Camera& camera, double exposure,
                         const ScreenProofSettings& settings, Progress& progress) {
  if (exposure >= longExposure && !distinguishesWhiteFromBlack(screen, camera, exposure, settings, progress))
    return {};
  std::vector<image::Image> photographs;
  const int count = length + settings.mostLate;
  for (int number = 0; number < count; ++number) {
    progress.checkpoint();
    screen.show(screenCode(screen.size(), number));
    photographs.push_back(camera.capture({{"proof", number}, 0, exposure}).signal);
    progress.report(static_cast<double>(number + 1) / count);
  }
  screen.show(image::Image(screen.size(), 3, 0.0f));
  return sightOf(photographs, settings);
}

}  // namespace

std::vector<Message> problems(const ScreenProofSettings& settings) {
  std::vector<Message> found;
  if (settings.mostLate < 0 || settings.mostLate >= apart)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.lateness-out-of-range", "pictures can come 0 to {} photographs late")
            .with(apart - 1));
  if (!(settings.explained > 0.0 && settings.explained < 1.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.explained-share-out-of-range",
                                 "the share of the changes that the code explains is between 0 and 1"));
  if (!(settings.leastShare > 0.0 && settings.leastShare <= 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.code-share-out-of-range",
                                             "the share of the pixels that see the code is between 0 and 1"));
  return found;
}

image::Image screenCode(Size size, int number) {
  image::Image picture(size, 3, 0.0f);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int quarter = (x < size.width / 2 ? 0 : 1) + (y < size.height / 2 ? 0 : 2);
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = isWhite(quarter, number) ? 1.0f : 0.0f;
    }
  return picture;
}

ScreenSight sightOf(const std::vector<image::Image>& photographs, const ScreenProofSettings& settings) {
  require(problems(settings).empty(), "{}", fmt::join(problems(settings), "; "));
  require(photographs.size() == static_cast<std::size_t>(length + settings.mostLate),
          "{} photographs of a code of {}", photographs.size(), length);
  std::vector<image::Image> brightness;
  for (const image::Image& photograph : photographs) {
    require(photograph.size() == photographs.front().size(), "photographs of different sizes");
    brightness.push_back(brightnessOf(photograph));
  }
  ScreenSight best;
  for (int late = 0; late <= settings.mostLate; ++late) {
    const ScreenSight sight = sightAt(brightness, late, settings);
    if (sight.share > best.share) best = sight;
  }
  return best;
}

ScreenProof proveScreen(rig::Projector& screen, const std::vector<rig::Projector*>& others,
                        rig::Camera& camera, const ScreenExposure& exposure,
                        const ScreenProofSettings& settings, Progress& progress) {
  ScreenProof proof;
  proof.exposure = exposure(screen);
  proof.sight = sightThrough(screen, camera, proof.exposure, settings, progress);
  proof.isSeen = proof.sight.share >= settings.leastShare;
  if (!proof.isSeen) {
    for (rig::Projector* other : others)
      if (proof.instead.empty() &&
          sightThrough(*other, camera, exposure(*other), settings, progress).share >= settings.leastShare)
        proof.instead = other->name();
    proof.verdicts.push_back(
        {.finding = proof.instead.empty() ? Finding::screenNotSeen : Finding::otherScreenSeen,
         .screen = screen.name(),
         .instead = proof.instead});
    return proof;
  }
  proof.verdicts.push_back(
      {.finding = Finding::screenSeen, .share = proof.sight.share, .screen = screen.name()});
  if (proof.sight.mirrored) proof.verdicts.push_back({Finding::screenMirrored});
  if (proof.sight.late > 0)
    proof.verdicts.push_back({.finding = Finding::picturesLate, .count = proof.sight.late});
  return proof;
}

void requireSeen(const ScreenProof& proof, const rig::Projector& screen, const rig::Camera& camera) {
  if (proof.isSeen) return;
  if (!proof.instead.empty())
    throw ScreenNotSeen(
        ErrorKind::device,
        RELUCENT_MESSAGE("device.other-screen-seen", "the camera sees {}, not {}")
            .with(proof.instead, screen.name()),
        RELUCENT_MESSAGE("device.choose-or-aim-at-screen", "choose {}, or aim the camera at {}")
            .with(proof.instead, screen.name()),
        camera.name());
  throw ScreenNotSeen(
      ErrorKind::device,
      RELUCENT_MESSAGE("device.screen-not-seen", "the camera does not see what is shown on {}")
          .with(screen.name()),
      RELUCENT_MESSAGE("device.check-projector-and-aim",
                       "check that the projector is on and shows that output, aim the camera at it, and take "
                       "its cap off; or choose another screen"),
      camera.name());
}

}  // namespace relucent::devices
