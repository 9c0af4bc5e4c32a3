// SPDX-License-Identifier: MIT
#include "wizard/acquire/acquire_page.h"

#include <numeric>
#include <utility>

#include "relucent/acquisition/forecast.h"
#include "relucent/base/message.h"
#include "relucent/base/time_left.h"
#include "relucent/calibration/results.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/stored_settings.h"
#include "text/message_text.h"
#include "views/number_text.h"
#include "wizard/acquire/retrying_observer.h"
#include "wizard/devices/full_disk.h"
#include "wizard/devices/on_measurement.h"

namespace relucent::gui {
namespace {

constexpr std::chrono::seconds beforeRetry{5}, waitsWhileEnding{15};

}  // namespace

AcquirePage::AcquirePage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent),
      question_(std::make_shared<AlarmQuestion>()),
      recalling_(
          [this](Recalled recalled) {
            if (recalled.measurement != wanted_) return;
            recalled_ = std::move(recalled);
            ++recalls_;
            recallTrace();
            tellResult();
          },
          [this](const Failure& failure) {
            unreadable_ = wanted_;
            tellAll();
            Q_EMIT failed({failure, {}});
          }),
      room_(this) {
  makeCommands();
  connect(&session_, &Session::opened, this, [this] {
    finish();
    trace_.clear();
    forecast_.reset();
    secondsAPattern_ = 0.0;
    wanted_.clear();
    recalled_ = {};
    countKept();
    connect(&session_.live(), &LiveRig::seen, this, [this] {
      if (isMeasuring()) tellProgress();
    });
  });
  connect(&session_, &Session::stepsChanged, this, [this] {
    lookAtResponse();
    if (isLookedAt_) recall();
    recallTrace();
    tellAll();
  });
  connect(&session_, &Session::roomLightChanged, this, &AcquirePage::resultChanged);
  connect(&session_, &Session::acquisitionChanged, this, &AcquirePage::tellAll);
  connect(&session_, &Session::devicesChanged, this, [this] {
    // Whoever has asked to stop does not wait for a camera that has gone; but one that is late for a moment
    // would cost all that no check has confirmed yet.
    const bool isWaitedFor = isStopping() && session_.isCameraSilent();
    if (!isWaitedFor) givingUp_.stop();
    if (isWaitedFor && !givingUp_.isActive()) givingUp_.start();
    tellSettings();
    tellProgress();  // it waits, or does so no longer
  });
  connect(&job_, &Job::progressed, this, [this] {
    isFinestDone_ = isFinestDone_ || isWorkingOut();
    tellProgress();
  });
  connect(&job_, &Job::expected, this, &AcquirePage::expect);
  connect(&job_, &Job::ended, this, &AcquirePage::ended);
  connect(&room_, &RoomQuestion::changed, this, &AcquirePage::diskChanged);
  connect(&trace_, &AcquisitionTrace::changed, this, [this] {
    session_.setRoomLight(trace_.roomLight());
    tellProgress();
  });
  leaving_.setInterval(1000);
  connect(&leaving_, &QTimer::timeout, this, [this] {
    if (--secondsLeftToLeave_ > 0) return tellStatus();
    begin();
  });
  givingUp_.setSingleShot(true);
  givingUp_.setInterval(waitsWhileEnding);
  connect(&givingUp_, &QTimer::timeout, this, [this] {
    if (isStopping()) session_.giveUpCamera();
  });
  second_.setInterval(1000);
  connect(&second_, &QTimer::timeout, this, &AcquirePage::tick);
  updateCommands();
}

