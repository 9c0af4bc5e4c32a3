// SPDX-License-Identifier: MIT
#include "wizard/acquire/acquisition_trace.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "views/number_text.h"

namespace relucent::gui {
namespace {

/// Hundredths of a percent: limits are tenths.
QString fineShare(double share) {
  return isolated(decimalText(100.0 * share, 2) + QString::fromUtf8("\u202f%"));
}

bool isOf(const sentinels::Reading& reading, std::initializer_list<sentinels::AlarmKind> kinds) {
  return reading.alarm && std::find(kinds.begin(), kinds.end(), *reading.alarm) != kinds.end();
}

/// Also where the alarm is another one, of which there is one at a time.
bool isRoomSteady(const sentinels::Reading& reading) {
  const double off = std::abs(reading.roomLight - reading.roomLightExpected);
  return !isOf(reading, {sentinels::AlarmKind::ambientChanged}) && off <= sentinels::reading_limit::roomLight;
}

QString reasonOfRetake(const sentinels::Retake& retake) {
  switch (retake.reason) {
    case sentinels::RetakeReason::alarm:
      return AcquisitionTrace::reasonOf(retake.alarm.value_or(sentinels::AlarmKind::localChange));
    case sentinels::RetakeReason::overexposed:
      return AcquisitionTrace::tr("too bright, shorter exposure");
    case sentinels::RetakeReason::contradiction:
      return AcquisitionTrace::tr("does not fit what was seen before");
    case sentinels::RetakeReason::dark:
      return AcquisitionTrace::tr("dark: lens covered for a moment?");
  }
  return {};
}

/// People count from one.
QString patternsOf(const sentinels::Retake& retake) {
  auto first = static_cast<std::uint64_t>(retake.shot) + 1;
  if (retake.patterns < 2 || retake.reason == sentinels::RetakeReason::overexposed)
    return AcquisitionTrace::tr("No. %1").arg(countText(first));
  return AcquisitionTrace::tr("No. %1 to %2")
      .arg(countText(first), countText(first + static_cast<std::uint64_t>(retake.patterns) - 1));
}

}  // namespace

QString AcquisitionTrace::reasonOf(sentinels::AlarmKind kind) {
  switch (kind) {
    case sentinels::AlarmKind::flicker:
      return AcquisitionTrace::tr("the light flickered");
    case sentinels::AlarmKind::unsteady:
      return AcquisitionTrace::tr("the light flickered, or something moved");
    case sentinels::AlarmKind::ambientChanged:
      return AcquisitionTrace::tr("the room light changed");
    case sentinels::AlarmKind::lampChanged:
      return AcquisitionTrace::tr("the projector's light changed");
    case sentinels::AlarmKind::moved:
      return AcquisitionTrace::tr("the camera or the projector moved");
    case sentinels::AlarmKind::localChange:
      return AcquisitionTrace::tr("something in the view changed");
    case sentinels::AlarmKind::mirroredScreen:
    case sentinels::AlarmKind::wrongScreen:
      return AcquisitionTrace::tr("the picture was not the one sent");
    case sentinels::AlarmKind::coveredLens:
      return AcquisitionTrace::tr("the camera saw nothing");
    case sentinels::AlarmKind::projectorAsleep:
      return AcquisitionTrace::tr("the projector showed nothing");
  }
  return {};
}

QString AcquisitionTrace::headingOf(sentinels::AlarmKind kind) {
  switch (kind) {
    case sentinels::AlarmKind::flicker:
      return tr("The light flickers, or was switched");
    case sentinels::AlarmKind::unsteady:
      return tr("The light flickers, or something moves");
    case sentinels::AlarmKind::ambientChanged:
      return tr("Room light changed");
    case sentinels::AlarmKind::lampChanged:
      return tr("The projector's light changed");
    case sentinels::AlarmKind::moved:
      return tr("The camera or the projector moved");
    case sentinels::AlarmKind::localChange:
      return tr("Something in the view changed");
    case sentinels::AlarmKind::mirroredScreen:
    case sentinels::AlarmKind::wrongScreen:
      return tr("The picture is not the one sent");
    case sentinels::AlarmKind::coveredLens:
      return tr("The camera sees nothing");
    case sentinels::AlarmKind::projectorAsleep:
      return tr("The projector shows nothing");
  }
  return {};
}

void AcquisitionTrace::clear() {
  points_.clear();
  marks_.clear();
  outlook_.reset();
  {
    QMutexLocker lock(&guard_);
    growth_ = {};
  }
  began_.reset();
  ended_.reset();
  isRecalled_ = isPutRight_ = false;
  asked_.reset();
  Q_EMIT changed();
}

void AcquisitionTrace::setAsked(std::optional<sentinels::AlarmKind> alarm) {
  if (std::exchange(asked_, alarm) != alarm) Q_EMIT changed();
}

void AcquisitionTrace::setPutRight(bool isPutRight) {
  if (std::exchange(isPutRight_, isPutRight) != isPutRight) Q_EMIT changed();
}

void AcquisitionTrace::begin() {
  clear();
  began_ = Clock::now();
}

void AcquisitionTrace::end() {
  if (!ended_) ended_ = Clock::now();
  asked_.reset();
}

void AcquisitionTrace::recall(const pipeline::AcquisitionRecord& record) {
  clear();
  for (const auto& [seconds, reading] : record.checks) points_.push_back({seconds, reading});
  for (const auto& [seconds, retake] : record.again) marks_.push_back({seconds, retake});
  ended_ = Clock::now();
  began_ =
      *ended_ - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(record.seconds));
  {
    QMutexLocker lock(&guard_);
    growth_ = {record.levels, record.levels.empty() ? 0 : record.levels.back()};
  }
  isRecalled_ = true;
  Q_EMIT changed();
}

