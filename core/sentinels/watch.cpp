// SPDX-License-Identifier: MIT
#include "sentinels/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

// Total light of equal patterns may differ by this much from round to round, drift taken out.
constexpr double roundsLimit = 0.01;
// Mean squared deviation of a new black from e in units of both variances, above which e has changed; noise
// models are right to 10 or 20 %.
constexpr double changedBlack = 1.4;

Stack black(const Rasters& projectors) {
  return Stack(3 * projectors.count(), 0.0f);
}

HdrFrame lessBlack(HdrFrame frame, const HdrFrame& black) {
  parallelFor(0, frame.radiance.size(), 4096, [&](std::size_t i) {
    frame.radiance[i] -= black.radiance[i];
    frame.variance[i] += black.variance[i];
    frame.valid[i] = frame.valid[i] != 0 && black.valid[i] != 0 ? 1 : 0;
  });
  return frame;
}

HdrFrame brightenedBy(double factor, HdrFrame frame) {
  auto scale = static_cast<float>(factor);
  parallelFor(0, frame.radiance.size(), 4096, [&](std::size_t i) {
    frame.radiance[i] *= scale;
    frame.variance[i] *= scale * scale;
  });
  return frame;
}

double deviation(const HdrFrame& a, const HdrFrame& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.radiance.size(); ++i) {
    double apart = static_cast<double>(a.radiance[i] - b.radiance[i]);
    sum += apart * apart / std::max(1e-30, static_cast<double>(a.variance[i] + b.variance[i]));
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, a.radiance.size()));
}

Alarm flickerAlarm(double apart, const char* safe) {
  return {AlarmKind::flicker,
          fmt::format("the light flickers: photographs of one pattern differ by {:.1f} %", 100.0 * apart),
          fmt::format("{} safe", safe),
          "switch off dimmed and fluorescent lamps and the projector's power saving, then retry"};
}

/// The mean of two estimates of the same, weighted by their variances.
void join(HdrFrame& into, const HdrFrame& other) {
  parallelFor(0, into.radiance.size(), 4096, [&](std::size_t i) {
    float sum = into.variance[i] + other.variance[i];
    if (!(sum > 0.0f) || !other.valid[i]) return;
    float weight = into.variance[i] / sum;
    into.radiance[i] += weight * (other.radiance[i] - into.radiance[i]);
    into.variance[i] *= 1.0f - weight;
  });
}

}  // namespace

Watch::Watch(Photographer& photographer, ShotTaker& shots, References& references,
             const WatchSettings& settings, Decisions& decisions, AcquisitionObserver& observer)
    : photographer_(photographer),
      shots_(shots),
      references_(references),
      settings_(settings),
      decisions_(decisions),
      observer_(observer) {}

Check Watch::photographCheck(const Progress& progress) {
  beginPhotograph();
  HdrFrame black = photographer_.takeAll(relucent::black(projectors()), progress);
  inspectBracket();
  HdrFrame light = photographer_.takeAll(referencePattern(projectors()), progress);
  inspectBracket();
  return {black, lessBlack(std::move(light), black)};
}

void Watch::begin(const Progress& progress) {
  trusted_ = 0;
  if (references_.flicker > roundsLimit)
    handle(flickerAlarm(references_.flicker, "every photograph before the light transport is"), 0);
  for (std::size_t projector = 0; projector < projectors().devices(); ++projector) {
    Stack pattern = referencePattern(projectors(), projector);
    HdrFrame light = lessBlack(photographer_.takeAll(pattern, progress), references_.black);
    if (auto alarm = inspectOrientation(light, projector, references_, cameras(), settings_.mayBeMirrored))
      handle(*alarm, 0);
  }
  first_ = photographCheck(progress);
  last_ = beforeLast_ = {shots_.shots(), 1.0};
  inspectCheck(first_, 1.0, 0);
  follow(first_);
  trusted_ = shots_.shots();
}

