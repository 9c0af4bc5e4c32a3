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
#include "relucent/devices/check/test_exposure.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/rig/watched_rig.h"
#include "wizard/session/other_screens.h"

namespace relucent::gui {
namespace fs = std::filesystem;
namespace {

constexpr int audienceLimit = 3;  // patterns a second

/// Holds other screens up as the rig's own projectors, which their pictures are not to be taken for.
class OtherScreensWatcher : public rig::RigWatcher {
 public:
  explicit OtherScreensWatcher(std::shared_ptr<LiveRig> live) : live_(std::move(live)) {}
  void beforeShowing(std::size_t index, rig::RigLight& light) override { live_->beforeShowing(index, light); }

 private:
  std::shared_ptr<LiveRig> live_;
};

struct ProjectorSize {
  Size operator()(const pipeline::ReplayRigSettings&) const { return {}; }  // only the recording knows
  Size operator()(const auto& rig) const { return rig.projector; }
};

}  // namespace

/// Contract: guard_ is held.
rig::Rig& SessionDevices::opened(Progress& progress) {
  if (!opened_) {
    Progress opening = progress.part(hasScreen() ? 0.3 : 1.0,
                                     RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
    pipeline::OpenedRig opened = pipeline::openRig(settings_, cache_, screens_, opening);
    // What is simulated answers at once.
    if (!std::holds_alternative<venue::VenueSettings>(settings_))
      for (std::unique_ptr<rig::Camera>& camera : opened.rig.cameras)
        camera = std::make_unique<PatientCamera>(std::move(camera), waiting_);
    opened.rig = rig::watched(std::move(opened.rig), live_);
    {
      std::scoped_lock instant(screenGuard_);
      screen_ = opened.screen;
      if (screen_) screen_->setLatency(latency_.value_or(unmeasuredLatency()));
    }
    opened_ = std::move(opened);
  }
  return opened_->rig;
}

rig::Rig& SessionDevices::open(Progress& progress) {
  std::scoped_lock lock(guard_);
  rig::Rig& rig = opened(progress);
  // A camera that was turned away is looked through again.
  if (hasScreen() && !proof_.isSeen) prove(progress);
  return rig;
}

rig::Rig& SessionDevices::openUnproved(Progress& progress) {
  std::scoped_lock lock(guard_);
  return opened(progress);
}

void SessionDevices::lookFirst(const Progress& progress) {
  std::scoped_lock lock(guard_);
  require(opened_ && hasScreen(), "only an open screen is looked at first");
  devices::LatencySettings settling;
  settling.mostFrames = 1;  // show() waits long enough
  std::ignore = devices::testExposure(*opened_->rig.projectors.front(), *opened_->rig.cameras.front(),
                                      settling, devices::sleepFor, progress);
}

void SessionDevices::prove(Progress& progress) {
  Progress proving = progress.part(
      0.7, RELUCENT_MESSAGE("stage.finding-projector-picture", "Looking for the projector's picture"));
  rig::Projector& projector = *opened_->rig.projectors.front();
  rig::Camera& camera = *opened_->rig.cameras.front();
  devices::LatencySettings settling;
  settling.mostFrames = 1;  // show() waits long enough
  rig::Rig beside;  // watched as well: they flash no quicker, and pause as the projector's own screen does
  for (const pipeline::ScreenRigSettings& other :
       askForOtherScreens(std::get<pipeline::ScreenRigSettings>(settings_)))
    beside.projectors.push_back(devices::delayed(screens_(other), unmeasuredLatency(), devices::sleepFor));
  beside = rig::watched(std::move(beside), std::make_shared<OtherScreensWatcher>(live_));
  std::vector<rig::Projector*> others;
  for (const std::unique_ptr<rig::Projector>& other : beside.projectors) others.push_back(other.get());
  const devices::ScreenExposure exposureOf = [&](rig::Projector& screen) {
    return devices::testExposure(screen, camera, settling, devices::sleepFor, proving);
  };
  proof_ = devices::proveScreen(projector, others, camera, exposureOf, {}, proving);
  devices::requireSeen(proof_, projector, camera);
}

pipeline::RigCheck SessionDevices::check(Progress& progress) {
  std::scoped_lock lock(guard_);
  require(opened_ && hasScreen(), "only an open screen is checked");
  rig::Projector& projector = *opened_->rig.projectors.front();
  rig::Camera& camera = *opened_->rig.cameras.front();
  const double frame = 1.0 / std::get<pipeline::ScreenRigSettings>(settings_).frameRate;
  pipeline::RigCheck check;
  check.proof = proof_;

  Progress measuring =
      progress.part(0.6, RELUCENT_MESSAGE("stage.measuring-latency", "Measuring the latency"));
  devices::LatencySettings latency;
  latency.frame = frame;
  latency.mostFrames = patience_.mostFrames;
  screen()->setLatency(0.0);
  try {
    check.latency =
        devices::measureLatency(projector, camera, proof_.exposure, latency, devices::sleepFor, measuring);
  } catch (...) {
    screen()->setLatency(unmeasuredLatency());
    throw;
  }
  setLatency(check.latency.seconds);

  Progress judging = progress.part(0.4, RELUCENT_MESSAGE("stage.judging-light", "Judging the light"));
  devices::LightCheckSettings light;
  light.frame = frame;
  light.photographs = patience_.photographs;
  light.settle = patience_.mostFrames * frame;
  // Within a frame: that is what is judged.
  screen()->setWholeFrames(false);
  try {
    check.light = devices::checkLight(projector, camera, proof_.exposure, light, devices::sleepFor, judging);
  } catch (...) {
    screen()->setWholeFrames(true);
    throw;
  }
  screen()->setWholeFrames(true);
  return check;
}

std::shared_ptr<devices::ScreenControl> SessionDevices::screen() const {
  std::scoped_lock instant(screenGuard_);
  return screen_;
}

/// Long enough for most projectors: what proves the screen comes before what measures.
double SessionDevices::unmeasuredLatency() const {
  return patience_.mostFrames / std::get<pipeline::ScreenRigSettings>(settings_).frameRate / 3.0;
}

void SessionDevices::setLatency(double seconds) {
  std::scoped_lock instant(screenGuard_);
  latency_ = seconds;
  if (screen_) screen_->setLatency(seconds);
}

void SessionDevices::rest() {
  if (std::shared_ptr<devices::ScreenControl> used = screen()) used->rest();
}

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
  silence_.setInterval(250);
  connect(&silence_, &QTimer::timeout, this, &Session::listenForCamera);
}

QString Session::name() const {
  return QString::fromStdString(path_.filename().string());
}

void Session::open(const fs::path& path) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  adopt(folder);
}