void AcquirePage::makeCommands() {
  auto begins = [this] { start(false); };
  start_ = addCommand(Icon::play, begins);
  startNow_ = addCommand(Icon::play, [this] { begin(); });
  stay_ = addCommand(Icon::stop, [this] { stay(); });
  next_ = addCommand(Icon::next, [this] { Q_EMIT nextWanted(); });
  pause_ = addCommand(Icon::pause, [this] { pause(); }, QKeySequence("Ctrl+P"));
  resume_ = addCommand(Icon::play, [this] { resume(); }, QKeySequence("Ctrl+P"));
  keep_ = addCommand(Icon::save, [this] { stopAndKeep(); }, QKeySequence("Ctrl+K"));
  measureAnew_ = addCommand(Icon::retry, [this] { start(true); });
  return_ = addCommand(Icon::back, [this] { askToReturn(); });
  returnNow_ = addCommand(Icon::back, [this] { returnToEarlier(); });
  stayWithNew_ = addCommand(Icon::save, [this] { returning_.reset(); });
  goOnMeasuring_ = addCommand(Icon::play, begins);
  goOnWithDisk_ = addCommand(Icon::play, [this] { room_.goOn(); });
  retryAlarm_ = answering(Icon::retry, sentinels::Answer::retry);
  keepAtAlarm_ = answering(Icon::save, sentinels::Answer::keepAndStop);
  skipAlarm_ = answering(Icon::next, sentinels::Answer::skip);
  answer_ = addCommand(Icon::warning, [this] { askAgain(trace_.isPutRight()); });
  pushBack_ = addCommand(Icon::camera, [this] { Q_EMIT nudgeWanted(); });
  retry_ = addCommand(Icon::play, begins);
}

AcquirePage::~AcquirePage() {
  finish();
}

StepStatus AcquirePage::status() const {
  const bool hasResult = session_.result(calibration::Stage::acquisition).has_value();
  const QString share = percentText(progress().value_or(0.0));
  if (isPaused() || isDiskFull())
    return {StepState::busy, tr("Paused, %1").arg(share), hasResult, isDiskFull()};
  if (isAsking()) return {StepState::busy, tr("Waits for an answer"), hasResult, true};
  if (isReading()) return {StepState::busy, tr("Reading, %1").arg(share), hasResult};
  if (isCountingDown())
    return {StepState::busy, tr("Begins in %n second(s)", nullptr, secondsLeftToLeave_), hasResult};
  if (isWorkingOut()) return {StepState::busy, tr("Working out, %1").arg(share), hasResult};
  if (isMeasuring()) return {StepState::busy, tr("Measuring, %1").arg(share), hasResult};
  switch (session_.progress(calibration::Stage::acquisition)) {
    case calibration::StageProgress::done:
      if (session_.foundChange()) return {StepState::coarse, tr("Ended by a change")};
      if (const int blocks = stoppedAt(); blocks > 0)
        return {StepState::coarse,
                isNothingToldApart(session_) ? tr("Stopped too early") : tr("Stopped at %1 px").arg(blocks)};
      if (const auto poor = session_.poorQuality())
        return {StepState::doubtful, tr("%1 expected").arg(isolated(tr("%1 dB").arg(decimalText(*poor, 0))))};
      if (const auto holes = session_.leftOut())
        return {StepState::doubtful, session_.isOverexposed() ? tr("%1 too bright").arg(percentText(*holes))
                                                              : tr("%1 left out").arg(percentText(*holes))};
      if (const auto spent = cost())
        return {StepState::done,
                groupedText(tr("%n pattern(s), %1", nullptr, spent->patterns), spent->patterns)
                    .arg(text(spentDuration(spent->seconds)))};
      return {StepState::done, tr("Measured")};
    case calibration::StageProgress::stale:
      return {StepState::outOfDate, again_ > 0 ? tr("Again, not ended") : tr("Out of date")};
    case calibration::StageProgress::open:
      break;
  }
  if (job_.state() == Job::State::failed) return {StepState::failed, tr("Stopped by a failure")};
  if (kept_ > 0) return {StepState::open, tr("%n pattern(s) kept", nullptr, kept_)};
  return {};
}