double AcquisitionTrace::seconds() const {
  if (!began_) return 0.0;
  return std::chrono::duration<double>(ended_.value_or(Clock::now()) - *began_).count();
}

void AcquisitionTrace::checked(const sentinels::Reading& reading) {
  Clock::time_point now = Clock::now();
  QMetaObject::invokeMethod(
      this,
      [this, reading, now] {
        if (!began_ || now < *began_) return;  // of the measurement before
        points_.push_back({std::chrono::duration<double>(now - *began_).count(), reading});
        isPutRight_ = false;
        Q_EMIT changed();
      },
      Qt::QueuedConnection);
}

void AcquisitionTrace::takenAgain(const sentinels::Retake& retake) {
  Clock::time_point now = Clock::now();
  if (retake.shot == 0) {
    QMutexLocker lock(&guard_);
    growth_ = {};
  }
  QMetaObject::invokeMethod(
      this,
      [this, retake, now] {
        if (!began_ || now < *began_) return;
        // Measured from the start, nothing is compared with what was seen before.
        if (retake.reason == sentinels::RetakeReason::alarm && retake.shot == 0) points_.clear();
        marks_.push_back({std::chrono::duration<double>(now - *began_).count(), retake});
        Q_EMIT changed();
      },
      Qt::QueuedConnection);
}

void AcquisitionTrace::expects(const pipeline::Outlook& outlook) {
  Clock::time_point now = Clock::now();
  QMetaObject::invokeMethod(
      this,
      [this, shared = std::make_shared<const pipeline::Outlook>(outlook), now] {
        if (!began_ || now < *began_) return;
        outlook_ = shared;
        Q_EMIT changed();
      },
      Qt::QueuedConnection);
}

void AcquisitionTrace::grew(const std::vector<int>& levels, int through) {
  QMutexLocker lock(&guard_);
  growth_ = {levels, through};
}

AcquisitionTrace::Growth AcquisitionTrace::growth() const {
  QMutexLocker lock(&guard_);
  return growth_;
}

std::optional<RoomLight> AcquisitionTrace::roomLight() const {
  // What is on record says nothing of now.
  if (points_.empty() || isRecalled_) return std::nullopt;
  const sentinels::Reading last = now();
  if (isOf(last, {sentinels::AlarmKind::coveredLens})) return std::nullopt;
  return RoomLight{last.roomLight, isRoomSteady(last)};
}