void Watch::check(const Progress& progress) {
  if (shots_.shots() == trusted_) return;
  Check now = photographCheck(progress);
  inspectCheck(now, power(), trusted_);
  follow(now);
  trusted_ = shots_.shots();
}

void Watch::inspectCheck(const Check& now, double expectedPower, int doubtful) {
  std::optional<Alarm> alarm = inspect(now, first_, references_, cameras(), expectedPower);
  if (isNew()) {
    Reading reading = readingOf(now, first_, references_, cameras(), expectedPower);
    reading.shot = shots_.shots();
    reading.flicker = std::exchange(flicker_, 0.0);
    if (alarm) reading.alarm = alarm->kind;
    observer_.checked(reading);
  }
  if (!alarm) return;
  handle(*alarm, doubtful);
  if (alarm->kind == AlarmKind::moved || alarm->kind == AlarmKind::localChange)
    first_.light = brightenedBy(1.0 / expectedPower, now.light);  // the view changed, not the lamp
}

void Watch::contradicted(int shot, int patterns) {
  if (isNew()) observer_.takenAgain({shot, patterns, RetakeReason::contradiction});
}

void Watch::handle(const Alarm& alarm, int doubtful) {
  int shot = shots_.shots();
  if (decisions_.putUpWith.contains(shot)) return;
  Answer answer = decisions_.handler ? decisions_.handler(alarm) : Answer::retry;
  if (answer == Answer::skip) {
    decisions_.putUpWith.emplace(shot, alarm.what);
    return;
  }
  shots_.forgetFrom(doubtful);
  decisions_.putUpWith.erase(decisions_.putUpWith.upper_bound(doubtful), decisions_.putUpWith.end());
  if (answer == Answer::keepAndStop) throw KeepAndStop();
  if (!decisions_.handler)
    throw Error(ErrorKind::device, alarm.what, alarm.advice + " by resuming the calibration; " + alarm.safe,
                "light transport");
  observer_.takenAgain({doubtful, shot - doubtful, RetakeReason::alarm, alarm.kind});
  throw BeginAgain();
}

void Watch::checkIfDue(const Progress& progress) {
  if (shots_.shots() - trusted_ >= settings_.checkInterval) check(progress);
}

void Watch::inspectBracket() {
  double apart = photographer_.contradiction();
  flicker_ = std::max(flicker_, apart);
  if (apart < reading_limit::flicker) return;
  handle(flickerAlarm(apart, "every photograph up to the check before is"), trusted_);
}

double Watch::power() const {
  double slope = 0.0;
  if (last_.shot > beforeLast_.shot)
    slope = (last_.value - beforeLast_.value) / (last_.shot - beforeLast_.shot);
  return std::max(1e-3, last_.value + slope * (shots_.shots() - last_.shot));
}

void Watch::follow(const Check& check) {
  if (deviation(check.black, references_.black) > changedBlack)
    references_.black = check.black;
  else
    join(references_.black, check.black);
  beforeLast_ = last_;
  last_ = {shots_.shots(), lampPower(check, first_, references_)};
}

HdrFrame Watch::lightOf(HdrFrame frame) const {
  return brightenedBy(1.0 / power(), lessBlack(std::move(frame), references_.black));
}

HdrFrame Watch::light(const Stack& pattern, const std::vector<Demand>& demands, const Progress& progress,
                      const Meanwhile& meanwhile) {
  checkIfDue(progress);
  beginPhotograph();
  int shot = shots();
  HdrFrame frame = photographer_.take(pattern, demands, progress, meanwhile);
  if (int again = photographer_.overexposed(); again > 0 && isNew())
    observer_.takenAgain({shot, again, RetakeReason::overexposed});
  inspectBracket();
  return lightOf(std::move(frame));
}

HdrFrame Watch::lightOfAll(const Stack& pattern, const Progress& progress, const Meanwhile& meanwhile) {
  checkIfDue(progress);
  beginPhotograph();
  HdrFrame frame = photographer_.takeAll(pattern, progress, meanwhile);
  inspectBracket();
  return lightOf(std::move(frame));
}

}  // namespace relucent