QString AcquirePage::hint() const {
  if (isMeasuring() && session_.isScreenMissing()) return tr("Waiting for the projector's screen.");
  if (isMeasuring() && session_.isCameraSilent()) return tr("Waiting for the camera.");
  if (isPaused() && !session_.mayMeasure()) return tr("To go on measuring, confirm that the room is clear.");
  if (isPaused()) return tr("Waiting for you. Nothing is being projected.");
  if (isDiskFull()) return tr("Waiting for room on the disk. Nothing is being projected.");
  if (isStopping())
    return tr("Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.");
  if (isAsking()) return tr("Waiting for your answer.");
  if (isReading())
    return tr("The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.",
              nullptr, kept_);
  // It may have gone.
  if (const auto why = trace_.takesAgainFor(); isMeasuring() && why) {
    QString reason = AcquisitionTrace::reasonOf(*why);
    reason[0] = reason[0].toUpper();
    return trace_.takesAllAgain()
               ? tr("%1: all patterns are taken again, from the first.").arg(reason)
               : tr("%1: what was photographed since the check before is taken again.").arg(reason);
  }
  if (isMeasuring())
    return status().hasResult
               ? tr("Every photograph is saved. The earlier measurement is used until the new one is ready.")
               : tr("Every photograph is saved. Threshold opens when the last is taken.");
  if (isCountingDown())
    return tr("Measuring begins in %n second(s). Leave the room dark and still.", nullptr,
              secondsLeftToLeave_);
  if (!session_.areDevicesFree() && !lease_.isHeld())
    return tr("The devices are in use at %1.").arg(session_.devicesUserName());
  if (afterChange() == goOnMeasuring_ && session_.mayMeasure())
    return tr("Put right what changed, then go on measuring.");
  if (afterChange() == measureAnew_ && session_.mayMeasure())
    return tr("Measure again as it stands now, or put it back and go on measuring.");
  if ((isDoubtful() || isUseless()) && !session_.mayMeasure())
    return tr("To measure again, confirm that the room is clear.");
  if (isDone() && wasEndedEarly() && !session_.mayMeasure())
    return tr("To go on measuring, confirm that the room is clear.");
  if (isDone()) {
    const QString spent = text(spentDuration(cost().value_or(calibration::StageCost()).seconds));
    return stoppedAt() > 0 ? tr("Stopped after %1").arg(spent)
           : repairCost()  ? tr("Measured in %1, and repaired since").arg(spent)
                           : tr("Measured in %1").arg(spent);
  }
  if (!session_.mayMeasure()) return tr("Confirm that the room is clear: the patterns flash.");
  if (auto work = kept_ == 0 ? expected() : std::nullopt) {
    const int patterns = patternsExpected();
    return groupedText(tr("About %n pattern(s), %1. Leave the room dark and still.", nullptr, patterns),
                       patterns)
        .arg(text(expectedDuration(work->seconds)));
  }
  return tr("Leave the room dark and still, then start.");
}

void AcquirePage::updateCommands() {
  DevicePage::updateCommands();
  const bool mayStart = session_.areDevicesFree() && session_.mayMeasure();
  const bool isNew = isStale() && again_ == 0;
  start_->setGlyph(isNew ? Icon::retry : Icon::play);
  start_->show(isNew       ? tr("Measure with these settings")
               : kept_ > 0 ? tr("Resume")
                           : tr("Start measuring"),
               mayStart);
  // As the hint says it, so that it is said once.
  const QString inUse = tr("The devices are in use at %1.").arg(session_.devicesUserName());
  const auto why = [&](const QString& unclear) {
    return !session_.areDevicesFree() ? inUse : mayStart ? QString() : unclear;
  };
  measureAnew_->showUnless(why(tr("To measure again, confirm that the room is clear.")), tr("Measure again"));
  measureAnew_->setToolTip(mayStart ? tr("Takes every photograph again. What is measured stays until then.")
                                    : measureAnew_->whyNot());
  startNow_->show(tr("Start now"));
  stay_->show(tr("Not now"));
  next_->show(tr("Show threshold"), !isMeasuring());
  pause_->show(tr("Pause"), !isStopping() && !isAsking());
  pause_->setToolTip(isAsking() ? tr("Waiting for your answer. Every photograph is saved.") : QString());
  resume_->show(tr("Resume"), session_.mayMeasure());
  // Beside the other that can be kept.
  keep_->show(isMeasuringAgain() ? tr("Stop and keep this one") : tr("Stop and keep"), !isStopping());
  return_->show(isDone() && !isMeasuring() ? tr("Use the earlier one") : tr("Keep the earlier one"),
                !isStopping() && (isMeasuring() || session_.areDevicesFree()));
  return_->setToolTip(tr("The earlier measurement is used again, with all that followed from it."));
  goOnWithDisk_->show(tr("Go on now"));
  goOnMeasuring_->showUnless(why(tr("To go on measuring, confirm that the room is clear.")),
                             tr("Go on measuring"));
  goOnMeasuring_->setToolTip(goOnMeasuring_->whyNot());
  answer_->show(tr("Answer"));
  retryAlarm_->show(tr("Try again"));
  keepAtAlarm_->show(tr("Stop and keep"));
  skipAlarm_->show(tr("Continue anyway"));
  pushBack_->show(tr("Put the camera back"));
  retry_->show(tr("Resume"));
}

