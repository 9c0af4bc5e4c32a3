// SPDX-License-Identifier: MIT
#include "relucent/reduction/choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/linearization/camera_response.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/linearization/test_light.h"
#include "relucent/linearization/thinning.h"
#include "relucent/reduction/lit_part.h"
#include "relucent/reduction/reduced_rig.h"

namespace relucent::reduction {
namespace {

constexpr double asMany = 0.75;        // as the projectors' pixels: about as many
constexpr double worthwhile = 0.75;    // of the camera's pixels may remain
constexpr double mostClipped = 0.005;  // of the samples: hardly any
constexpr double hotDeviations = 8.0;
constexpr double hotLeast = 0.02;
constexpr double mostHot = 0.01;

using Responses = std::array<hdr::ResponseCurve, 3>;

/// Through sparse cameras.
class Look {
 public:
  Look(rig::Rig& rig, std::uint64_t seed, Progress& progress)
      : sparse_(sparse(rig, mostLookedAt)), shots_(sparse_, log_, "reduction"), seed_(seed) {
    Progress exposing =
        progress.part(0.8, RELUCENT_MESSAGE("stage.finding-exposure", "Finding the exposure"));
    choice_ = linearization::chooseExposures(shots_, exposing);
  }

  double saturation(std::size_t camera) const { return choice_.saturation[camera]; }
  double longest() const { return choice_.seconds.front(); }

  /// The identity where a camera is linear.
  Responses responsesOf(std::size_t camera, const Progress& progress) {
    std::vector<double> seconds;
    for (const rig::Shot& shot : choice_.whites)
      seconds.insert(seconds.end(), shot.exposuresAsked.begin(), shot.exposuresAsked.end());
    if (linearization::looksLinear(*linearization::atExposures(choice_.whites, seconds), camera,
                                   saturation(camera)))
      return {};
    if (!greys_) {
      const linearization::Thinning thinning(sparse_.cameraRasters());
      greys_ = thinning.of(shots_.take(
          linearization::randomGreys(sparse_, seed_),
          linearization::responseBracket(linearization::commonRange(sparse_), choice_.seconds), progress));
    }
    return linearization::cameraResponse(*greys_, camera, saturation(camera)).curves;
  }

  const linearization::ExposureChoice& exposures() const { return choice_; }

 private:
  rig::NoShotLog log_;
  rig::Rig sparse_;
  rig::ShotTaker shots_;
  std::uint64_t seed_;
  linearization::ExposureChoice choice_;
  std::optional<rig::Shot> greys_;
};

int binFor(std::size_t lit, std::size_t projectors) {
  return static_cast<int>(std::sqrt(static_cast<double>(lit) / (asMany * static_cast<double>(projectors))));
}

/// The middle one of the eight samples of the same channel around each.
float around(const image::Image& picture, int x, int y, int channel) {
  std::array<float, 8> values{};
  std::size_t count = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < picture.width() && y + dy < picture.height();
      if (inside && (dx != 0 || dy != 0)) values[count++] = picture.at(x + dx, y + dy, channel);
    }
  if (count == 0) return picture.at(x, y, channel);
  auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace

std::vector<std::uint32_t> hotSamples(const image::Image& dark, const image::Image& again) {
  require(dark.size() == again.size() && dark.channels() == 3 && again.channels() == 3,
          "photographs of {}x{} and {}x{} pixels", dark.width(), dark.height(), again.width(),
          again.height());
  // The median of differences, which a few hot samples do not change: 1.4826 of it is a normal deviation.
  std::vector<float> apart(dark.data().size());
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i] = std::abs(dark.data()[i] - again.data()[i]);
  auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
  std::ranges::nth_element(apart, middle);
  const double deviation = 1.4826 * static_cast<double>(*middle) / std::sqrt(2.0);
  const double least = std::max(hotDeviations * deviation, hotLeast);

  std::vector<std::uint8_t> hot(dark.data().size(), 0);
  parallelFor(0, static_cast<std::size_t>(dark.height()), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < dark.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        const bool first = static_cast<double>(dark.at(x, y, c) - around(dark, x, y, c)) > least;
        const bool second = static_cast<double>(again.at(x, y, c) - around(again, x, y, c)) > least;
        hot[3 * indexOf(dark.size(), {x, y}) + static_cast<std::size_t>(c)] = first && second;
      }
  });
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < hot.size(); ++i)
    if (hot[i] != 0) found.push_back(static_cast<std::uint32_t>(i));
  if (static_cast<double>(found.size()) > mostHot * static_cast<double>(hot.size())) found.clear();
  return found;
}

image::Image lightOf(const linearization::ExposureChoice& exposures, std::size_t camera,
                     const Responses& responses, int stride) {
  std::vector<double> asked = exposures.black.exposuresAsked;
  std::ranges::sort(asked, std::greater<>());
  image::Image light;
  for (double seconds : asked) {
    // Whole shots are large: only what is looked at is copied.
    auto signalOf = [&](std::span<const rig::Shot> shots) {
      for (const rig::Shot& shot : shots)
        for (std::size_t exposure = 0; exposure < shot.exposuresAsked.size(); ++exposure)
          if (shot.exposuresAsked[exposure] == seconds)
            return everyNth(shot.frames[exposure][camera].signal, stride);
      require(false, "white was not photographed at {} s, as black was", seconds);
      return image::Image();
    };
    const image::Image bright = signalOf(exposures.whites), dark = signalOf({&exposures.black, 1});
    light = image::Image(bright.size(), 3);
    std::size_t clipped = 0;
    for (std::size_t i = 0; i < light.data().size(); ++i) {
      const hdr::ResponseCurve& response = responses[i % 3];
      clipped += static_cast<double>(bright.data()[i]) >= exposures.saturation[camera];
      light.data()[i] = static_cast<float>(response(static_cast<double>(bright.data()[i])) -
                                           response(static_cast<double>(dark.data()[i])));
    }
    if (static_cast<double>(clipped) <= mostClipped * static_cast<double>(light.data().size())) break;
  }
  return light;
}

