// SPDX-License-Identifier: MIT
#include "wizard/linearize/linearize_page.h"

#include <algorithm>
#include <utility>

#include "relucent/base/message.h"
#include "relucent/base/time_left.h"
#include "relucent/calibration/results.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/stored_settings.h"
#include "text/message_text.h"
#include "views/number_text.h"
#include "wizard/devices/full_disk.h"

namespace relucent::gui {
namespace {

int photographsOf(const Session& session) {
  return session.live().taken(std::string(nameOf(calibration::Stage::linearization))).photographs;
}

}  // namespace

LinearizePage::LinearizePage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent), room_(this) {
  next_ = addCommand(Icon::next, [this] { Q_EMIT nextWanted(); });
  measure_ = addCommand(Icon::play, [this] { measure(false); });
  stop_ = addCommand(Icon::stop, [this] { finish(); }, QKeySequence("Ctrl+K"));
  again_ = addCommand(Icon::retry, [this] { measure(true); }, QKeySequence("Ctrl+R"));
  return_ = addCommand(Icon::back, [this] { returnToEarlier(); });
  retry_ = addCommand(Icon::retry, [this] { measure(false); });
  goOn_ = addCommand(Icon::play, [this] { room_.goOn(); });
  connect(&session_, &Session::opened, this, [this] {
    finish();
    result_.reset();
    shown_.clear();
    connect(&session_.live(), &LiveRig::seen, this, [this] {
      if (!isMeasuring()) return;
      tellProgress();
      const bool isDark = session_.live().isDark();
      if (isDark != std::exchange(wasDark_, isDark)) tellStatus();
    });
    look();
  });
  connect(&session_, &Session::acquisitionChanged, this, &LinearizePage::resultChanged);
  connect(&session_, &Session::stepsChanged, this, [this] {
    look();
    tellAll();
  });
  connect(&session_, &Session::devicesChanged, this, &LinearizePage::tellSettings);
  connect(&job_, &Job::progressed, this, &LinearizePage::tellProgress);
  connect(&job_, &Job::ended, this, &LinearizePage::ended);
  connect(&room_, &RoomQuestion::changed, this, &LinearizePage::tellStatus);
  updateCommands();
}

/// Takes what the folder holds, once for every result.
void LinearizePage::look() {
  const auto& stored = session_.result(calibration::Stage::linearization);
  if (!stored || stored->stored + stored->inputs == shown_) return;
  shown_ = stored->stored + stored->inputs;
  try {
    result_ = calibration::loadLinearization(*stored);
  } catch (...) {
    result_.reset();
    Q_EMIT failed(
        {failureOf(std::current_exception()), tr("The photographs of this step are still in the folder.")});
  }
}

StepStatus LinearizePage::status() const {
  if (isMeasuring())
    return {StepState::busy, tr("Measuring, %1").arg(percentText(job_.fraction())), result_.has_value()};
  switch (session_.progress(calibration::Stage::linearization)) {
    case calibration::StageProgress::done:
      if (result_ && !result_->additivityError.empty()) {
        if (isSpoilt()) return {StepState::doubtful, tr("Measure again")};
        const QString worst = percentText(worstAdditivity());
        if (!addsUp()) return {StepState::doubtful, tr("Colours off by %1").arg(worst)};
        return {StepState::done, tr("Colours within %1").arg(worst)};
      }
      return {StepState::done, tr("Measured")};
    case calibration::StageProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case calibration::StageProgress::open:
      break;
  }
  if (job_.state() == Job::State::failed) return {StepState::failed, tr("Stopped by a failure")};
  return {};
}

QString LinearizePage::hint() const {
  if (isMeasuring()) return job_.stage();
  if (!session_.areDevicesFree()) return tr("The devices are in use at %1.").arg(session_.devicesUserName());
  if (session_.progress(calibration::Stage::linearization) == calibration::StageProgress::done) {
    if (isSpoilt())
      return tr(
          "The photographs contradict each other. See that nothing covers the lens, then measure again.");
    if (!addsUp()) return tr("The colours do not add up. Continuing is recorded in the report.");
    if (auto took = seconds()) return tr("Measured in %1").arg(text(spentDuration(*took)));
  }
  if (!session_.mayMeasure()) return tr("Confirm that the room is clear: the patterns flash.");
  return tr("About %n test pattern(s)", nullptr,
            linearization::usualShots(session_.settings().linearization, projectors()));
}