PageCommand* AcquirePage::primary() const {
  if (isCountingDown()) return startNow_;
  if (isDoubtful()) return measureAnew_;
  if (isBestGoneBackFrom()) return return_;
  if (isUseless()) return measureAnew_;
  if (PageCommand* leadsOn = afterChange()) return leadsOn;
  return isMeasuring() || isDone() ? next_ : start_;
}

std::vector<PageCommand*> AcquirePage::secondary() const {
  using Commands = std::vector<PageCommand*>;
  if (isCountingDown()) return {stay_};
  // What was measured again may have come to less than what was there before.
  if (isDoubtful()) return hasBetterBefore() ? Commands{return_, next_} : Commands{next_};
  if (isBestGoneBackFrom()) return {measureAnew_, next_};
  if (isUseless()) return {next_};
  if (const PageCommand* leadsOn = afterChange())
    return {leadsOn == measureAnew_ ? goOnMeasuring_ : measureAnew_, next_};
  if (isDone()) return hasBetterBefore() ? Commands{return_, measureAnew_} : Commands{measureAnew_};
  PageCommand* const pause = isPaused() ? resume_ : pause_;
  if (isMeasuringAgain()) return {return_, pause, keep_};
  if (isMeasuring()) return {pause, keep_};
  if (session_.mayReturnToEarlier(calibration::Stage::acquisition)) return {return_};
  return {};
}

std::optional<Banner> AcquirePage::banner() const {
  if (const auto disk = room_.waiting(); disk && isMeasuring()) return fullDisk(*disk, goOnWithDisk_);
  if (isAsking()) return alarmBanner();
  if (!session_.isSimulated())
    if (auto beside = besideAnotherShow()) return beside;
  if (isMeasuring() || isCountingDown()) return std::nullopt;
  calibration::StageProgress progress = session_.progress(calibration::Stage::acquisition);
  if (progress == calibration::StageProgress::stale) return staleBanner();
  if (isDone() && isUnreadable())
    return Banner{
        Banner::Kind::amber, tr("What was measured cannot be read"),
        hasBetterBefore() ? tr("Use the earlier measurement, or measure again.") : tr("Measure again.")};
  if (const auto change = session_.foundChange(); change && isDone()) return changedBanner(*change);
  if (progress == calibration::StageProgress::done && wasEndedEarly() && again_ > 0)
    return interruptedBanner();
  if (progress == calibration::StageProgress::done && stoppedAt() > 0) return stoppedBanner();
  if (isDoubtful()) return onMeasurement(session_, nullptr);
  if (progress == calibration::StageProgress::open && kept_ > 0)
    return Banner{Banner::Kind::information, tr("The last session ended before it was finished"),
                  tr("The photographs of %n pattern(s) are safe. Resuming gives the same result as if "
                     "nothing had happened.",
                     nullptr, kept_)};
  return overTheShow();
}

Banner AcquirePage::staleBanner() const {
  if (again_ == 0)
    return {Banner::Kind::amber, tr("This measurement belongs to earlier settings"),
            tr("It still works and stays until the new one is ready.")};
  return {Banner::Kind::amber, tr("Measuring again has not ended"), safeSince()};
}

/// While it was gone on with: what the earlier end came to stands, and there is more.
Banner AcquirePage::interruptedBanner() const {
  return {Banner::Kind::amber, tr("Going on has not ended"), safeSince(), goOnMeasuring_};
}

QString AcquirePage::safeSince() const {
  return tr(
      "The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is "
      "used.",
      nullptr, again_);
}

bool AcquirePage::isStale() const {
  return session_.progress(calibration::Stage::acquisition) == calibration::StageProgress::stale;
}

bool AcquirePage::needsConsentNow() const {
  return !session_.mayMeasure() && (!isDone() || wasEndedEarly() || isDoubtful());
}

bool AcquirePage::hasBetterBefore() const {
  return (wasEndedEarly() || isDoubtful() || isUnreadable()) &&
         session_.hasEarlier(calibration::Stage::acquisition);
}

bool AcquirePage::isDoubtful() const {
  return isDone() && !wasEndedEarly() && session_.isDoubtful();
}

/// It cannot be read, or not even with what is missing would it be better than nothing.
bool AcquirePage::isUseless() const {
  const bool isPoor = stoppedAt() > 0 && !session_.foundChange() && session_.poorQuality();
  return isDone() && (isUnreadable() || isPoor);
}

