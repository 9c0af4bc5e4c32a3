// SPDX-License-Identifier: MIT
#include "relucent/compensation/uncorrectable.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/correspondence.h"

namespace relucent::compensation {
namespace {

/// Of one camera the pixels that look to where another one looks to with more light.
class SecondViews {
 public:
  SecondViews(const MeasuredVenue& venue, const std::vector<DirectLook>& looks,
              const std::vector<std::uint8_t>& candidates, const UncorrectableSettings& settings)
      : venue_(venue), looks_(looks), candidates_(candidates), settings_(settings) {}

  void mark(std::size_t camera, std::vector<std::uint8_t>& twice) const {
    const Rasters& cameras = venue_.transport.cameras();
    Size size = cameras.size(camera);
    std::size_t first = cameras.offset(camera);
    CameraMask ofCamera(candidates_.size(), 0);
    std::copy_n(candidates_.begin() + static_cast<std::ptrdiff_t>(first), size.count(),
                ofCamera.begin() + static_cast<std::ptrdiff_t>(first));
    std::vector<std::int32_t> brightest =
        brightestCorrespondence(venue_.transport, ofCamera, settings_.direct);

    double apart = std::max(3.0, settings_.apart * std::max(size.width, size.height));
    for (std::size_t i = first; i < first + size.count(); ++i) {
      if (!candidates_[i] || looks_[i].projectorPixel < 0) continue;
      std::int32_t owner = brightest[static_cast<std::size_t>(looks_[i].projectorPixel)];
      if (owner < 0) continue;
      auto other = static_cast<std::size_t>(owner);
      Pixel a = pixelAt(size, i - first), b = pixelAt(size, other - first);
      if (std::hypot(a.x - b.x, a.y - b.y) <= apart) continue;
      twice[i] = 1;
      bool comparable = static_cast<double>(looks_[i].light) >=
                        settings_.comparable * static_cast<double>(looks_[other].light);
      if (comparable) twice[other] = 1;
    }
  }

 private:
  const MeasuredVenue& venue_;
  const std::vector<DirectLook>& looks_;
  const std::vector<std::uint8_t>& candidates_;
  const UncorrectableSettings& settings_;
};

/// What the projector's limits say of a pixel.
Uncorrectable byBrightness(const MeasuredVenue& venue, const Target& target, std::size_t i) {
  const CameraStack& flood = floodOf(venue, target);
  bool dark = false, bright = false;
  for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
    dark = dark || !(target.wanted[c] <= venue.black[c] + flood[c]);
    bright = bright || target.wanted[c] < venue.black[c];
  }
  return dark ? Uncorrectable::tooDark : bright ? Uncorrectable::tooBright : Uncorrectable::none;
}

}  // namespace

std::vector<Message> problems(const UncorrectableSettings& settings) {
  std::vector<Message> found = problems(settings.direct);
  auto share = [&](double value, const Message& sentence) {
    if (!(value >= 0.0 && value <= 1.0)) found.push_back(sentence);
  };
  share(settings.leastDirectShare,
        RELUCENT_ENGLISH_MESSAGE("compensation.direct-share-out-of-range",
                                 "the least share of direct light must lie between 0 and 1"));
  share(settings.apart,
        RELUCENT_ENGLISH_MESSAGE("compensation.view-distance-out-of-range",
                                 "the distance of two views must lie between 0 and 1 of the camera's side"));
  share(settings.comparable,
        RELUCENT_ENGLISH_MESSAGE("compensation.comparable-share-out-of-range",
                                 "the share of light that is comparable must lie between 0 and 1"));
  return found;
}

std::vector<Uncorrectable> uncorrectableMap(const MeasuredVenue& venue, const Target& target,
                                            const UncorrectableSettings& settings, Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "settings of the uncorrectable pixels: {}", fmt::join(wrong, "; "));
  std::size_t pixels = venue.transport.cameras().count();
  require(target.inside.size() == pixels && venue.usable.size() == pixels,
          "a target of {} pixels and {} flags for {} camera pixels", target.inside.size(),
          venue.usable.size(), pixels);

  Progress looking = progress.part(0.6, RELUCENT_MESSAGE("stage.finding-shadows", "Looking for shadows"));
  std::vector<DirectLook> looks = directLooks(venue.transport, settings.direct, looking);
  CameraMask lit = directlyLit(looks, settings.leastDirectShare), twice(pixels, 0);
  for (std::size_t i = 0; i < pixels; ++i) lit[i] = lit[i] && venue.usable[i];
  SecondViews views(venue, looks, lit, settings);
  for (std::size_t camera = 0; camera < venue.transport.cameras().devices(); ++camera) {
    progress.checkpoint();
    views.mark(camera, twice);
  }

  std::vector<Uncorrectable> map(pixels, Uncorrectable::outside);
  parallelFor(0, pixels, 1024, [&](std::size_t i) {
    if (!target.inside[i]) return;
    if (!venue.usable[i])
      map[i] = Uncorrectable::unlit;
    else if (!lit[i])
      map[i] = Uncorrectable::shadowed;
    else if (twice[i])
      map[i] = Uncorrectable::seenTwice;
    else
      map[i] = byBrightness(venue, target, i);
  });
  progress.report(1.0);
  return map;
}

std::array<double, allReasons.size()> sharesOf(const std::vector<Uncorrectable>& map) {
  std::array<double, allReasons.size()> shares{};
  double inside = 0.0;
  for (Uncorrectable reason : map) {
    if (reason == Uncorrectable::outside) continue;
    shares[static_cast<std::size_t>(reason)] += 1.0;
    inside += 1.0;
  }
  for (double& share : shares) share = inside > 0.0 ? share / inside : 0.0;
  return shares;
}

UnreachableShares unreachableShares(const MeasuredVenue& venue, const Target& target) {
  UnreachableShares shares;
  double inside = 0.0;
  const std::size_t pixels = venue.transport.cameras().size(0).count();
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!target.inside[i]) continue;
    inside += 1.0;
    if (target.reachable[i]) continue;
    const bool isBright = venue.usable[i] && byBrightness(venue, target, i) == Uncorrectable::tooBright;
    (isBright ? shares.tooBright : shares.tooDark) += 1.0;
  }
  if (!(inside > 0.0)) return {};
  return {shares.tooDark / inside, shares.tooBright / inside};
}

}  // namespace relucent::compensation
