// SPDX-License-Identifier: MIT
#include "wizard/linearize/linearize_page.h"

#include <algorithm>

#include "calibration/results.h"
#include "jobs/time_left.h"
#include "pipeline/measuring.h"
#include "pipeline/stored_settings.h"
#include "views/number_text.h"
#include "wizard/devices/missing_screen.h"

namespace relucent {

LinearizePage::LinearizePage(Session& session, QObject* parent) : DevicePage(stepName, session, parent) {
  connect(&session_, &Session::opened, this, [this] {
    finish();
    result_.reset();
    shown_.clear();
    connect(&session_.live(), &LiveRig::seen, this, [this] {
      if (isMeasuring()) Q_EMIT changed();
    });
    look();
  });
  connect(&session_, &Session::changed, this, [this] {
    look();
    Q_EMIT changed();
  });
  connect(&job_, &Job::progressed, this, &LinearizePage::changed);
  connect(&job_, &Job::ended, this, &LinearizePage::ended);
}

/// Takes what the folder holds, once for every result.
void LinearizePage::look() {
  const auto& stored = session_.result(Stage::linearization);
  if (!stored || stored->stored + stored->inputs == shown_) return;
  shown_ = stored->stored + stored->inputs;
  try {
    result_ = loadLinearization(*stored);
  } catch (...) {
    result_.reset();
    Q_EMIT failed({failureOf(std::current_exception()),
                   tr("The photographs of this step are still in the folder."),
                   {},
                   {}});
  }
}

StepStatus LinearizePage::status() const {
  if (isMeasuring()) return {StepState::busy, tr("Measuring, %1").arg(percentText(job_.fraction()))};
  switch (session_.progress(Stage::linearization)) {
    case StageProgress::done:
      if (result_ && !result_->additivityError.empty())
        return {StepState::done, tr("%1 additivity error")
                                     .arg(percentText(*std::max_element(result_->additivityError.begin(),
                                                                        result_->additivityError.end())))};
      return {StepState::done, tr("Measured")};
    case StageProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case StageProgress::open:
      break;
  }
  if (job_.state() == Job::State::failed) return {StepState::failed, tr("Stopped by a failure")};
  return {};
}

QString LinearizePage::hint() const {
  if (isMeasuring()) return job_.stage();
  if (!session_.areDevicesFree()) return tr("The devices are in use at %1.").arg(session_.devicesUserName());
  if (session_.progress(Stage::linearization) == StageProgress::done) {
    if (!addsUp()) return tr("The colours do not add up. Continuing is recorded in the report.");
    if (auto took = seconds()) return tr("Measured in %1").arg(durationText(*took));
  }
  if (!session_.mayMeasure()) return tr("Confirm that the room is clear.");
  return tr("About %n test pattern(s)", nullptr, static_cast<int>(projectors()) * (3 * levels() + 60));
}

Command LinearizePage::primary() const {
  auto* self = const_cast<LinearizePage*>(this);
  bool done = session_.progress(Stage::linearization) == StageProgress::done;
  if (done && !isMeasuring())
    return {addsUp() ? tr("Plan acquisition") : tr("Continue anyway"), Icon::next, true, {}, [self] {
              Q_EMIT self->nextWanted();
            }};
  return {tr("Measure response"),
          Icon::play,
          !isMeasuring() && session_.areDevicesFree() && session_.mayMeasure(),
          {},
          [self] { self->measure(false); }};
}

std::vector<Command> LinearizePage::secondary() const {
  auto* self = const_cast<LinearizePage*>(this);
  if (isMeasuring())
    return {{tr("Stop"), Icon::stop, !job_.isStopping(), QKeySequence("Ctrl+K"), [self] { self->finish(); }}};
  if (session_.progress(Stage::linearization) != StageProgress::done) return {};
  return {{tr("Measure again"), Icon::retry, session_.areDevicesFree() && session_.mayMeasure(),
           QKeySequence("Ctrl+R"), [self] { self->measure(true); }}};
}

std::optional<double> LinearizePage::progress() const {
  return isMeasuring() ? std::optional(job_.fraction()) : std::nullopt;
}

std::optional<Banner> LinearizePage::banner() const {
  if (isMeasuring() && session_.isScreenMissing()) return missingScreen();
  if (isMeasuring() || session_.progress(Stage::linearization) != StageProgress::stale) return std::nullopt;
  auto* self = const_cast<LinearizePage*>(this);
  return Banner{
      Banner::Kind::amber,
      tr("These curves belong to earlier settings"),
      tr("They still work and stay until the new ones are measured."),
      {tr("Measure again"), Icon::retry, session_.mayMeasure(), {}, [self] { self->measure(false); }},
      {}};
}

std::optional<double> LinearizePage::seconds() const {
  const auto& measured = session_.figures<Stage::linearization>();
  if (!measured || !measured->cost) return std::nullopt;
  return measured->cost->seconds;
}

const ProjectorResponse* LinearizePage::response() const {
  return result_ && projector() < result_->projectors.size() ? &result_->projectors[projector()] : nullptr;
}

bool LinearizePage::addsUp() const {
  if (!result_) return true;
  double limit = session_.settings().linearization.additivityLimit;
  return std::all_of(result_->additivityError.begin(), result_->additivityError.end(),
                     [limit](double error) { return error <= limit; });
}

void LinearizePage::setLevels(int levels) {
  if (levels == this->levels()) return;
  changeUndoably(tr("Levels"), this->levels(), levels, [this](int wanted) { keepLevels(wanted); });
}

void LinearizePage::keepLevels(int levels) {
  if (isMeasuring()) return;
  CalibrateSettings settings = session_.settings();
  settings.linearization.levels = levels;
  try {
    session_.changeSettings(settings);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed."), {}, {}});
  }
}

void LinearizePage::measure(bool again) {
  if (isMeasuring() || !session_.areDevicesFree() || !session_.mayMeasure()) return;
  lease_ = session_.leaseDevices(stepName);
  // Another seed is another order of the levels: the result of before stays beside the new one.
  job_.start([work = workOf(session_), again](Progress& progress) {
    Progress opening = progress.part(0.2, tr("Opening the devices").toStdString());
    Rig& rig = work.devices->open(opening);
    CalibrationFolder folder = CalibrationFolder::open(work.path, CalibrationFolder::Access::write);
    if (again) {
      CalibrateSettings settings = settingsOf(folder);
      ++settings.linearization.seed;
      setShotsAside(folder, Stage::linearization);
      changeSettings(folder, settings);
    }
    Progress measuring = progress.part(0.8, tr("Measuring the response").toStdString());
    measureLinearization(folder, rig, measuring);
  });
  Q_EMIT changed();
}

void LinearizePage::finish() {
  session_.live().resume();
  job_.cancel();
}

void LinearizePage::ended() {
  if (session_.isOpen()) session_.reload();
  lease_.release();
  if (job_.state() == Job::State::failed) {
    Command again{tr("Try again"), Icon::retry, true, {}, [this] { measure(false); }};
    Q_EMIT failed({job_.failure(),
                   tr("Every photograph that was taken is on the disk. Trying again goes on from there."),
                   again,
                   {}});
  }
  Q_EMIT changed();
}

}  // namespace relucent
