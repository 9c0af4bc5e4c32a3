// SPDX-License-Identifier: MIT
#include "wizard/session.h"

#include "calibration/results.h"
#include "pipeline/measuring.h"
#include "pipeline/stages.h"
#include "rig/watched_rig.h"

namespace relucent {
namespace fs = std::filesystem;

Rig& SessionDevices::open(Progress& progress) {
  std::scoped_lock lock(guard_);
  if (!opened_) {
    OpenedRig opened = openRig(settings_, cache_, progress);
    opened.rig = watched(std::move(opened.rig), live_);
    opened_ = std::move(opened);
  }
  return opened_->rig;
}

Session::Session(fs::path cache, QObject* parent)
    : QObject(parent),
      cache_(std::move(cache)),
      live_(std::make_shared<LiveRig>()),
      reading_(
          [this](std::shared_ptr<const Acquisition> acquisition) {
            acquisition_ = std::move(acquisition);
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            readFailure_ = failure;
            Q_EMIT changed();
          }) {}

QString Session::name() const {
  return QString::fromStdString(path_.filename().string());
}

void Session::open(const fs::path& path) {
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  adopt(folder);
}

void Session::begin(const fs::path& path, const CalibrateSettings& settings) {
  CalibrationFolder folder = beginCalibration(path, settings);
  adopt(folder);
}

void Session::adopt(const CalibrationFolder& folder) {
  path_ = fs::absolute(folder.path()).lexically_normal();
  if (path_.filename().empty()) path_ = path_.parent_path();
  acquisition_ = nullptr;
  acquired_.clear();
  live_->resume();  // work that still ends must not stand still for ever
  live_ = std::make_shared<LiveRig>();
  look(folder);
  roomClear_ = false;
  slowDown();
  devices_ = std::make_shared<SessionDevices>(settings_.rig, cache_, live_);
  Q_EMIT opened();
  Q_EMIT changed();
}

void Session::close() {
  path_.clear();
  devices_ = nullptr;
  acquisition_ = nullptr;
  acquired_.clear();
  steps_ = {};
  settings_ = {};
  Q_EMIT opened();
  Q_EMIT changed();
}

void Session::look(const CalibrationFolder& folder) {
  settings_ = settingsOf(folder);
  for (Step step : allSteps)
    steps_[static_cast<std::size_t>(step)] = {progressOf(folder, step), resultOf(folder, step)};
}

void Session::reload() {
  look(CalibrationFolder::open(path_, CalibrationFolder::Access::read));
  Q_EMIT changed();
}

bool Session::isSimulated() const {
  return std::holds_alternative<VenueSettings>(settings_.rig);
}

Size Session::projectorSize() const {
  return std::visit([](const auto& rig) { return rig.projector; }, settings_.rig);
}

int Session::photographsKept(Step step) const {
  int count = 0;
  std::error_code code;
  std::string begin = std::string(toString(step)) + "-";
  for (const fs::directory_entry& entry : fs::directory_iterator(path_ / "shots", code))
    if (entry.path().filename().string().starts_with(begin)) ++count;
  return count;
}

void Session::changeSettings(const CalibrateSettings& settings) {
  {
    CalibrationFolder folder = CalibrationFolder::open(path_, CalibrationFolder::Access::write);
    relucent::changeSettings(folder, settings);
    look(folder);
  }
  Q_EMIT changed();
}

void Session::decide(Step step, Json values) {
  {
    CalibrationFolder folder = CalibrationFolder::open(path_, CalibrationFolder::Access::write);
    storeDecision(folder, step, std::move(values));
    look(folder);
  }
  Q_EMIT changed();
}

void Session::wantAcquisition() {
  const std::optional<StageResult>& stored = result(Step::acquisition);
  if (!stored || stored->stored == acquired_) return;
  acquired_ = stored->stored;
  acquisition_ = nullptr;
  readFailure_.reset();
  reading_.ask([stored = *stored]() -> std::shared_ptr<const Acquisition> {
    return std::make_shared<Acquisition>(loadAcquisition(stored));
  });
}

void Session::setFlashLimit(int changesPerSecond) {
  flashLimit_ = changesPerSecond;
  slowDown();
  Q_EMIT changed();
}

void Session::slowDown() {
  bool real = isOpen() && !isSimulated();
  live_->setLeastInterval(real && flashLimit_ > 0 ? 1000 / flashLimit_ : 0);
}

void Session::setRoomClear(bool clear) {
  roomClear_ = clear;
  Q_EMIT changed();
}

void Session::setBusy(const QString& who) {
  busy_ = who;
  Q_EMIT changed();
}

}  // namespace relucent