std::array<WatchState, 4> AcquisitionTrace::states() const {
  if (points_.empty())
    return {{{false, true, tr("Room light"), {}},
             {false, true, tr("Camera and view"), {}},
             {false, true, tr("Projector"), {}},
             {false, true, tr("Flicker"), {}}}};
  const sentinels::Reading now = this->now();
  // What was put right is no longer so, and not looked at again before the next check. Put right by hand is a
  // camera: the room's light is as it was seen last.
  const bool isOver = now.alarm && lastAnswer() != nullptr;
  bool room = isRoomSteady(now);
  bool view = !isOf(now, {sentinels::AlarmKind::moved, sentinels::AlarmKind::localChange,
                          sentinels::AlarmKind::mirroredScreen, sentinels::AlarmKind::wrongScreen,
                          sentinels::AlarmKind::coveredLens}) &&
              now.view < sentinels::reading_limit::view;
  bool lamp = !isOf(now, {sentinels::AlarmKind::lampChanged, sentinels::AlarmKind::projectorAsleep});
  bool even = now.flicker < sentinels::reading_limit::flicker &&
              !isOf(now, {sentinels::AlarmKind::flicker, sentinels::AlarmKind::unsteady});
  const bool isBlind = isOf(now, {sentinels::AlarmKind::coveredLens});
  const QString next = tr("Looked at again at the next check.");
  const QString unknown = isOver ? next : tr("Not known while the camera sees nothing.");
  std::array<WatchState, 4> states{
      {isBlind ? WatchState{false, true, tr("Room light"), unknown}
               : WatchState{true, room, room ? tr("Room light steady") : tr("Room light changed"),
                            tr("%1 of full light, changed by %2 since the start.")
                                .arg(fineShare(now.roomLight),
                                     fineShare(std::abs(now.roomLight - now.roomLightAtFirst)))},
       isBlind ? WatchState{true, false, headingOf(sentinels::AlarmKind::coveredLens), {}}
               : WatchState{true, view, view ? tr("Camera still") : tr("The view changed"),
                            tr("The view differs by %1 from the first.").arg(fineShare(now.view))},
       isBlind ? WatchState{false, true, tr("Projector"), unknown}
       // What is seen of another view says nothing of the lamp.
       : view ? WatchState{true, lamp, lamp ? tr("Projector steady") : tr("The projector's light changed"),
                           tr("Its light drifted by %1 and is corrected.")
                               .arg(fineShare(std::abs(now.lamp - 1.0)))}
              : WatchState{false, true, tr("Projector"), tr("Not known while the view has changed.")},
       {true, even, even ? tr("No flicker") : tr("The light flickers, or something moves"),
        // One exposure alone has nothing to differ from.
        now.flicker > 0.0 ? tr("Photographs of one pattern agree within %1.").arg(fineShare(now.flicker))
                          : tr("No difference between photographs of one pattern was found.")}}};
  for (std::size_t i = 0; i < states.size(); ++i) {
    constexpr std::size_t roomLight = 0;
    // Its figure is of the check before.
    if (!states[i].isSteady && isFoundSince()) states[i].figure = tr("Found since the last check.");
    const bool isPutRight = isPutRight_ && i != roomLight;
    if (!states[i].isSteady && (isOver || (now.alarm && isPutRight)))
      states[i] = {false, true, isPutRight ? tr("Put right") : tr("Photographed again"), next};
  }
  return states;
}

std::optional<sentinels::AlarmKind> AcquisitionTrace::takesAgainFor() const {
  const Mark* mark = isRecalled_ ? nullptr : lastAnswer();
  return mark != nullptr ? mark->retake.alarm : std::nullopt;
}

bool AcquisitionTrace::takesAllAgain() const {
  const Mark* mark = isRecalled_ ? nullptr : lastAnswer();
  return mark != nullptr && mark->retake.shot == 0;
}

/// What was found was taken again since the last check; null: it was not.
const AcquisitionTrace::Mark* AcquisitionTrace::lastAnswer() const {
  for (auto mark = marks_.rbegin(); mark != marks_.rend(); ++mark)
    if (mark->retake.reason == sentinels::RetakeReason::alarm &&
        (points_.empty() || mark->seconds >= points_.back().seconds))
      return &*mark;
  return nullptr;
}

sentinels::Reading AcquisitionTrace::now() const {
  sentinels::Reading reading = points_.back().reading;
  if (asked_) reading.alarm = asked_;
  return reading;
}

/// What somebody is asked about is not what the last check found.
bool AcquisitionTrace::isFoundSince() const {
  return asked_ && points_.back().reading.alarm != asked_;
}

std::vector<TakenAgain> AcquisitionTrace::takenAgain(std::size_t most) const {
  std::vector<TakenAgain> lines;
  for (auto mark = marks_.rbegin(); mark != marks_.rend() && lines.size() < most; ++mark)
    lines.push_back({patternsOf(mark->retake), reasonOfRetake(mark->retake)});
  return lines;
}

}  // namespace relucent::gui