bool needsLook(Size camera, std::size_t projectorPixels, const PixelUse& use) {
  if (use.kind != PixelUse::Kind::automatic) return use.kind == PixelUse::Kind::binned;
  return camera.count() > projectorPixels;
}

Reduction reductionFor(Size camera, std::size_t projectorPixels, const PixelUse& use,
                       const image::Image& light, int stride) {
  require(stride >= 1, "every {}-th pixel", stride);
  LitPart part = litPart(light);
  if (part.size.empty()) return noReduction(camera);
  const auto each = static_cast<std::size_t>(stride * stride);
  part.begin = {part.begin.x * stride, part.begin.y * stride};
  part.size = {std::min(part.size.width * stride, camera.width - part.begin.x),
               std::min(part.size.height * stride, camera.height - part.begin.y)};
  part = withSurroundings(part, camera);
  const int wanted =
      use.kind == PixelUse::Kind::binned ? use.bin : binFor(part.pixels * each, projectorPixels);
  const int most = std::min(mostBin, std::min(part.size.width, part.size.height) / leastSide);
  const int bin = std::clamp(wanted, 1, std::max(1, most));
  const Reduction reduction = reductionTo(camera, part.begin, part.size, bin);
  const bool little =
      static_cast<double>(reduction.size().count()) > worthwhile * static_cast<double>(camera.count());
  return use.kind == PixelUse::Kind::automatic && little ? noReduction(camera) : reduction;
}

std::optional<Reduction> withLargerBins(const Reduction& reduction, std::size_t projectorPixels,
                                        const image::Image& light, int stride) {
  const PixelUse larger{PixelUse::Kind::binned, reduction.bin + 1};
  if (larger.bin > mostBin) return std::nullopt;
  Reduction result = reductionFor(reduction.camera, projectorPixels, larger, light, stride);
  if (result.bin <= reduction.bin) return std::nullopt;
  result.savesMemory = true;
  return result;
}

std::vector<Reduction> chooseReductions(rig::Rig& rig, const PixelUse& use, std::uint64_t seed,
                                        const Fits& fits, Progress& progress) {
  const std::size_t projectors = rig.projectorRasters().count();
  const bool mayGrow = use.kind == PixelUse::Kind::automatic;
  const bool isTooMuch = mayGrow && !fits(rig.cameraRasters());
  auto isLookedAt = [&](const auto& camera) {
    return isTooMuch || needsLook(camera->size(), projectors, use);
  };
  if (std::ranges::none_of(rig.cameras, isLookedAt)) return {};
  Look look(rig, seed, progress);
  std::vector<Reduction> reductions;
  std::vector<Responses> responses(rig.cameras.size());
  std::vector<image::Image> lights(rig.cameras.size());
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    const Size size = rig.cameras[camera]->size();
    reductions.push_back(noReduction(size));
    if (!isLookedAt(rig.cameras[camera])) continue;
    responses[camera] = look.responsesOf(camera, progress);
    lights[camera] = lightOf(look.exposures(), camera, responses[camera]);
    reductions.back() = reductionFor(size, projectors, use, lights[camera], strideFor(size, mostLookedAt));
  }
  for (bool grows = mayGrow; grows && !fits(reducedRasters(reductions));) {
    grows = false;
    for (std::size_t camera = 0; camera < reductions.size(); ++camera) {
      if (lights[camera].empty()) continue;
      const int stride = strideFor(reductions[camera].camera, mostLookedAt);
      const auto larger = withLargerBins(reductions[camera], projectors, lights[camera], stride);
      if (larger) reductions[camera] = *larger;
      grows = grows || larger;
    }
  }
  bool bins = false;
  for (std::size_t camera = 0; camera < reductions.size(); ++camera) {
    if (reductions[camera].bin == 1) continue;
    bins = true;
    reductions[camera].response = responses[camera];
    reductions[camera].clip = look.saturation(camera) / hdr::saturationMargin;
  }

  if (bins) {
    Progress darkness = progress.part(
        0.2, RELUCENT_MESSAGE("stage.looking-for-hot-pixels", "Looking for hot pixels of the camera"));
    rig::NoShotLog log;
    rig::ShotTaker shots(rig, log, "darkness");
    const std::vector<image::Image> black = linearization::evenPatterns(rig, {0, 0, 0});
    const rig::Shot dark = shots.take(black, {look.longest()}, darkness);
    const rig::Shot again = shots.take(black, {look.longest()}, darkness);
    for (std::size_t camera = 0; camera < reductions.size(); ++camera)
      if (reductions[camera].bin > 1)
        reductions[camera].defective =
            hotSamples(dark.frames[0][camera].signal, again.frames[0][camera].signal);
  }
  progress.report(1.0);
  return reductions;
}

}  // namespace relucent::reduction
