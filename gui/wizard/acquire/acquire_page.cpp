// SPDX-License-Identifier: MIT
#include "wizard/acquire/acquire_page.h"

#include <numeric>
#include <utility>

#include "acquisition/forecast.h"
#include "calibration/results.h"
#include "jobs/core_sentences.h"
#include "pipeline/measuring.h"
#include "pipeline/stored_settings.h"
#include "views/number_text.h"
#include "wizard/acquire/retrying.h"
#include "wizard/devices/missing_screen.h"

namespace relucent {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double fineThreshold = 0.006;
constexpr int photographsBeforeTime = 20;
constexpr std::chrono::seconds beforeRetry{5};

}  // namespace

AcquirePage::AcquirePage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent), asking_(std::make_shared<Asking>()) {
  connect(&session_, &Session::opened, this, [this] {
    finish();
    trace_.clear();
    forecast_.reset();
    left_ = {};
    kept_ = session_.isOpen() ? session_.photographsKept(Stage::acquisition) : 0;
    connect(&session_.live(), &LiveRig::seen, this, [this] {
      if (isMeasuring()) Q_EMIT changed();
    });
  });
  connect(&session_, &Session::changed, this, [this] {
    lookAtResponse();
    Q_EMIT changed();
  });
  connect(&job_, &Job::progressed, this, &AcquirePage::changed);
  connect(&job_, &Job::expected, this, [this](const WorkLeft& left) {
    forecast_ = left;
    left_.expect(left, Clock::now());
  });
  connect(&job_, &Job::ended, this, &AcquirePage::ended);
  connect(&trace_, &AcquisitionTrace::changed, this, [this] {
    if (auto light = trace_.roomLight()) session_.setRoomLight(*light);
    Q_EMIT changed();
  });
  leaving_.setInterval(1000);
  connect(&leaving_, &QTimer::timeout, this, [this] {
    if (--secondsLeftToLeave_ > 0) return Q_EMIT changed();
    begin();
  });
  second_.setInterval(1000);
  connect(&second_, &QTimer::timeout, this, &AcquirePage::tick);
}

AcquirePage::~AcquirePage() {
  finish();
}

StepStatus AcquirePage::status() const {
  if (isPaused()) return {StepState::busy, tr("Paused, %1").arg(percentText(job_.fraction()))};
  if (isLeaving()) return {StepState::busy, tr("Begins in %n second(s)", nullptr, secondsLeftToLeave_)};
  if (isMeasuring()) return {StepState::busy, tr("Measuring, %1").arg(percentText(job_.fraction()))};
  switch (session_.progress(Stage::acquisition)) {
    case StageProgress::done:
      if (const auto spent = cost())
        return {StepState::done,
                groupedText(tr("%n pattern(s), %1", nullptr, spent->patterns), spent->patterns)
                    .arg(durationText(spent->seconds))};
      return {StepState::done, tr("Measured")};
    case StageProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case StageProgress::open:
      break;
  }
  if (job_.state() == Job::State::failed) return {StepState::failed, tr("Stopped by a failure")};
  if (kept_ > 0) return {StepState::open, tr("%n photograph(s) kept", nullptr, kept_)};
  return {};
}

QString AcquirePage::hint() const {
  if (isPaused()) return tr("Waiting for you. Nothing is being projected.");
  if (isStopping()) return tr("Ending with what is measured.");
  if (isMeasuring()) return tr("Every photograph is saved. Threshold opens when the last is taken.");
  if (isLeaving())
    return tr("Measuring begins in %n second(s). Leave the room dark and still.", nullptr,
              secondsLeftToLeave_);
  if (!session_.areDevicesFree()) return tr("The devices are in use at %1.").arg(session_.devicesUserName());
  if (isDone()) return tr("Measured in %1").arg(durationText(cost().value_or(StageCost()).seconds));
  if (!session_.mayMeasure()) return tr("Confirm that the room is clear.");
  if (auto work = kept_ == 0 ? expected() : std::nullopt) {
    const auto patterns = static_cast<int>(work->shots);
    return groupedText(tr("About %n pattern(s), %1. Leave the room dark and still.", nullptr, patterns),
                       patterns)
        .arg(durationText(work->seconds));
  }
  return tr("Leave the room dark and still, then start.");
}

Command AcquirePage::primary() const {
  auto* self = const_cast<AcquirePage*>(this);
  if (isLeaving()) return {tr("Start now"), Icon::play, true, {}, [self] { self->begin(); }};
  if (isMeasuring() || isDone())
    return {tr("Show threshold"), Icon::next, !isMeasuring(), {}, [self] { Q_EMIT self->nextWanted(); }};
  return {kept_ > 0 ? tr("Resume") : tr("Start measuring"),
          Icon::play,
          session_.areDevicesFree() && session_.mayMeasure(),
          {},
          [self] { self->start(); }};
}

