// SPDX-License-Identifier: MIT
#include "relucent/sentinels/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/rig/device_given_up.h"
#include "relucent/sentinels/black_following.h"

namespace relucent::sentinels {
namespace {

// Total light of equal patterns may differ by this much from round to round, drift taken out.
constexpr double roundsLimit = 0.01;
// A pattern that is dark each time, though no check finds anything, is believed: few blocks of it are in
// view.
constexpr int mostDark = 3;

ProjectorStack black(const Rasters& projectors) {
  return ProjectorStack(3 * projectors.count(), 0.0f);
}

ProjectorStack white(const Rasters& projectors) {
  return ProjectorStack(3 * projectors.count(), 1.0f);
}

constexpr auto leaveIt = RELUCENT_MESSAGE("alarm.leave-it-as-it-is",
                                          "leave it as it is now, then try again: measuring begins again");
constexpr auto safeBeforeTransport = RELUCENT_MESSAGE("alarm.safe-before-light-transport",
                                                      "every photograph before the light transport is safe");

}  // namespace

void Supervision::remember(const Alarm& alarm) {
  if (alarm.patterns == 0) return;
  for (Again& known : again)
    if (known.first == alarm.first && english(known.what) == english(alarm.what)) {
      known.patterns += alarm.patterns;
      return;
    }
  again.push_back({alarm.what, alarm.first, alarm.patterns});
}

Watch::Watch(photography::Photographer& photographer, const photography::References& references,
             const WatchSettings& settings, Supervision& supervision)
    : photographer_(photographer),
      shots_(photographer.shots()),
      references_(references),
      settings_(settings),
      supervision_(supervision),
      black_(references.black) {}

Interruptible<hdr::HdrFrame> Watch::photographed(const Photograph& photograph) {
  try {
    hdr::HdrFrame frame = photograph();
    if (auto interrupted = inspectBracket()) return *interrupted;
    return frame;
  } catch (const rig::DeviceGivenUp&) {
    return Interruption::keepAndStop;
  }
}

Interruptible<Check> Watch::photographCheck(const Progress& progress) {
  photographedBefore_ = shots_.times().shots;
  const Rasters& projectors = references_.projectors;
  auto black = photographed([&] { return photographer_.takeAll(sentinels::black(projectors), progress); });
  if (!black) return black.interruption();
  auto light = photographed([&] { return photographer_.takeAll(referencePattern(projectors), progress); });
  if (!light) return light.interruption();
  hdr::BlackLevel level(*std::move(black));
  hdr::ProjectedLight projected(*std::move(light), level);
  return Check{std::move(level), std::move(projected)};
}

std::optional<Interruption> Watch::inspectProjectors(const Check& check, const Progress& progress) {
  const Rasters& projectors = references_.projectors;
  // The only projector's reference picture is the check's.
  if (projectors.devices() == 1) return inspectOrientation(check.light, 0);
  const std::size_t shortest = photographer_.exposures() - 1;
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    const ProjectorStack pattern = referencePattern(projectors, projector);
    // Only what is bright tells.
    auto seen = photographed([&] { return photographer_.takeAt(pattern, {shortest}, progress); });
    if (!seen) return seen.interruption();
    const hdr::ProjectedLight light(*std::move(seen), check.black);
    if (auto interrupted = inspectOrientation(light, projector)) return interrupted;
  }
  return std::nullopt;
}

std::optional<Interruption> Watch::inspectOrientation(const hdr::ProjectedLight& light,
                                                      std::size_t projector) {
  std::optional<Alarm> alarm =
      sentinels::inspectOrientation(light, projector, references_, settings_.mayBeMirrored);
  return alarm ? handle(*alarm, 0) : std::nullopt;
}

std::optional<Interruption> Watch::inspectReferences(const Check& check, const Progress& progress) {
  const ProjectorStack pattern = white(references_.projectors);
  auto seen = photographed([&] { return photographer_.takeAll(pattern, progress); });
  if (!seen) return seen.interruption();
  // Less the black just before: the room's light may have changed since the floods.
  const hdr::ProjectedLight light(*std::move(seen), check.black);
  std::optional<Alarm> alarm = inspectDarkness({check.black, light}, pattern, references_);
  if (!alarm) alarm = inspectFloods(light, references_);
  // What moved among the floods makes their sums differ too.
  if (!alarm && references_.flicker > roundsLimit) alarm = flickerAlarm(references_.flicker);
  return alarm ? handle(*alarm, 0) : std::nullopt;
}