/// There was a measurement before which is more than this one.
bool AcquirePage::isBestGoneBackFrom() const {
  const bool isCoarse = stoppedAt() > 0 && !session_.foundChange();
  return isDone() && (isUnreadable() || isCoarse) && hasBetterBefore();
}

bool AcquirePage::isUnreadable() const {
  const bool isKnown = !unreadable_.empty() && unreadable_ == session_.measurement();
  return isKnown || session_.acquisitionFailure().has_value();
}

QString AcquirePage::whyLocked() const {
  if (isMeasuring() || isCountingDown()) return tr("Measuring with these settings.");
  return session_.whyLocked(step());
}

void AcquirePage::countKept() {
  kept_ = session_.isOpen() ? session_.photographsKept(calibration::Stage::acquisition) : 0;
  again_ = kept_ > 0 ? session_.photographsSince(calibration::Stage::acquisition) : 0;
}

/// What moved may stand where it stands from now on; anything else is put right, and looked at when it goes
/// on.
PageCommand* AcquirePage::afterChange() const {
  const auto change = session_.foundChange();
  if (!isDone() || !change) return nullptr;
  return change->moved ? measureAnew_ : goOnMeasuring_;
}

Banner AcquirePage::changedBanner(const transport::FoundChange& change) const {
  const int blocks = stoppedAt();
  return {Banner::Kind::amber,
          blocks > 0 ? tr("Measuring was stopped at blocks of %1 px: something had changed").arg(blocks)
                     : tr("Measuring ended, and something had changed"),
          fullSentence(change.what) + ' ' +
              tr("What was photographed since the look before is left out, all before it is kept.")};
}

Banner AcquirePage::stoppedBanner() const {
  const QString title = isNothingToldApart(session_)
                            ? nothingToldApart()
                            : tr("Measuring was stopped at blocks of %1 px").arg(stoppedAt());
  const std::optional<transport::ExpectedQuality> quality = expectedQuality();
  if (!quality)
    return {Banner::Kind::amber, title, tr("Finer light is missing. Go on any time, if nothing has moved."),
            goOnMeasuring_};
  const auto decibels = [](double value) { return decimalText(value, 0); };
  if (isUseless())
    return {Banner::Kind::amber, title,
            tr("%1 dB expected: what was measured does not fit together, and pictures are no better than "
               "uncorrected.")
                .arg(decibels(quality->now))};
  if (quality->photographs == 0)
    return {Banner::Kind::amber, title,
            tr("%1 dB expected. Go on any time, if nothing has moved.").arg(decibels(quality->now)),
            goOnMeasuring_};
  return {
      Banner::Kind::amber, title,
      groupedText(tr("%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if "
                     "nothing has moved.",
                     nullptr, quality->photographs),
                  quality->photographs)
          .arg(decibels(quality->now), decibels(quality->whole), text(expectedDuration(quality->seconds))),
      goOnMeasuring_};
}

QString AcquirePage::watching() const {
  return tr(
      "Compared with the start every %n pattern(s). What changed is photographed again; if that does not "
      "help, "
      "the measurement pauses and asks.",
      nullptr, session_.settings().acquisition.checkInterval);
}

std::optional<calibration::StageCost> AcquirePage::repairCost() const {
  const auto& measured = session_.figures<calibration::Stage::acquisition>();
  return measured && measured->repair ? std::optional(measured->repair->cost) : std::nullopt;
}

std::optional<calibration::StageCost> AcquirePage::cost() const {
  const auto& measured = session_.figures<calibration::Stage::acquisition>();
  return measured ? measured->cost : std::nullopt;
}

std::optional<double> AcquirePage::verificationError() const {
  const auto& measured = session_.figures<calibration::Stage::acquisition>();
  return measured ? measured->verificationError : std::nullopt;
}

std::optional<transport::ExpectedQuality> AcquirePage::expectedQuality() const {
  const auto& measured = session_.figures<calibration::Stage::acquisition>();
  if (!measured || (session_.leftOut() && !session_.isOverexposed())) return std::nullopt;
  return measured->expected;
}

QStringList AcquirePage::findings() const {
  QStringList sentences;
  if (const auto& measured = session_.figures<calibration::Stage::acquisition>())
    for (const Message& finding : measured->findings) sentences << fullSentence(finding);
  return sentences;
}