void LinearizePage::updateCommands() {
  DevicePage::updateCommands();
  const bool free = session_.areDevicesFree() && session_.mayMeasure();
  next_->show(addsUp() && !isSpoilt() ? tr("Plan acquisition") : tr("Continue anyway"));
  measure_->setGlyph(isStale() ? Icon::retry : Icon::play);
  measure_->show(isStale() ? tr("Measure again") : tr("Measure response"), !isMeasuring() && free);
  stop_->showUnless(job_.isStopping() ? tr("Stopping after the photograph under way.") : QString(),
                    tr("Stop"));
  again_->showUnless(!session_.areDevicesFree()
                         ? tr("The devices are in use at %1.").arg(session_.devicesUserName())
                     : free ? QString()
                            : tr("To measure again, confirm that the room is clear."),
                     tr("Measure again"));
  return_->show(tr("Keep the earlier one"), session_.areDevicesFree());
  return_->setToolTip(tr("The earlier curves are used again, with all that followed from them."));
  retry_->show(tr("Try again"));
  goOn_->show(tr("Go on now"));
}

PageCommand* LinearizePage::primary() const {
  const bool done = session_.progress(calibration::Stage::linearization) == calibration::StageProgress::done;
  if (!done || isMeasuring()) return measure_;
  return isSpoilt() ? again_ : next_;
}

std::vector<PageCommand*> LinearizePage::secondary() const {
  if (isMeasuring()) return {stop_};
  if (session_.mayReturnToEarlier(calibration::Stage::linearization)) return {return_};
  if (session_.progress(calibration::Stage::linearization) != calibration::StageProgress::done) return {};
  return {isSpoilt() ? next_ : again_};
}

std::optional<double> LinearizePage::progress() const {
  return isMeasuring() ? std::optional(job_.fraction()) : std::nullopt;
}

std::optional<Banner> LinearizePage::banner() const {
  if (const auto disk = room_.waiting(); disk && isMeasuring()) return fullDisk(*disk, goOn_);
  if (isMeasuring() && session_.live().isDark())
    return Banner{
        Banner::Kind::amber, tr("The camera sees hardly any light of the projector"),
        tr("See that nothing covers the lens or the picture. What is photographed meanwhile is lost: "
           "stop, and measure again.")};
  if (isMeasuring()) return std::nullopt;
  if (!isStale()) return overTheShow();
  return Banner{Banner::Kind::amber, tr("These curves belong to earlier settings"),
                tr("They still work and stay until the new ones are measured.")};
}

bool LinearizePage::isStale() const {
  return session_.progress(calibration::Stage::linearization) == calibration::StageProgress::stale;
}

QString LinearizePage::whyLocked() const {
  if (isMeasuring()) return tr("Measuring with these settings. Stop to change them.");
  return session_.whyLocked(step());
}

std::optional<double> LinearizePage::seconds() const {
  const auto& measured = session_.figures<calibration::Stage::linearization>();
  if (!measured || !measured->cost) return std::nullopt;
  return measured->cost->seconds;
}

const linearization::ProjectorResponse* LinearizePage::response() const {
  return result_ && projector() < result_->projectors.size() ? &result_->projectors[projector()] : nullptr;
}

std::optional<double> LinearizePage::blackShare() const {
  if (!result_ || result_->blackShare) return result_ ? result_->blackShare : std::nullopt;
  // Results of earlier versions do not say: what was measured on them does, once it is read.
  const std::shared_ptr<const transport::Acquisition> measured = session_.acquisition();
  if (!measured) return std::nullopt;
  double black = 0.0, flood = 0.0;
  for (float value : measured->black) black += static_cast<double>(value);
  for (float value : measured->flood) flood += static_cast<double>(value);
  return flood > 0.0 ? std::optional(std::max(0.0, black / flood)) : std::nullopt;
}