std::optional<Interruption> Watch::begin(const Progress& progress) {
  trusted_ = 0;
  Interruptible<Check> check = photographCheck(progress);
  if (!check) return check.interruption();
  if (auto dark = inspectDarkness(*check, referencePattern(references_.projectors), references_))
    if (auto interrupted = handle(*dark, 0)) return interrupted;
  if (auto interrupted = inspectProjectors(*check, progress)) return interrupted;
  first_ = {check->black, hdr::LampLight(check->light, 1.0)};
  last_ = beforeLast_ = {shots_.shots(), 1.0};
  if (auto interrupted = inspectCheck(*check, 1.0, 0)) return interrupted;
  if (auto interrupted = inspectReferences(*check, progress)) return interrupted;
  follow(*check);
  trusted_ = shots_.shots();
  return std::nullopt;
}

std::optional<Interruption> Watch::check(const Progress& progress) {
  if (shots_.shots() == trusted_) return std::nullopt;
  Interruptible<Check> now = photographCheck(progress);
  if (!now) return now.interruption();
  if (auto interrupted = inspectCheck(*now, power(), trusted_)) return interrupted;
  isFirstConfirmed_ = true;
  follow(*now);
  trusted_ = shots_.shots();
  return std::nullopt;
}

std::optional<Interruption> Watch::inspectCheck(const Check& now, double expectedPower, int doubtful) {
  Baseline baseline{references_, black_, first_, expectedPower};
  std::optional<Alarm> alarm = inspect(now, baseline);
  if (isNew()) {
    Reading reading = readingOf(now, baseline);
    reading.shot = shots_.shots();
    reading.flicker = std::exchange(flicker_, 0.0);
    if (alarm) reading.alarm = alarm->kind;
    supervision_.observer.checked(reading);
  }
  if (!alarm) return std::nullopt;
  // What differs from the first look alone may have been there then.
  const bool mayBeOfFirst = !isFirstConfirmed_ && (alarm->mayStay || alarm->kind == AlarmKind::localChange);
  if (auto interrupted = handle(*alarm, mayBeOfFirst ? 0 : doubtful)) return interrupted;
  if (alarm->kind == AlarmKind::moved || alarm->kind == AlarmKind::localChange)
    first_.light = hdr::LampLight(now.light, expectedPower);  // the view changed, not the lamp
  return std::nullopt;
}

void Watch::contradicted(int shot, int patterns) {
  if (isNew()) supervision_.observer.takenAgain({shot, patterns, RetakeReason::contradiction});
}

std::optional<Interruption> Watch::handle(const Alarm& raised, int doubtful) {
  int shot = shots_.shots();
  Alarm alarm = raised;
  alarm.first = doubtful;
  alarm.patterns = shot - doubtful;
  if (doubtful == 0) {
    alarm.safe = safeBeforeTransport;
    if (alarm.mayStay) alarm.advice = leaveIt;
  }
  auto& accepted = supervision_.accepted;
  const std::pair asked{shot, alarm.kind};
  if (accepted.contains(asked)) return std::nullopt;
  const auto isEnding = [this] { return supervision_.isEnding && supervision_.isEnding(); };
  Answer answer = supervision_.handler && !isEnding() ? supervision_.handler(alarm) : Answer::retry;
  // Perhaps since it was asked.
  if (answer == Answer::retry && isEnding()) answer = Answer::keepAndStop;
  if (answer == Answer::skip) {
    accepted.emplace(asked, alarm.what);
    return std::nullopt;
  }
  shots_.forgetFrom(doubtful);
  accepted.erase(accepted.lower_bound({doubtful + 1, AlarmKind{}}), accepted.end());
  if (answer == Answer::keepAndStop) {
    supervision_.endedBy = alarm;
    return Interruption::keepAndStop;
  }
  if (!supervision_.handler)
    throw Error(ErrorKind::device, alarm.what,
                RELUCENT_MESSAGE("alarm.by-resuming", "{} by resuming the calibration; {}")
                    .with(alarm.advice, alarm.safe),
                "light transport");
  supervision_.remember(alarm);
  supervision_.observer.takenAgain({doubtful, shot - doubtful, RetakeReason::alarm, alarm.kind});
  return Interruption::beginAgain;
}

