// SPDX-License-Identifier: MIT
#include "relucent/pipeline/perfecting_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "relucent/compensation/prediction.h"
#include "relucent/pipeline/aim.h"

namespace relucent::pipeline {
namespace {

using compensation::Compensation;

constexpr int roundsOfSteps = 2;    // of the solve between two photographs: more of them gain nothing
constexpr double mostShift = 0.3;   // pixels: T is of a view that has not moved
constexpr double leastLight = 0.5;  // of what is expected: below it a lens is covered or a projector asleep
constexpr double leastValid = 0.9;  // of what is looked at: with less something blinds the camera
constexpr double wrongFromTheFirst = 0.5;  // of light: nothing here is as T has it
// Once something was learned, photographs are nearer to what is expected; beyond this they are of something
// else.
constexpr double wrongLater = 1.5;  // times the first one's
constexpr double alwaysRight = 0.02;
constexpr int again = 2;    // a disturbed photograph is taken so many times more
constexpr int noGains = 2;  // one after the other: it does not get better

double squared(double value) {
  return value * value;
}

/// A photograph of a picture, and what was to be seen on it.
struct Seen {
  hdr::ProjectedLight light;
  CameraStack predicted;  // T p
  CameraStack expected;   // T p + b
};

class Loop {
 public:
  Loop(const compensation::Compensator& compensator, const compensation::Target& target,
       const PerfectingCamera& camera)
      : compensator_(compensator),
        venue_(compensator.venue()),
        target_(target),
        camera_(camera),
        unexplained_(venue_) {}

  void photographBlack() { black_ = camera_.black(); }
  int photographs() const { return photographs_; }

  /// As often as it is disturbed; none: still so, `disturbance` says what by.
  std::optional<Seen> photograph(const ProjectorStack& drive, Message& disturbance) {
    for (int attempt = 0; attempt <= again; ++attempt) {
      Seen seen = taken(drive);
      disturbance = disturbanceOf(seen);
      if (disturbance.empty()) return seen;
    }
    return std::nullopt;
  }

  PerfectingRound roundOf(const Seen& seen) const {
    PerfectingRound round;
    round.error = compensation::weighedError(seen.light, target_);
    round.surprise = surpriseOf(seen).relative;
    // As it would be under the black level that the picture is meant for.
    CameraStack radiance = seen.light.radiance;
    for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] += venue_.black[i];
    const Rasters& cameras = venue_.transport.cameras();
    for (std::size_t view = 0; view < cameras.devices(); ++view) {
      const compensation::ViewError error = compensation::errorIn(view, radiance, target_, cameras);
      round.views.push_back({error.psnrReachable, error.meanDeltaE});
    }
    return round;
  }

  /// Nothing but noise tells what is seen from what was expected.
  bool isExplained(const Seen& seen) const {
    const Surprise surprise = surpriseOf(seen);
    return surprise.energy <= 2.0 * surprise.deviation;
  }
  void learn(const Seen& seen) {
    if (!firstSurprise_) firstSurprise_ = surpriseOf(seen).relative;
    unexplained_.learn(seen.light, seen.predicted);
  }
  Compensation improved(Compensation p, Progress& progress) const {
    return solvedAgain(compensator_, target_, unexplained_.value(), std::move(p), roundsOfSteps, progress);
  }

 private:
  struct Surprise {
    double energy = 0.0;     // sum |light - expected|^2 - variance
    double deviation = 0.0;  // of it, by noise
    double relative = 0.0;   // root of it over the light's
  };

  Seen taken(const ProjectorStack& drive) {
    ++photographs_;
    Seen seen;
    seen.predicted = venue_.transport.apply(drive);
    seen.expected = seen.predicted;
    for (std::size_t i = 0; i < seen.expected.size(); ++i) seen.expected[i] += unexplained_.value()[i];
    seen.light = hdr::ProjectedLight(camera_.photograph(drive), black_);
    return seen;
  }

  bool counts(const Seen& seen, std::size_t i) const {
    return seen.light.valid[i] != 0 && venue_.usable[i / 3] != 0;
  }

  Surprise surpriseOf(const Seen& seen) const {
    Surprise surprise;
    double light = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < seen.expected.size(); ++i) {
      if (!counts(seen, i)) continue;
      const double v = seen.light.variance[i];
      const double apart = squared(static_cast<double>(seen.light.radiance[i]) - seen.expected[i]);
      surprise.energy += apart - v;
      variance += 4.0 * std::max(0.0, apart - v) * v + 2.0 * v * v;
      light += std::max(0.0, squared(seen.light.radiance[i]) - v);
    }
    surprise.deviation = std::sqrt(variance);
    surprise.relative = light > 0.0 ? std::sqrt(std::max(0.0, surprise.energy) / light) : 0.0;
    return surprise;
  }

  /// Where a view has moved to.
  Message movementOf(const Seen& seen) const {
    const Rasters& cameras = venue_.transport.cameras();
    for (std::size_t view = 0; view < cameras.devices(); ++view) {
      const sentinels::Movement moved = aimOffset(image::imageFromStack(seen.expected, cameras, view),
                                                  image::imageFromStack(seen.light.radiance, cameras, view),
                                                  std::numeric_limits<float>::infinity(),
                                                  comparedPixels(venue_.usable, seen.light, cameras, view))
                                            .movement;
      if (!moved.explains || std::hypot(moved.x, moved.y) <= mostShift) continue;
      return RELUCENT_MESSAGE("perfect.camera-moved",
                              "the view of camera {} has moved by {}, {} pixels since the venue was measured")
          .with(as::label(view + 1), as::number(moved.x, as::decimals(1)),
                as::number(moved.y, as::decimals(1)));
    }
    return {};
  }