/// Tells nobody what cannot be read: Linearize does.
void AcquirePage::lookAtResponse() {
  const auto& stored = session_.result(calibration::Stage::linearization);
  std::string when = stored ? stored->stored + stored->inputs : std::string();
  if (std::exchange(responseStored_, when) == when) return;
  response_.reset();
  if (!stored) return;
  try {
    response_ = calibration::loadLinearization(*stored);
  } catch (const std::exception&) {
    response_.reset();
  }
}

void AcquirePage::start(bool anew) {
  if (isMeasuring() || !session_.areDevicesFree() || !session_.mayMeasure()) return;
  anew_ = anew;
  lease_ = session_.leaseDevices(stepName, DeviceWork::measurement, [this] {
    if (isCountingDown()) return stay();
    if (isMeasuring() && !isPaused()) pause();  // also while it ends: last patterns flash, too
  });
  if (secondsToLeave_ == 0 || !session_.hasLight()) return begin();
  secondsLeftToLeave_ = secondsToLeave_;
  leaving_.start();
  tellStatus();
}

void AcquirePage::stay() {
  if (!isCountingDown()) return;
  leaving_.stop();
  lease_.release();
  tellStatus();
}

void AcquirePage::begin() {
  undoStack().clear();  // what is measured with is not taken back by the way
  leaving_.stop();
  question_->setClosed(false);
  alarm_.reset();
  viewBefore_ = {};
  asking_.reset();
  begunAt_ = session_.live().taken(std::string(nameOf(calibration::Stage::acquisition))).photographs;
  secondsAPattern_ = 0.0;
  readingTime_ = {};
  trace_.begin();
  second_.start();
  auto retrying = std::make_shared<RetryingObserver>(trace_, question_, beforeRetry);
  sentinels::AlarmHandler handler = [this, retrying, question = question_](const sentinels::Alarm& alarm) {
    if (retrying->triesAgain(alarm.kind)) return sentinels::Answer::retry;
    QMetaObject::invokeMethod(this, [this, alarm] { askAboutAlarm(alarm); }, Qt::QueuedConnection);
    return question->wait();
  };
  auto expects = [this](const pipeline::Outlook& outlook) { trace_.expects(outlook); };
  rate_.forget();
  isFinestDone_ = false;
  job_.start([work = workOf(session_), anew = anew_, handler, retrying, expects,
              room = &room_](Progress& progress) {
    room->countPauses([live = work.devices->sharedLive()] { return live->paused(); });
    Progress opening =
        progress.part(openingShare, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->open(opening);
    calibration::CalibrationFolder folder =
        calibration::CalibrationFolder::open(work.path, calibration::CalibrationFolder::Access::write);
    if (anew) pipeline::measureAgain(folder, calibration::Stage::acquisition);
    Progress reading = progress.part(0.0, RELUCENT_MESSAGE("stage.reading-response", "Reading the response"));
    linearization::Linearization linearization = pipeline::measureLinearization(folder, rig, room, reading);
    Progress measuring = progress.part(1.0 - openingShare, RELUCENT_MESSAGE("stage.measuring-light-transport",
                                                                            "Measuring the light transport"));
    pipeline::goOnMeasuring(folder, rig, linearization, handler, *retrying, expects, room, measuring);
  });
  tellProgress();
  tellResult();
}

void AcquirePage::diskChanged() {
  if (!std::exchange(diskWasFull_, isDiskFull()) && isDiskFull()) Q_EMIT asks();
  tellProgress();
  tellStatus();
}

void AcquirePage::finish() {
  stay();
  job_.cancel();
  asking_.reset();
  question_->setClosed(true);
  session_.live().resume();
}

void AcquirePage::ended() {
  second_.stop();
  asking_.reset();
  returning_.reset();
  trace_.end();
  std::optional<Failure> unread;
  if (session_.isOpen()) {
    unread = session_.readAgain();
    countKept();
  }
  traced_ = traced();
  anew_ = false;
  lease_.release();
  if (std::exchange(returns_, false) && job_.state() != Job::State::done) return returnToEarlier();
  if (job_.state() != Job::State::cancelled) Q_EMIT measured();
  if (job_.state() == Job::State::failed) {
    Q_EMIT failed(
        {job_.failure(),
         tr("The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.",
            nullptr, kept_),
         retry_});
  } else if (unread) {
    Q_EMIT failed({*unread, tr("What is measured is safe."), nullptr});
  }
  tellProgress();
  tellResult();
}

}  // namespace relucent::gui