std::vector<Command> AcquirePage::secondary() const {
  auto* self = const_cast<AcquirePage*>(this);
  if (isLeaving()) return {{tr("Not now"), Icon::stop, true, {}, [self] { self->stay(); }}};
  if (!isMeasuring()) return {};
  Command keep{tr("Stop and keep"), Icon::save, !isStopping(), QKeySequence("Ctrl+K"),
               [self] { self->stopAndKeep(); }};
  if (isPaused())
    return {{tr("Resume"), Icon::play, true, QKeySequence("Ctrl+P"), [self] { self->resume(); }}, keep};
  return {{tr("Pause"), Icon::pause, !isStopping(), QKeySequence("Ctrl+P"), [self] { self->pause(); }}, keep};
}

std::optional<double> AcquirePage::progress() const {
  return isMeasuring() ? std::optional(job_.fraction()) : std::nullopt;
}

std::optional<Banner> AcquirePage::banner() const {
  if (isMeasuring() && session_.isScreenMissing()) return missingScreen();
  if (isMeasuring() || isLeaving()) return std::nullopt;
  auto* self = const_cast<AcquirePage*>(this);
  StageProgress progress = session_.progress(Stage::acquisition);
  if (progress == StageProgress::stale)
    return Banner{
        Banner::Kind::amber,
        tr("This measurement belongs to earlier settings"),
        tr("It still works and stays until the new one is ready."),
        {tr("Measure again"), Icon::retry, session_.areDevicesFree(), {}, [self] { self->start(); }},
        {}};
  if (progress == StageProgress::open && kept_ > 0)
    return Banner{Banner::Kind::information,
                  tr("The last session ended before it was finished"),
                  tr("%n photograph(s) are safe. Resuming gives the same result as if nothing had happened.",
                     nullptr, kept_),
                  {tr("Resume"),
                   Icon::play,
                   session_.areDevicesFree() && session_.mayMeasure(),
                   {},
                   [self] { self->start(); }},
                  {}};
  return std::nullopt;
}

int AcquirePage::photographs() const {
  return isMeasuring() ? pictures().photographs : 0;
}

std::optional<double> AcquirePage::secondsLeft() const {
  if (!isMeasuring() || photographs() < photographsBeforeTime) return std::nullopt;
  return left_.seconds(Clock::now());
}

Fineness AcquirePage::fineness() const {
  const AcquisitionSettings& settings = session_.settings().acquisition;
  if (settings.singleExposure) return Fineness::fast;
  return settings.relativeThreshold <= fineThreshold ? Fineness::fine : Fineness::usual;
}

void AcquirePage::change(const QString& what, const AcquisitionSettings& acquisition) {
  changeUndoably(what, session_.settings().acquisition, acquisition,
                 [this](const AcquisitionSettings& wanted) { keep(wanted); });
}

void AcquirePage::keep(const AcquisitionSettings& acquisition) {
  if (isMeasuring()) return;
  CalibrateSettings settings = session_.settings();
  settings.acquisition = acquisition;
  settings.acquisition.seed = session_.settings().acquisition.seed;
  try {
    session_.changeSettings(settings);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed."), {}, {}});
  }
}

AcquisitionSettings AcquirePage::settingsOf(Fineness fineness) const {
  if (fineness == this->fineness()) return session_.settings().acquisition;
  AcquisitionSettings settings =
      relucent::settingsOf(fineness == Fineness::fast ? AcquisitionMode::fast : AcquisitionMode::adaptive);
  if (fineness == Fineness::fine) settings.relativeThreshold = fineThreshold;
  return settings;
}

void AcquirePage::setFineness(Fineness fineness) {
  if (isMeasuring() || fineness == this->fineness()) return;
  change(tr("Fineness"), settingsOf(fineness));
}

void AcquirePage::setWhite(bool white) {
  if (isMeasuring() || white == isWhite()) return;
  AcquisitionSettings settings = session_.settings().acquisition;
  settings.colours = white ? LitColours::white : LitColours::rgb;
  change(tr("Colours"), settings);
}

QString AcquirePage::watching() const {
  return tr(
      "Compared with the start every %n pattern(s). What changed is photographed again; if that does not "
      "help, "
      "the measurement pauses and asks.",
      nullptr, session_.settings().acquisition.checkInterval);
}

std::optional<StageCost> AcquirePage::cost() const {
  const auto& measured = session_.figures<Stage::acquisition>();
  return measured ? measured->cost : std::nullopt;
}

std::optional<double> AcquirePage::verificationError() const {
  const auto& measured = session_.figures<Stage::acquisition>();
  return measured ? measured->verificationError : std::nullopt;
}