int LinearizePage::photographs() const {
  return isMeasuring() ? photographsOf(session_) - begunAt_ : 0;
}

std::vector<double> LinearizePage::exposures() const {
  if (result_ && !isMeasuring()) return result_->exposures;
  const auto& checked = session_.figures<calibration::Stage::camera>();
  return checked ? checked->exposures : std::vector<double>();
}

double LinearizePage::worstAdditivity() const {
  return result_ && !result_->additivityError.empty() ? std::ranges::max(result_->additivityError) : 0.0;
}

bool LinearizePage::addsUp() const {
  return worstAdditivity() <= session_.settings().linearization.additivityLimit;
}

double largestResidual(const linearization::ProjectorResponse& response) {
  double most = 0.0;
  for (const std::vector<linearization::LevelResidual>& channel : response.residuals)
    for (const auto [drive, light] : channel) most = std::max(most, std::abs(light));
  return most;
}

double LinearizePage::worstResidual() const {
  double worst = 0.0;
  if (result_)
    for (const linearization::ProjectorResponse& response : result_->projectors)
      worst = std::max(worst, largestResidual(response));
  return worst;
}

/// Projectors with a white segment add as much light to white again as their colours have, hardly more.
bool LinearizePage::isSpoilt() const {
  // Of what a white segment adds, and of full light between a level and its curve, where a hundredth is
  // usual.
  constexpr double most = 1.5, farOff = 0.2;
  return worstAdditivity() > most || worstResidual() > farOff;
}

void LinearizePage::setLevels(int levels) {
  if (levels == this->levels() || !whyLocked().isEmpty()) return tellSettings();
  changeUndoably(tr("Levels"), this->levels(), levels, [this](int wanted) { keepLevels(wanted); });
}

void LinearizePage::keepLevels(int levels) {
  if (!whyLocked().isEmpty()) return tellSettings();
  pipeline::CalibrateSettings settings = session_.settings();
  settings.linearization.levels = levels;
  try {
    session_.changeSettings(settings);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
  }
}

void LinearizePage::measure(bool again) {
  if (isMeasuring() || !session_.areDevicesFree() || !session_.mayMeasure()) return;
  lease_ = session_.leaseDevices(stepName, DeviceWork::measurement, [this] { finish(); });
  undoStack().clear();  // what is measured with is not taken back by the way
  begunAt_ = photographsOf(session_);
  session_.live().forgetRamps();
  // Another seed is another order of the levels: the result of before stays beside the new one.
  job_.start([work = workOf(session_), again, room = &room_](Progress& progress) {
    room->countPauses([live = work.devices->sharedLive()] { return live->paused(); });
    Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->open(opening);
    calibration::CalibrationFolder folder =
        calibration::CalibrationFolder::open(work.path, calibration::CalibrationFolder::Access::write);
    if (again) pipeline::measureAgain(folder, calibration::Stage::linearization);
    Progress measuring =
        progress.part(0.8, RELUCENT_MESSAGE("stage.measuring-response", "Measuring the response"));
    pipeline::measureLinearization(folder, rig, room, measuring);
  });
  tellResult();
}

/// The curves of before, with all that followed from them.
void LinearizePage::returnToEarlier() {
  try {
    session_.returnToEarlier(calibration::Stage::linearization);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe.")});
  }
}

void LinearizePage::finish() {
  session_.live().resume();
  job_.cancel();
}

void LinearizePage::ended() {
  const std::optional<Failure> unread = session_.isOpen() ? session_.readAgain() : std::nullopt;
  lease_.release();
  if (job_.state() == Job::State::failed) {
    Q_EMIT failed({job_.failure(),
                   tr("Every photograph that was taken is on the disk. Trying again goes on from there."),
                   retry_});
  } else if (unread) {
    Q_EMIT failed({*unread, tr("What is measured is safe."), nullptr});
  }
  tellResult();
}

}  // namespace relucent::gui