std::optional<Interruption> Watch::inspectBracket() {
  const double apart = photographer_.contradiction();
  if (apart < reading_limit::flicker) {
    flicker_ = std::max(flicker_, apart);
    return std::nullopt;
  }
  static_assert(photography::Photographer::worthALook <= reading_limit::flicker);
  const Alarm alarm = inspectContradiction(apart, *photographer_.contradictoryViews(), references_);
  // What moved, and the room's light, say nothing of the projector's.
  if (alarm.kind != AlarmKind::moved && alarm.kind != AlarmKind::ambientChanged)
    flicker_ = std::max(flicker_, apart);
  return handle(alarm, trusted_);
}

double Watch::power() const {
  double slope = 0.0;
  if (last_.shot > beforeLast_.shot)
    slope = (last_.value - beforeLast_.value) / (last_.shot - beforeLast_.shot);
  return std::max(1e-3, last_.value + slope * (shots_.shots() - last_.shot));
}

void Watch::follow(const Check& check) {
  if (hasChanged(check.black, black_))
    black_ = check.black;
  else
    join(black_, check.black);
  beforeLast_ = last_;
  last_ = {shots_.shots(), lampPower(check, first_, references_)};
}

Interruptible<hdr::LampLight> Watch::lightOf(const Photograph& photograph, const Progress& progress) {
  if (shots_.shots() - trusted_ >= settings_.checkInterval)
    if (auto interrupted = check(progress)) return *interrupted;
  photographedBefore_ = shots_.times().shots;
  Interruptible<hdr::HdrFrame> frame = photographed(photograph);
  if (!frame) return frame.interruption();
  return hdr::LampLight(hdr::ProjectedLight(*std::move(frame), black_), power());
}

Interruptible<hdr::LampLight> Watch::light(const ProjectorStack& pattern,
                                           const std::vector<photography::Demand>& demands,
                                           const Progress& progress,
                                           const photography::Meanwhile& meanwhile) {
  auto take = [&] {
    int shot = shots();
    hdr::HdrFrame frame = photographer_.take(pattern, demands, progress, meanwhile);
    if (int again = photographer_.overexposed(); again > 0 && isNew())
      supervision_.observer.takenAgain({shot, again, RetakeReason::overexposed});
    return frame;
  };
  return lightOf(take, progress);
}

Interruptible<hdr::LampLight> Watch::unlessDark(const ProjectorStack& pattern, const Take& take,
                                                const Progress& progress) {
  for (int again = 0;; ++again) {
    Interruptible<hdr::LampLight> seen = take();
    if (!seen || again == mostDark || lightShare(*seen, pattern, references_) > darkShare) return seen;
    const int shot = shots() - 1;
    const bool isSeenNow = isNew();
    if (auto interrupted = check(progress)) return *interrupted;
    if (isSeenNow) supervision_.observer.takenAgain({shot, 1, RetakeReason::dark});
  }
}

Interruptible<hdr::LampLight> Watch::lightOfRandom(const ProjectorStack& pattern,
                                                   const std::vector<photography::Demand>& demands,
                                                   const Progress& progress) {
  return unlessDark(pattern, [&] { return light(pattern, demands, progress); }, progress);
}

Interruptible<hdr::LampLight> Watch::lightOfRandomAt(const ProjectorStack& pattern,
                                                     const std::vector<std::size_t>& exposures,
                                                     const Progress& progress) {
  const Photograph photograph = [&] { return photographer_.takeAt(pattern, exposures, progress); };
  return unlessDark(pattern, [&] { return lightOf(photograph, progress); }, progress);
}

Interruptible<hdr::LampLight> Watch::lightOfAll(const ProjectorStack& pattern, const Progress& progress,
                                                const photography::Meanwhile& meanwhile) {
  return lightOf([&] { return photographer_.takeAll(pattern, progress, meanwhile); }, progress);
}

}  // namespace relucent::sentinels