  Message disturbanceOf(const Seen& seen) const {
    double cross = 0.0, expected = 0.0, valid = 0.0, all = 0.0;
    for (std::size_t i = 0; i < seen.expected.size(); ++i) {
      if (venue_.usable[i / 3] == 0) continue;
      all += 1.0;
      if (seen.light.valid[i] == 0) continue;
      valid += 1.0;
      cross += static_cast<double>(seen.light.radiance[i]) * seen.expected[i];
      expected += squared(seen.expected[i]);
    }
    if (valid < leastValid * all)
      return RELUCENT_MESSAGE("perfect.camera-blinded",
                              "something blinds the camera: {} of its view is overexposed")
          .with(as::share(1.0 - valid / all, as::decimals(0)));
    if (cross < leastLight * expected)
      return RELUCENT_MESSAGE("perfect.light-missing",
                              "light is missing: is the lens covered, or a projector asleep?");
    if (Message moved = movementOf(seen); !moved.empty()) return moved;
    const double limit =
        firstSurprise_ ? std::max(wrongLater * *firstSurprise_, alwaysRight) : wrongFromTheFirst;
    if (surpriseOf(seen).relative > limit)
      return RELUCENT_MESSAGE(
          "perfect.something-else",
          "the camera sees something else than expected: did somebody stand in the light, or "
          "did the room's light change?");
    return {};
  }

  const compensation::Compensator& compensator_;
  const compensation::MeasuredVenue& venue_;
  const compensation::Target& target_;
  const PerfectingCamera& camera_;
  compensation::Unexplained unexplained_;
  hdr::BlackLevel black_;
  std::optional<double> firstSurprise_;
  int photographs_ = 0;
};

/// By more than their noise.
bool isBetter(const compensation::WeighedError& error, const compensation::WeighedError& than) {
  return error.value + 2.0 * std::hypot(error.deviation, than.deviation) < than.value;
}

/// Of what a viewer would say: in no view worse than by what photographs tell apart.
bool areColoursWorse(const PerfectingRound& now, const PerfectingRound& than) {
  constexpr double toldApart = 1.01;
  for (std::size_t view = 0; view < now.views.size(); ++view)
    if (now.views[view].deltaE > toldApart * than.views[view].deltaE) return true;
  return false;
}

}  // namespace

PerfectingResult perfected(const compensation::Compensator& compensator, const compensation::Target& target,
                           Compensation start, const PerfectingCamera& camera, int most,
                           const std::function<void(const PerfectingRound&, const ProjectorStack&)>& told,
                           Progress& progress) {
  require(most >= 1, "{} photographs", most);
  Loop loop(compensator, target, camera);
  PerfectingResult result;
  result.picture = start;
  const auto disturbed = [&] {
    result.end = PerfectingEnd::disturbed;
    result.photographs = loop.photographs();
    return result;
  };
  loop.photographBlack();
  Compensation best = start, p = start;
  compensation::WeighedError bestError;
  int withoutGain = 0;
  for (int round = 0; round < most; ++round) {
    progress.report(static_cast<double>(round) / (most + 2));
    progress.checkpoint();
    const std::optional<Seen> seen = loop.photograph(p.projector, result.disturbance);
    if (!seen) return disturbed();
    const PerfectingRound& now = result.rounds.emplace_back(loop.roundOf(*seen));
    if (told) told(now, p.projector);
    // Of those that noise does not tell apart the last: more was known of it.
    if (round == 0 || now.error.value <= bestError.value + now.error.deviation) {
      withoutGain = round == 0 || isBetter(now.error, bestError) ? 0 : withoutGain + 1;
      best = p;
      bestError = now.error;
    } else {
      ++withoutGain;
    }
    if (withoutGain >= noGains) result.end = PerfectingEnd::noGain;
    // At first the solve, which had a show's time, may still gain.
    if (round > 0 && loop.isExplained(*seen)) result.end = PerfectingEnd::atNoise;
    if (progress.stopAndKeep()) result.end = PerfectingEnd::stopped;
    if (result.end != PerfectingEnd::allTaken || round + 1 == most) break;
    loop.learn(*seen);
    Progress solving = progress.part(0.0, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
    p = loop.improved(std::move(p), solving);
  }
  if (result.rounds.size() < 2) {  // nothing else was tried
    result.before = result.after = result.rounds.front();
    result.photographs = loop.photographs();
    progress.report(1.0);
    return result;
  }
  progress.checkpoint();
  loop.photographBlack();
  for (auto [picture, round] : {std::pair(&start, &result.before), std::pair(&best, &result.after)}) {
    const std::optional<Seen> seen = loop.photograph(picture->projector, result.disturbance);
    if (!seen) return disturbed();
    *round = loop.roundOf(*seen);
  }
  result.better =
      isBetter(result.after.error, result.before.error) && !areColoursWorse(result.after, result.before);
  if (result.better) result.picture = std::move(best);
  result.photographs = loop.photographs();
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