QStringList AcquirePage::findings() const {
  QStringList sentences;
  if (const auto& measured = session_.figures<Stage::acquisition>())
    for (const std::string& finding : measured->findings) sentences << fullSentence(finding);
  return sentences;
}

/// Tells nobody what cannot be read: Linearize does.
void AcquirePage::lookAtResponse() {
  const auto& stored = session_.result(Stage::linearization);
  std::string when = stored ? stored->stored + stored->inputs : std::string();
  if (std::exchange(responseStored_, when) == when) return;
  response_.reset();
  if (!stored) return;
  try {
    response_ = loadLinearization(*stored);
  } catch (const std::exception&) {
    response_.reset();
  }
}

void AcquirePage::pause() {
  session_.live().pause();
  left_.pause(Clock::now());
  Q_EMIT changed();
}

void AcquirePage::resume() {
  session_.live().resume();
  left_.resume(Clock::now());
  Q_EMIT changed();
}

void AcquirePage::stopAndKeep() {
  job_.stopAndKeep();
  resume();
}

void AcquirePage::start() {
  if (isMeasuring() || !session_.areDevicesFree() || !session_.mayMeasure()) return;
  lease_ = session_.leaseDevices(stepName);
  if (secondsToLeave_ == 0 || !session_.hasLight()) return begin();
  secondsLeftToLeave_ = secondsToLeave_;
  leaving_.start();
  Q_EMIT changed();
}

void AcquirePage::stay() {
  if (!isLeaving()) return;
  leaving_.stop();
  lease_.release();
  Q_EMIT changed();
}

void AcquirePage::begin() {
  leaving_.stop();
  asking_->setClosed(false);
  lastCount_ = session_.live().pictures().photographs;
  rate_ = 0.0;
  left_ = {};
  trace_.begin();
  second_.start();
  auto retrying = std::make_shared<Retrying>(trace_, asking_, beforeRetry);
  AlarmHandler handler = [this, retrying, asking = asking_](const Alarm& alarm) {
    if (retrying->triesAgain(alarm.kind)) return Answer::retry;
    QMetaObject::invokeMethod(
        this, [this, alarm] { askAbout(alarm); }, Qt::QueuedConnection);
    return asking->wait();
  };
  job_.start([work = workOf(session_), handler, retrying](Progress& progress) {
    Progress opening = progress.part(0.05, tr("Opening the devices").toStdString());
    Rig& rig = work.devices->open(opening);
    CalibrationFolder folder = CalibrationFolder::open(work.path, CalibrationFolder::Access::write);
    Progress reading = progress.part(0.0, tr("Reading the response").toStdString());
    Linearization linearization = measureLinearization(folder, rig, reading);
    Progress measuring = progress.part(0.95, tr("Measuring the light transport").toStdString());
    measureAcquisition(folder, rig, linearization, handler, *retrying, measuring);
  });
  Q_EMIT changed();
}

void AcquirePage::finish() {
  stay();
  job_.cancel();
  asking_->setClosed(true);
  session_.live().resume();
}

void AcquirePage::askAbout(const Alarm& alarm) {
  Failure failure{ErrorKind::device, fullSentence(alarm.what), fullSentence(alarm.advice),
                  QString::fromStdString(alarm.sentence()), AcquisitionTrace::headingOf(alarm.kind)};
  Command again{tr("Measure again"), Icon::retry, true, {}, [this] { answer(Answer::retry); }};
  Command keep{tr("Stop and keep"), Icon::save, true, {}, [this] { answer(Answer::keepAndStop); }};
  Command goOn;
  if (mayBePutUpWith(alarm.kind))
    goOn = {tr("Continue anyway"), Icon::next, true, {}, [this] { answer(Answer::skip); }};
  Q_EMIT failed({failure, fullSentence(alarm.safe), again, keep, goOn});
  Q_EMIT asks();
}

void AcquirePage::answer(Answer answer) {
  asking_->give(answer);
}

void AcquirePage::ended() {
  second_.stop();
  trace_.end();
  if (session_.isOpen()) {
    session_.reload();
    kept_ = session_.photographsKept(Stage::acquisition);
  }
  lease_.release();
  if (job_.state() != Job::State::cancelled) Q_EMIT measured();
  if (job_.state() == Job::State::failed) {
    Command again{tr("Resume"), Icon::play, true, {}, [this] { start(); }};
    Q_EMIT failed(
        {job_.failure(),
         tr("All %n photograph(s) are on the disk. The one being taken is not counted.", nullptr, kept_),
         again,
         {}});
  }
  Q_EMIT changed();
}

void AcquirePage::tick() {
  int count = session_.live().pictures().photographs;
  // Smoothed over some seconds.
  rate_ = rate_ == 0.0 ? count - lastCount_ : 0.8 * rate_ + 0.2 * (count - lastCount_);
  lastCount_ = count;
  Q_EMIT changed();
}

}  // namespace relucent
