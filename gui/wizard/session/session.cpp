// SPDX-License-Identifier: MIT
#include "wizard/session/session.h"

#include <QDateTime>
#include <QDir>
#include <QPointer>
#include <algorithm>
#include <utility>

#include "output/window_projector.h"
#include "relucent/base/error.h"
#include "relucent/calibration/results.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/surprises_file.h"
#include "wizard/session/kept_shots.h"

namespace relucent::gui {
namespace fs = std::filesystem;
namespace {

struct ProjectorSize {
  std::size_t projector = 0;
  Size operator()(const pipeline::ReplayRigSettings&) const { return {}; }  // only the recording knows
  Size operator()(const pipeline::ScreenRigSettings& rig) const {
    const auto screens = pipeline::screensOf(rig);
    return projector < screens.size() ? screens[projector].projector : rig.projector;
  }
  Size operator()(const auto& rig) const { return rig.projector; }
};

std::optional<venue::VenueDescription> descriptionOf(const pipeline::RigSettings& rig) {
  if (const auto* simulated = std::get_if<venue::VenueSettings>(&rig))
    for (const venue::VenueDescription& venue : venue::venues())
      if (venue.name == simulated->name) return venue;
  return std::nullopt;
}

}  // namespace

Session::Session(fs::path cache, QObject* parent)
    : QObject(parent),
      cache_(std::move(cache)),
      live_(std::make_shared<LiveRig>()),
      reading_(
          [this](Read read) {
            if (read.measurement != acquired_) return;  // there is a newer one
            acquisition_ = std::move(read.acquisition);
            Q_EMIT acquisitionChanged();
          },
          [this](const Failure& failure) {
            readFailure_ = failure;
            Q_EMIT acquisitionChanged();
          }) {
  shows_.setInterval(2'000);
  connect(&shows_, &QTimer::timeout, this, &Session::lookForShow);
  shows_.start();
  ending_.setSingleShot(true);
  ending_.setInterval(std::chrono::seconds(15));  // films and cameras are closed in a few
  connect(&ending_, &QTimer::timeout, this, &Session::devicesChanged);
  consent_.setSingleShot(true);
  consent_.setInterval(std::chrono::minutes(30));
  connect(&consent_, &QTimer::timeout, this, [this] { setRoomClear(false); });
  silence_.setInterval(250);
  connect(&silence_, &QTimer::timeout, this, &Session::listenForCamera);
}

QString Session::name() const {
  return QString::fromStdString(path_.filename().string());
}

void Session::open(const fs::path& path) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  hold(folder.path());
  surprises_ = pipeline::loadSurprises(path);
  keepSurprises(path);
  adopt(std::move(folder));
}

void Session::begin(const fs::path& path, const pipeline::CalibrateSettings& settings,
                    const venue::SurpriseSettings& surprises) {
  calibration::CalibrationFolder folder = pipeline::beginCalibration(path, settings);
  hold(folder.path());
  surprises_ = surprises.kinds.empty() ? nullptr : std::make_shared<venue::Surprises>(surprises);
  if (surprises_) pipeline::saveSurprises(*surprises_, path);
  keepSurprises(path);
  adopt(std::move(folder));
}

/// How far they have come is kept as soon as it changes: a light that is on stays on when the venue is opened
/// again, and what is still to come comes then.
void Session::keepSurprises(const fs::path& path) {
  if (!surprises_) return;
  surprises_->tellChanges([path](const venue::Surprises& surprises) {
    try {
      pipeline::saveSurprises(surprises, path);
    } catch (const Error&) {
      // A disk that is full is told of by what measures.
    }
  });
}

void Session::hold(const fs::path& venue) {
  std::error_code ignored;
  if (isOpen() && fs::equivalent(venue, path_, ignored)) return;
  std::optional<VenueUse> use = VenueUse::take(venue, VenueUse::Way::wizard);
  if (!use)
    throw Error(ErrorKind::input,
                RELUCENT_MESSAGE("session.open-in-another-window",
                                 "this venue is open in another window of Relucent"),
                RELUCENT_MESSAGE("session.close-other-window", "go on there, or close it there first"),
                venue.string());
  use_ = std::move(use);
}

std::optional<Session::OtherShow> Session::otherShow() const {
  if (!isOpen()) return std::nullopt;
  if (VenueUse::isTaken(path_, VenueUse::Way::show)) return OtherShow{path_, VenueUse::Way::show};
  for (std::size_t projector = 0; projector < projectors(); ++projector) {
    const std::optional<pipeline::ScreenRigSettings> rig = screenOf(projector);
    if (!rig) continue;
    const fs::path screen = VenueUse::ofScreen(QString::fromStdString(rig->display.connector));
    if (VenueUse::isTaken(screen, VenueUse::Way::screen)) return OtherShow{screen, VenueUse::Way::screen};
  }
  return std::nullopt;
}

void Session::lookForShow() {
  const std::optional<OtherShow> now = otherShow();
  if (std::exchange(otherShow_, now) == now) return;
  leaveDevicesToShow();
  Q_EMIT devicesChanged();
}

/// Its camera is to look after the picture at night. What is held for later would be another program's to it.
void Session::leaveDevicesToShow() {
  if (otherShow_) letGoOfDevices();
}

void Session::endOtherShow() {
  if (otherShow_ && VenueUse::end(otherShow_->what, otherShow_->way)) {
    ending_.start();
    Q_EMIT devicesChanged();
    return;
  }
  if (!otherShow()) return;
  throw Error(
      ErrorKind::input,
      RELUCENT_MESSAGE("session.cannot-end-show", "the other program may not be ended from here"),
      RELUCENT_MESSAGE("session.end-show-itself", "hold Esc on the projector's picture for two seconds"));
}

void Session::putRight() {
  if (surprises_) surprises_->putRight();
}

void Session::adopt(calibration::CalibrationFolder given) {
  {
    // Let go of before others are told: a page that is opened with it may write to it at once.
    const calibration::CalibrationFolder folder = std::move(given);
    path_ = fs::absolute(folder.path()).lexically_normal();
    if (path_.filename().empty()) path_ = path_.parent_path();
    look(folder);
  }
  acquisition_ = nullptr;
  acquired_.clear();
  live_->resume();  // work that still ends must not stand still for ever
  live_ = std::make_shared<LiveRig>();
  roomClear_ = false;
  consent_.stop();
  roomLight_.reset();
  slowDown();
  makeDevices();
  otherShow_ = otherShow();
  ending_.stop();
  Q_EMIT opened();
  Q_EMIT stepsChanged();
  Q_EMIT acquisitionChanged();
  Q_EMIT devicesChanged();
}

/// Devices by the settings; those of before are let go of.
void Session::makeDevices() {
  devices_ = std::make_shared<SessionDevices>(
      settings_.rig, cache_, live_,
      [this](const pipeline::ScreenRigSettings& screen) { return openScreen(screen); }, patience_, surprises_,
      pipeline::ProjectorWarmUp(settings_.network, settings_.rig));
  const auto& checked = figures<calibration::Stage::camera>();
  if (checked && progress(calibration::Stage::camera) == calibration::StageProgress::done &&
      checked->latencySeconds)
    devices_->setLatency(*checked->latencySeconds);
}

void Session::letGoOfDevices() {
  if (!isOpen() || !areDevicesFree()) return;
  devices_ = nullptr;  // first: nobody else is let to a camera that is held
  makeDevices();
}

/// Called on a worker's thread.
std::unique_ptr<devices::ScreenProjector> Session::openScreen(const pipeline::ScreenRigSettings& settings) {
  return std::make_unique<WindowProjector>(
      identityOf(settings.display), settings.projector,
      [self = QPointer<Session>(this), connector = settings.display.connector](bool waits) {
        if (!self) return;
        if (waits)
          self->missingScreens_.insert(connector);
        else
          self->missingScreens_.erase(connector);
        Q_EMIT self->devicesChanged();
      });
}

/// What was read of a measurement that is no longer the one is let go of.
void Session::tellSteps() {
  const bool isOld = !acquired_.empty() && acquired_ != measurement();
  if (isOld) {
    acquisition_ = nullptr;
    acquired_.clear();
  }
  Q_EMIT stepsChanged();
  if (isOld) Q_EMIT acquisitionChanged();
}

void Session::changeDevices(const std::function<void(calibration::CalibrationFolder&)>& write) {
  devices_ = nullptr;  // nobody else is let to a camera that is held
  try {
    calibration::CalibrationFolder folder =
        calibration::CalibrationFolder::open(path_, calibration::CalibrationFolder::Access::write);
    write(folder);
    look(folder);
  } catch (...) {
    makeDevices();
    throw;
  }
  makeDevices();
  tellSteps();
}

/// Whoever types a command agrees to it, and not to those that were there before.
void Session::agreeToTyped(std::vector<std::string> commands) const {
  const std::vector<std::string> before = pipeline::commandsOf(settings_.rig);
  std::erase_if(commands, [&before](const std::string& command) {
    return std::find(before.begin(), before.end(), command) != before.end();
  });
  devices::giveConsent(commands);
}

void Session::changeRig(const pipeline::RigSettings& rig) {
  agreeToTyped(pipeline::commandsOf(rig));
  changeDevices([&](calibration::CalibrationFolder& folder) { relucent::pipeline::changeRig(folder, rig); });
}

void Session::changeCommands(const std::vector<std::string>& commands) {
  agreeToTyped(commands);
  changeDevices(
      [&](calibration::CalibrationFolder& folder) { relucent::pipeline::changeCommands(folder, commands); });
}

void Session::changeScreen(const pipeline::ScreenRigSettings& screen, std::size_t projector) {
  changeDevices([&](calibration::CalibrationFolder& folder) {
    relucent::pipeline::changeScreen(folder, screen, projector);
  });
}

void Session::close() {
  path_.clear();
  use_.reset();
  lookForShow();
  devices_ = nullptr;
  acquisition_ = nullptr;
  acquired_.clear();
  stages_ = {};
  figures_ = {};
  settings_ = {};
  sets_ = {};
  setsFailure_.reset();
  Q_EMIT opened();
  Q_EMIT stepsChanged();
  Q_EMIT acquisitionChanged();
  Q_EMIT devicesChanged();
}

void Session::look(const calibration::CalibrationFolder& folder) {
  settings_ = pipeline::settingsOf(folder);
  const pipeline::RigSettings measured = pipeline::measuredRigOf(folder);
  measuredDisplays_.clear();
  if (const auto* screens = std::get_if<pipeline::ScreenRigSettings>(&measured))
    for (const auto& screen : pipeline::screensOf(*screens)) measuredDisplays_.push_back(screen.display);
  keptPhotographs_ = pipeline::keptPhotographs(folder);
  photographsRemoved_ = pipeline::werePhotographsRemoved(folder);
  shownFrom_ = pipeline::fingerprintOfShown(folder);
  correction_ = pipeline::fingerprintOfCorrection(folder);
  sets_ = {};
  setsFailure_.reset();
  try {
    sets_ = pipeline::setsOf(folder);
  } catch (const Error&) {
    setsFailure_ = failureOf(std::current_exception());
  }
  figures_ = calibration::resultsIn(folder);
  for (calibration::Stage stage : allValues<calibration::Stage>())
    stages_[static_cast<std::size_t>(stage)] = {calibration::progressOf(folder, stage),
                                                calibration::resultOf(folder, stage)};
  for (calibration::Stage stage : {calibration::Stage::linearization, calibration::Stage::acquisition}) {
    StageState& state = stages_[static_cast<std::size_t>(stage)];
    state.mayReturn = pipeline::mayReturnToEarlier(folder, stage);
    state.hasEarlier = pipeline::hasEarlier(folder, stage);
  }
  // What was decided on a measurement counts as long as that is used.
  for (calibration::Stage stage : {calibration::Stage::threshold, calibration::Stage::inverse,
                                   calibration::Stage::clustering, calibration::Stage::content})
    stages_[static_cast<std::size_t>(stage)].progress =
        pipeline::progressInUse(folder, stage, calibration::Stage::acquisition);
}

void Session::reload() {
  look(calibration::CalibrationFolder::open(path_, calibration::CalibrationFolder::Access::read));
  tellSteps();
}

std::optional<Failure> Session::readAgain() {
  try {
    reload();
  } catch (const Error&) {
    return failureOf(std::current_exception());
  }
  return std::nullopt;
}

bool Session::isSimulated() const {
  return std::holds_alternative<venue::VenueSettings>(settings_.rig);
}

bool Session::hasLight() const {
  return std::holds_alternative<pipeline::CommandRigSettings>(settings_.rig) || screenRig() != nullptr;
}

std::size_t Session::projectors() const {
  if (const auto& measured = figures<calibration::Stage::acquisition>();
      measured && !measured->projectors.empty())
    return measured->projectors.size();
  if (const auto& measured = figures<calibration::Stage::linearization>();
      measured && measured->projectors > 0)
    return measured->projectors;
  return projectorsOf(settings_.rig);
}

std::size_t Session::projectorsOf(const pipeline::RigSettings& rig) {
  if (const auto* screens = std::get_if<pipeline::ScreenRigSettings>(&rig))
    return 1 + screens->moreScreens.size();
  const auto venue = descriptionOf(rig);
  return venue ? static_cast<std::size_t>(venue->projectors) : 1;
}

std::size_t Session::camerasOf(const pipeline::RigSettings& rig) {
  if (const auto* screens = std::get_if<pipeline::ScreenRigSettings>(&rig))
    return 1 + screens->moreCameras.size();
  const auto venue = descriptionOf(rig);
  return venue ? static_cast<std::size_t>(venue->cameras) : 1;
}

std::size_t Session::cameras() const {
  if (const auto& measured = figures<calibration::Stage::acquisition>();
      measured && !measured->cameras.empty())
    return measured->cameras.size();
  if (const auto& measured = figures<calibration::Stage::linearization>(); measured && measured->cameras > 0)
    return measured->cameras;
  return camerasOf(settings_.rig);
}

Size Session::projectorSize(std::size_t projector) const {
  if (const auto& measured = figures<calibration::Stage::acquisition>();
      measured && projector < measured->projectors.size())
    return measured->projectors[projector];
  return std::visit(ProjectorSize{projector}, settings_.rig);
}

std::optional<pipeline::ScreenRigSettings> Session::screenOf(std::size_t projector) const {
  if (screenRig() == nullptr || projector >= pipeline::screensOf(*screenRig()).size()) return std::nullopt;
  return pipeline::withScreenAlone(*screenRig(), projector);
}

QString Session::projectorName(std::size_t projector) const {
  if (screenRig() == nullptr) return {};
  const auto screens = pipeline::screensOf(*screenRig());
  return projector < screens.size() ? QString::fromStdString(screens[projector].name) : QString();
}

QString Session::cameraName(std::size_t camera) const {
  if (screenRig() == nullptr) return {};
  const auto cameras = pipeline::camerasOf(*screenRig());
  return camera < cameras.size() ? QString::fromStdString(cameras[camera].name) : QString();
}

std::optional<std::size_t> Session::projectorWithoutScreen() const {
  if (screenRig() == nullptr) return std::nullopt;
  const auto screens = pipeline::screensOf(*screenRig());
  const auto missing = std::ranges::find_if(
      screens, [this](const auto& screen) { return missingScreens_.contains(screen.display.connector); });
  if (missing == screens.end()) return std::nullopt;
  return static_cast<std::size_t>(missing - screens.begin());
}

pipeline::ScreenRigSettings::Display Session::measuredDisplay(std::size_t projector) const {
  return projector < measuredDisplays_.size() ? measuredDisplays_[projector]
                                              : pipeline::ScreenRigSettings::Display();
}

Rasters Session::projectorRasters() const {
  std::vector<Size> sizes;
  for (std::size_t i = 0; i < projectors(); ++i) sizes.push_back(projectorSize(i));
  return Rasters(std::move(sizes));
}

int Session::photographsKept(calibration::Stage stage) const {
  return gui::photographsKept(path_, stage);
}

int Session::photographsSince(calibration::Stage stage) const {
  return gui::photographsSince(path_, result(stage), stage);
}

int Session::stoppedAt() const {
  const auto& measured = figures<calibration::Stage::acquisition>();
  return measured ? measured->stoppedAt : 0;
}

std::optional<transport::FoundChange> Session::foundChange() const {
  const auto& measured = figures<calibration::Stage::acquisition>();
  return measured ? measured->changed : std::nullopt;
}

std::optional<double> Session::poorQuality() const {
  const auto& measured = figures<calibration::Stage::acquisition>();
  if (!measured || !measured->expected || !transport::isPoor(*measured->expected)) return std::nullopt;
  return measured->expected->whole;
}

std::optional<double> Session::leftOut() const {
  constexpr double most = 0.1;  // a hole that anybody sees
  const auto& measured = figures<calibration::Stage::acquisition>();
  return measured && measured->leftOut > most ? std::optional(measured->leftOut) : std::nullopt;
}

bool Session::isOverexposed() const {
  const auto& measured = figures<calibration::Stage::acquisition>();
  return measured && 2.0 * measured->overexposed > measured->leftOut;
}

void Session::change(const std::function<void(calibration::CalibrationFolder&)>& write) {
  {
    calibration::CalibrationFolder folder =
        calibration::CalibrationFolder::open(path_, calibration::CalibrationFolder::Access::write);
    write(folder);
    look(folder);
  }
  tellSteps();
}

void Session::changeSettings(const pipeline::CalibrateSettings& settings) {
  change(
      [&](calibration::CalibrationFolder& folder) { relucent::pipeline::changeSettings(folder, settings); });
}

void Session::returnToEarlier(calibration::Stage stage) {
  change([stage](calibration::CalibrationFolder& folder) { pipeline::returnToEarlier(folder, stage); });
}

void Session::keepPhotographs(pipeline::KeptPhotographs kept) {
  change([&](calibration::CalibrationFolder& folder) { pipeline::keepPhotographs(folder, kept); });
}

void Session::changePixels(const reduction::PixelUse& use) {
  change([&](calibration::CalibrationFolder& folder) { relucent::pipeline::changePixels(folder, use); });
}

std::string Session::measurement() const {
  const std::optional<calibration::StageResult>& stored = result(calibration::Stage::acquisition);
  return stored ? stored->stored + ' ' + stored->folder.string() : std::string();
}

void Session::wantAcquisition() {
  const std::optional<calibration::StageResult>& stored = result(calibration::Stage::acquisition);
  if (!stored || measurement() == acquired_) return;
  acquired_ = measurement();
  acquisition_ = nullptr;
  readFailure_.reset();
  reading_.ask([name = acquired_, stored = *stored]() -> Read {
    return {name, std::make_shared<transport::Acquisition>(calibration::loadAcquisition(stored))};
  });
}

void Session::setFlashLimit(int changesPerSecond) {
  flashLimit_ = changesPerSecond;
  consentChanged();
}

void Session::slowDown() {
  bool real = isOpen() && hasLight();
  // Until somebody has said that the room is clear, an audience may be looking.
  int limit = flashLimit_ > 0 ? flashLimit_ : roomClear_ ? 0 : audienceLimit;
  live_->setLeastInterval(real && limit > 0 ? 1000 / limit : 0);
}

void Session::setRoomClear(bool clear) {
  roomClear_ = clear;
  clear&& areDevicesFree() ? consent_.start() : consent_.stop();
  consentChanged();
}

void Session::consentChanged() {
  slowDown();
  // Somebody has come in, or is about to. Copied: ending the lease drops it.
  const auto unclear = whenUnclear_;
  if (unclear && !mayMeasure()) unclear();
  Q_EMIT devicesChanged();
}

void Session::setRoomLight(const std::optional<RoomLight>& light) {
  if (std::exchange(roomLight_, light) != light) Q_EMIT roomLightChanged();
}

void Session::setShowing(bool showing) {
  if (std::exchange(isShowing_, showing) == showing) return;
  Q_EMIT showingChanged();
  Q_EMIT devicesChanged();
}

DeviceLease Session::leaseDevices(const StepName& step, DeviceWork work, std::function<void()> whenUnclear) {
  require(areDevicesFree(), "the devices are in use");
  devicesUser_ = step;
  consent_.stop();
  deviceWork_ = work;
  whenUnclear_ = std::move(whenUnclear);
  if (devices_) devices_->patience().wait();
  silence_.start();
  // What was seen for the work before says nothing of now.
  if (std::exchange(roomLight_, std::nullopt)) Q_EMIT roomLightChanged();
  Q_EMIT devicesChanged();
  return DeviceLease(*this);
}

QString Session::whyLocked(const StepName& step) const {
  if (!devicesUser_ || *devicesUser_ == step) return {};
  return tr("%1 is at work. What is chosen here can be kept when that has ended.").arg(devicesUserName());
}

void Session::listenForCamera() {
  // Until its light is back the photograph waits for the screen, whatever the camera does.
  if (isScreenMissing()) live_->waitAnew();
  const std::optional<std::size_t> silent = live_->silentCamera();
  const std::optional<Failure> failure = silent ? devices_->patience().failure() : std::nullopt;
  const QString why = failure ? failure->what : QString();
  const bool isNews = silentCamera_ != silent || cameraFailure_ != why;
  silentCamera_ = silent;
  cameraFailure_ = why;
  if (isNews) Q_EMIT devicesChanged();
}

void Session::giveUpCamera() {
  if (isCameraSilent()) devices_->patience().giveUp();
}

void Session::takeBackDevices() {
  devicesUser_.reset();
  whenUnclear_ = nullptr;
  if (roomClear_) consent_.start();
  silence_.stop();
  silentCamera_.reset();
  cameraFailure_.clear();
  if (devices_) devices_->rest();
  leaveDevicesToShow();
}

}  // namespace relucent::gui
