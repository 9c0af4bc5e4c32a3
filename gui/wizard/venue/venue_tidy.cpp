// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_tidy.h"

namespace relucent::gui {

using pipeline::KeptPhotographs;

VenueTidy::VenueTidy(Session& session, const StepName& step, const QString& folder, QObject* parent)
    : QObject(parent), session_(session), step_(step), folder_(folder.toStdString()) {
  connect(&job_, &Job::progressed, this, &VenueTidy::changed);
  connect(&job_, &Job::ended, this, &VenueTidy::conclude);
  look();
}

QString VenueTidy::name() const {
  return QString::fromStdString(folder_.filename().string());
}

QString VenueTidy::problem(const Session& session) {
  return session.areDevicesFree()
             ? QString()
             : tr("%1 is at work. Space can be freed when it has ended.").arg(session.devicesUserName());
}

void VenueTidy::look() {
  job_.start([folder = folder_, survey = survey_](Progress& progress) {
    const std::vector<KeptPhotographs> choices = allValues<KeptPhotographs>();
    survey->asked = pipeline::keptPhotographs(
        calibration::CalibrationFolder::open(folder, calibration::CalibrationFolder::Access::read));
    for (KeptPhotographs kept : choices) {
      Progress part = progress.part(1.0 / static_cast<double>(choices.size()), progress.stage());
      survey->freed[kept] = pipeline::tidy({folder}, {kept, true}, part).calibrations.front();
    }
  });
}

void VenueTidy::choose(KeptPhotographs kept) {
  require(state_ == State::choosing, "a choice is made once all is known");
  kept_ = kept;
  turn(State::choosing);
}

void VenueTidy::ask() {
  require(state_ == State::choosing && freedBy(kept_).freed() > 0, "there is nothing to free");
  turn(State::asking);
}

void VenueTidy::goBack() {
  if (state_ == State::asking) turn(State::choosing);
}

void VenueTidy::free() {
  require(state_ == State::asking, "nothing is removed that nobody has agreed to");
  if (QString reason = problem(session_); !reason.isEmpty())
    return fail({ErrorKind::usage, reason, tr("Try again then."), {}});
  if (isOpenVenue()) lease_ = session_.leaseDevices(step_);
  job_.start([folder = folder_, kept = kept_, freed = freed_](Progress& progress) {
    *freed = pipeline::tidy({folder}, {kept, false}, progress).calibrations.front();
  });
  turn(State::freeing);
}

void VenueTidy::conclude() {
  lease_.release();
  if (state_ == State::freeing && isOpenVenue()) {
    try {
      session_.reload();
    } catch (...) {
      return fail(failureOf(std::current_exception()));
    }
  }
  switch (job_.state()) {
    case Job::State::failed:
      return fail(job_.failure());
    case Job::State::cancelled:
      return turn(State::stopped);
    case Job::State::idle:
    case Job::State::running:
    case Job::State::done:
      break;
  }
  if (state_ == State::freeing) return turn(State::done);
  kept_ = survey_->asked;
  turn(State::choosing);
}

void VenueTidy::fail(const Failure& failure) {
  failure_ = failure;
  turn(State::failed);
}

void VenueTidy::turn(State state) {
  state_ = state;
  Q_EMIT changed();
}

}  // namespace relucent::gui
