// SPDX-License-Identifier: MIT
#include "relucent/venue/surprises.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "relucent/base/random.h"
#include "relucent/base/require.h"

namespace relucent::venue {
namespace {

constexpr const char* measuring = "acquisition";
constexpr const char* pushingBack = "nudge";
constexpr double earliest = 1.0 / 6.0, latest = 1.0 / 2.0;  // of the patterns
constexpr int leastPattern = 12;                    // after the first floods, by which all is compared
constexpr int looksBefore = 4, looksOfPushing = 6;  // that a camera needs to be at its place again

}  // namespace

/// The span is cut into as many parts as there are surprises; each has one for itself, so that one is put
/// right before the next comes.
Surprises::Surprises(const SurpriseSettings& settings, const SurprisesSoFar& soFar)
    : settings_(settings), failures_(soFar.failures), looks_(soFar.looks) {
  Random random{settings.seed, 0x5u};
  std::vector<Surprise> order = settings.kinds;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  const double begin = earliest * settings.patterns, span = (latest - earliest) * settings.patterns;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double part = (static_cast<double>(i) + random.uniform()) / static_cast<double>(order.size());
    planned_.push_back({order[i], std::max(leastPattern, static_cast<int>(begin + part * span))});
  }
  for (const Surprise kind : soFar.lasting)
    if (Planned* planned = find(kind)) planned->state = State::lasts;
  for (const Surprise kind : soFar.over)
    if (Planned* planned = find(kind)) planned->state = State::over;
}

SurprisesSoFar Surprises::soFar() const {
  std::lock_guard lock(guard_);
  return countedSoFar();
}

/// Contract: guard_ is held.
SurprisesSoFar Surprises::countedSoFar() const {
  SurprisesSoFar now{{}, {}, failures_, looks_};
  for (const Planned& planned : planned_) {
    if (planned.state == State::lasts) now.lasting.push_back(planned.kind);
    if (planned.state == State::over) now.over.push_back(planned.kind);
  }
  return now;
}

Surprises::Planned* Surprises::find(Surprise kind) {
  const auto found = std::ranges::find(planned_, kind, &Planned::kind);
  return found != planned_.end() ? &*found : nullptr;
}

const Surprises::Planned* Surprises::find(Surprise kind) const {
  const auto found = std::ranges::find(planned_, kind, &Planned::kind);
  return found != planned_.end() ? &*found : nullptr;
}

int Surprises::momentOf(Surprise kind) const {
  const Planned* planned = find(kind);
  require(planned != nullptr, "there is no such surprise");
  return planned->moment;
}

bool Surprises::hasHappened(Surprise kind) const {
  std::lock_guard lock(guard_);
  const Planned* planned = find(kind);
  return planned != nullptr && planned->state != State::toCome;
}

bool Surprises::lasts(Surprise kind) const {
  std::lock_guard lock(guard_);
  const Planned* planned = find(kind);
  return planned != nullptr && planned->state == State::lasts;
}

std::vector<DeviceFault> Surprises::during(const rig::ShotId& shot) {
  std::unique_lock lock(guard_);
  const SurprisesSoFar before = countedSoFar();
  std::vector<DeviceFault> faults = faultsDuring(shot);
  const bool isChanged = countedSoFar() != before;
  lock.unlock();
  if (isChanged && changed_) changed_(*this);
  return faults;
}

/// Contract: guard_ is held.
std::vector<DeviceFault> Surprises::faultsDuring(const rig::ShotId& shot) {
  std::vector<DeviceFault> faults;
  for (Planned& planned : planned_) {
    if (planned.state == State::toCome && shot.stage == measuring && shot.number >= planned.moment)
      planned.state = State::lasts;
    if (planned.state == State::lasts) faults.push_back(faultOf(planned, shot));
  }
  return faults;
}

DeviceFault Surprises::faultOf(Planned& planned, const rig::ShotId& shot) {
  DeviceFault fault;
  switch (planned.kind) {
    case Surprise::bump: {
      if (shot.stage == pushingBack) ++looks_;
      const double left =
          std::clamp(1.0 - static_cast<double>(looks_ - looksBefore) / looksOfPushing, 0.0, 1.0);
      fault.kind = FaultKind::shiftedCamera;
      fault.amount = left * settings_.shift;
      fault.degrees = left * settings_.degrees;
      if (left == 0.0) planned.state = State::over;
      return fault;
    }
    case Surprise::roomLight:
      fault.kind = FaultKind::ambient;
      fault.amount = settings_.roomLight;
      return fault;
    case Surprise::unplugged:
      fault.kind = FaultKind::unplugged;
      if (++failures_ >= settings_.failures) planned.state = State::over;
      return fault;
  }
  return fault;
}

void Surprises::putRight() {
  std::unique_lock lock(guard_);
  Planned* light = find(Surprise::roomLight);
  if (light == nullptr || light->state != State::lasts) return;
  light->state = State::over;
  lock.unlock();
  if (changed_) changed_(*this);
}

}  // namespace relucent::venue