void Session::begin(const fs::path& path, const pipeline::CalibrateSettings& settings) {
  calibration::CalibrationFolder folder = pipeline::beginCalibration(path, settings);
  adopt(folder);
}

void Session::adopt(const calibration::CalibrationFolder& folder) {
  path_ = fs::absolute(folder.path()).lexically_normal();
  if (path_.filename().empty()) path_ = path_.parent_path();
  acquisition_ = nullptr;
  acquired_.clear();
  live_->resume();  // work that still ends must not stand still for ever
  live_ = std::make_shared<LiveRig>();
  look(folder);
  roomClear_ = false;
  roomLight_.reset();
  slowDown();
  makeDevices();
  Q_EMIT opened();
  Q_EMIT stepsChanged();
  Q_EMIT acquisitionChanged();
  Q_EMIT devicesChanged();
}

/// Devices by the settings; those of before are let go of.
void Session::makeDevices() {
  devices_ = std::make_shared<SessionDevices>(
      settings_.rig, cache_, live_,
      [this](const pipeline::ScreenRigSettings& screen) { return openScreen(screen); }, patience_);
  const auto& checked = figures<calibration::Stage::camera>();
  if (checked && progress(calibration::Stage::camera) == calibration::StageProgress::done &&
      checked->latencySeconds)
    devices_->setLatency(*checked->latencySeconds);
}

/// Called on a worker's thread.
std::unique_ptr<devices::ScreenProjector> Session::openScreen(const pipeline::ScreenRigSettings& settings) {
  return std::make_unique<WindowProjector>(identityOf(settings.display), settings.projector,
                                           [self = QPointer<Session>(this)](bool waits) {
                                             if (!self) return;
                                             self->screenMissing_ = waits;
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
  {
    calibration::CalibrationFolder folder =
        calibration::CalibrationFolder::open(path_, calibration::CalibrationFolder::Access::write);
    try {
      write(folder);
    } catch (...) {
      makeDevices();
      throw;
    }
    look(folder);
  }
  makeDevices();
  tellSteps();
}

void Session::changeRig(const pipeline::RigSettings& rig) {
  changeDevices([&](calibration::CalibrationFolder& folder) { relucent::pipeline::changeRig(folder, rig); });
}

void Session::changeScreen(const pipeline::ScreenRigSettings& screen) {
  changeDevices(
      [&](calibration::CalibrationFolder& folder) { relucent::pipeline::changeScreen(folder, screen); });
}

void Session::close() {
  path_.clear();
  devices_ = nullptr;
  acquisition_ = nullptr;
  acquired_.clear();
  stages_ = {};
  figures_ = {};
  settings_ = {};
  Q_EMIT opened();
  Q_EMIT stepsChanged();
  Q_EMIT acquisitionChanged();
  Q_EMIT devicesChanged();
}

void Session::look(const calibration::CalibrationFolder& folder) {
  settings_ = pipeline::settingsOf(folder);
  const pipeline::RigSettings measured = pipeline::measuredRigOf(folder);
  const auto* screen = std::get_if<pipeline::ScreenRigSettings>(&measured);
  measuredDisplay_ = screen != nullptr ? screen->display : pipeline::ScreenRigSettings::Display();
  keptPhotographs_ = pipeline::keptPhotographs(folder);
  photographsRemoved_ = pipeline::werePhotographsRemoved(folder);
  figures_ = calibration::resultsIn(folder);
  for (calibration::Stage stage : allValues<calibration::Stage>())
    stages_[static_cast<std::size_t>(stage)] = {calibration::progressOf(folder, stage),
                                                calibration::resultOf(folder, stage)};
  for (calibration::Stage stage : {calibration::Stage::linearization, calibration::Stage::acquisition})
    stages_[static_cast<std::size_t>(stage)].mayReturn = pipeline::mayReturnToEarlier(folder, stage);
}

void Session::reload() {
  look(calibration::CalibrationFolder::open(path_, calibration::CalibrationFolder::Access::read));
  tellSteps();
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
  if (const auto* simulated = std::get_if<venue::VenueSettings>(&rig))
    for (const venue::VenueDescription& venue : venue::venues())
      if (venue.name == simulated->name) return static_cast<std::size_t>(venue.projectors);
  return 1;
}

std::size_t Session::cameras() const {
  if (const auto& measured = figures<calibration::Stage::acquisition>();
      measured && !measured->cameras.empty())
    return measured->cameras.size();
  if (const auto& measured = figures<calibration::Stage::linearization>(); measured && measured->cameras > 0)
    return measured->cameras;
  return 1;
}

Size Session::projectorSize(std::size_t projector) const {
  if (const auto& measured = figures<calibration::Stage::acquisition>();
      measured && projector < measured->projectors.size())
    return measured->projectors[projector];
  return std::visit(ProjectorSize{}, settings_.rig);
}

Rasters Session::projectorRasters() const {
  std::vector<Size> sizes;
  for (std::size_t i = 0; i < projectors(); ++i) sizes.push_back(projectorSize(i));
  return Rasters(std::move(sizes));
}

int Session::photographsKept(calibration::Stage stage) const {
  int count = 0;
  std::error_code code;
  const std::string begin = fmt::format("{}-", nameOf(stage));
  for (const fs::directory_entry& entry : fs::directory_iterator(path_ / "shots", code))
    if (entry.path().filename().string().starts_with(begin)) ++count;
  return count;
}

int Session::photographsSince(calibration::Stage stage) const {
  const auto& stored = result(stage);
  if (!stored) return 0;
  // Stored to the second, in which the last photographs of before may have been taken.
  const QDateTime when =
      QDateTime::fromString(QString::fromStdString(stored->stored), Qt::ISODate).addSecs(1);
  const QString begin = QString::fromUtf8(nameOf(stage)) + '-';
  const QDir shots(QString::fromStdString((path_ / "shots").string()));
  const QFileInfoList files = shots.entryInfoList({begin + '*'}, QDir::Files);
  return static_cast<int>(std::count_if(
      files.begin(), files.end(), [&when](const QFileInfo& file) { return file.lastModified() > when; }));
}

int Session::stoppedAt() const {
  const auto& measured = figures<calibration::Stage::acquisition>();
  return measured ? measured->stoppedAt : 0;
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
  slowDown();
  Q_EMIT devicesChanged();
}

void Session::slowDown() {
  bool real = isOpen() && hasLight();
  // Until somebody has said that the room is clear, an audience may be looking.
  int limit = flashLimit_ > 0 ? flashLimit_ : roomClear_ ? 0 : audienceLimit;
  live_->setLeastInterval(real && limit > 0 ? 1000 / limit : 0);
}

void Session::setRoomClear(bool clear) {
  roomClear_ = clear;
  slowDown();
  Q_EMIT devicesChanged();
}

void Session::setRoomLight(const RoomLight& light) {
  if (std::exchange(roomLight_, light) != light) Q_EMIT roomLightChanged();
}

DeviceLease Session::leaseDevices(const StepName& step, DeviceWork work) {
  require(areDevicesFree(), "the devices are in use");
  devicesUser_ = step;
  deviceWork_ = work;
  if (devices_) devices_->patience().wait();
  silence_.start();
  Q_EMIT devicesChanged();
  return DeviceLease(*this);
}

QString Session::whyLocked(const StepName& step) const {
  if (!devicesUser_ || *devicesUser_ == step) return {};
  return tr("%1 is at work. What is chosen here can be kept when that has ended.").arg(devicesUserName());
}

void Session::listenForCamera() {
  const bool isSilent = live_->isCameraSilent();
  const std::optional<Failure> failure = isSilent ? devices_->patience().failure() : std::nullopt;
  const QString why = failure ? failure->what : QString();
  const bool isNews = cameraSilent_ != isSilent || cameraFailure_ != why;
  cameraSilent_ = isSilent;
  cameraFailure_ = why;
  if (isNews) Q_EMIT devicesChanged();
}

void Session::giveUpCamera() {
  if (isCameraSilent()) devices_->patience().giveUp();
}

void Session::takeBackDevices() {
  devicesUser_.reset();
  silence_.stop();
  cameraSilent_ = false;
  cameraFailure_.clear();
  if (devices_) devices_->rest();
}

}  // namespace relucent::gui
