// SPDX-License-Identifier: MIT
#include "wizard/camera/camera_page.h"

#include <QDateTime>
#include <QElapsedTimer>
#include <QLocale>
#include <QThread>
#include <algorithm>
#include <utility>

#include "relucent/base/message.h"
#include "relucent/linearization/test_light.h"
#include "relucent/platform/memory_limits.h"
#include "text/message_text.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

constexpr double saturation = 0.97, dark = 0.01;
constexpr double mostTooBright = 0.05;          // of the view, in every exposure
constexpr unsigned long restMilliseconds = 20;  // between two checks of an answer that is waited for

image::Region centre(Size camera) {
  return {camera.width * 3 / 8, camera.height * 3 / 8, std::max(2, camera.width / 4),
          std::max(2, camera.height / 4)};
}

}  // namespace

/// What the looking thread and the interface tell each other.
struct CameraPage::Shared {
  QMutex guard;
  std::optional<pipeline::RigCheck> check;
  std::optional<linearization::ExposureChoice> choice;
  std::vector<pipeline::PixelForecast> pixels;
  std::optional<linearization::RigCoverage> coverage;
  std::vector<Watched> cameras;  // all but what is best
  std::size_t exposure = 0;
  bool posted = false;
};

CameraPage::CameraPage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent),
      firstLooks_(
          [this](FirstLook first) {
            // Of another venue, or of before.
            if (!isChecking() || first.of != shared_) return;
            for (std::size_t camera = 0; camera < first.looks.size(); ++camera) {
              if (camera >= cameras_.size()) cameras_.emplace_back();
              if (first.looks[camera]) cameras_[camera].look = std::move(first.looks[camera]);
            }
            tellAll();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, {}}); }) {
  keep_ = addCommand(Icon::next, [this] { goOn(); });
  pause_ = addCommand(Icon::pause, [this] { finish(); });
  again_ = addCommand(Icon::retry, [this] {
    forgetBest();
    start();
  });
  chooseAnother_ = addCommand(Icon::camera, [this] {
    const pipeline::ScreenRigSettings before = *session_.screenRig();
    exchangeCamera({}, std::nullopt);
    if (needsCamera()) former_ = {before.cameraAddress, before.camera};
    listCameras();
  });
  keepFormer_ = addCommand(Icon::back, [this] {
    if (former_) chooseCamera(former_->address, former_->size);
  });
  connect(&session_, &Session::opened, this, [this] {
    waitsForConsent_ = false;
    finish();
    forget();
    former_.reset();
    cameras_.clear();
    connect(&session_.live(), &LiveRig::seen, this, &CameraPage::lookAtCheck);
  });
  connect(&finder_, &CameraFinder::changed, this, [this] {
    Q_EMIT camerasListed();
    tellStatus();
  });
  connect(&finder_, &CameraFinder::failed, this,
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("Nothing was changed.")}); });
  connect(&session_, &Session::stepsChanged, this, &CameraPage::tellAll);
  connect(&session_, &Session::devicesChanged, this, [this] {
    if (waitsForConsent_ && session_.mayMeasure() && session_.areDevicesFree()) start();
    tellStatus();
  });
  connect(&job_, &Job::progressed, this, &CameraPage::tellProgress);
  connect(&job_, &Job::ended, this, &CameraPage::ended);
  updateCommands();
}

/// What was seen is of another venue or camera; what still arrives of it counts no more.
void CameraPage::forget() {
  goOn_ = startsAgain_ = false;
  shared_ = nullptr;
  forgetChecks();
  for (Watched& camera : cameras_) camera = {.area = camera.area};
}

/// They are made anew: what they came to before is no answer to what is asked now.
void CameraPage::forgetChecks() {
  check_.reset();
  exposures_ = {};
  pixels_.clear();
  coverage_.clear();
  rigCoverage_ = {};
  for (Watched& camera : cameras_) camera.tooBright = camera.tooDark = std::nullopt;
}

const CameraPage::Watched& CameraPage::watched(std::size_t camera) const {
  static const Watched nothing;
  return camera < cameras_.size() ? cameras_[camera] : nothing;
}

const std::optional<CameraLook>& CameraPage::look(std::size_t camera) const {
  return watched(camera).look;
}

std::optional<double> CameraPage::tooBrightEverywhere(std::size_t camera) const {
  return watched(camera).tooBright;
}

std::optional<double> CameraPage::tooDarkEverywhere(std::size_t camera) const {
  return watched(camera).tooDark;
}

image::Region CameraPage::focusArea(std::size_t camera) const {
  return watched(camera).area;
}

double CameraPage::focus(std::size_t camera) const {
  const Watched& one = watched(camera);
  return one.best > 0.0 && one.look ? std::min(1.0, one.look->sharpness / one.best) : 0.0;
}

void CameraPage::forgetBest() {
  for (Watched& camera : cameras_) camera.best = 0.0;
}

CameraPage::~CameraPage() {
  finish();
}

StepStatus CameraPage::status() const {
  if (isLooking()) {
    bool done = session_.progress(calibration::Stage::camera) == calibration::StageProgress::done;
    return {done ? StepState::done : StepState::open, areChecksDone() ? tr("Checks done") : tr("Checking")};
  }
  if (const auto& result = session_.result(calibration::Stage::camera)) {
    const double bright = session_.figures<calibration::Stage::camera>()->tooBright;
    if (bright > mostTooBright) return {StepState::doubtful, tr("%1 too bright").arg(percentText(bright))};
    QDateTime when = QDateTime::fromString(QString::fromStdString(result->stored), Qt::ISODate).toLocalTime();
    return {StepState::done, tr("Checked %1").arg(QLocale().toString(when.time(), QLocale::ShortFormat))};
  }
  // By the command line, where nobody looks first: what was measured is not locked behind a look.
  if (session_.result(calibration::Stage::linearization))
    return {StepState::done, tr("Exposures as measured")};
  return {};
}

bool CameraPage::areChecksDone() const {
  if (!isLooking() || isChecking_) return false;
  for (std::size_t camera = 0; camera < cameras(); ++camera)
    if (!tooBrightEverywhere(camera) || !tooDarkEverywhere(camera)) return false;
  return true;
}

bool CameraPage::needsCamera() const {
  const pipeline::ScreenRigSettings* screen = session_.screenRig();
  return screen != nullptr && screen->cameraAddress.empty();
}

/// What was measured belongs to its camera.
bool CameraPage::mayChooseCamera() const {
  return session_.screenRig() != nullptr &&
         session_.progress(calibration::Stage::linearization) == calibration::StageProgress::open;
}

void CameraPage::chooseCamera(const std::string& address, std::optional<Size> size) {
  exchangeCamera(address, size);
  if (!needsCamera()) start();
}

void CameraPage::exchangeCamera(const std::string& address, std::optional<Size> size) {
  if (!mayChooseCamera() || isLooking() || !session_.areDevicesFree()) return;
  try {
    pipeline::ScreenRigSettings rig = *session_.screenRig();
    rig.cameraAddress = address;
    rig.camera = size;
    session_.changeRig(rig);
    former_.reset();
    forget();
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
  }
  tellAll();
}

QString CameraPage::hint() const {
  if (needsCamera())
    return isListing() ? tr("Looking for cameras") : tr("Choose the camera that looks at the surface.");
  if (!session_.areDevicesFree() && !isLooking())
    return tr("The camera is in use at %1.").arg(session_.devicesUserName());
  if (isChecking()) return job_.stage().isEmpty() ? tr("Opening the devices") : job_.stage();
  for (std::size_t camera = 0; camera < cameras(); ++camera)
    if (const std::optional<double> bright = tooBrightEverywhere(camera); bright && *bright > mostTooBright)
      return cameras() == 1 ? tr("%1 is too bright in every exposure.").arg(percentText(*bright))
                            : tr("Camera %1: %2 is too bright in every exposure.")
                                  .arg(camera + 1)
                                  .arg(percentText(*bright));
  if (waitsForConsent_) return session_.whyNoPatterns();
  if (isKept()) return tr("Checked before. Check again if camera or projector were moved.");
  if (!isChecked()) return tr("Look through the camera first.");
  return tr("Next: test patterns for the projector's response");
}

void CameraPage::updateCommands() {
  const bool seen =
      isChecked() || session_.progress(calibration::Stage::camera) == calibration::StageProgress::done;
  const bool free = session_.areDevicesFree();
  keep_->show(isKept() ? tr("Continue") : tr("Keep exposures"), seen && (free || isLooking()));
  // The checks begin anew, the view goes on where it was.
  pause_->setGlyph(isChecking() ? Icon::stop : Icon::pause);
  pause_->show(isChecking() ? tr("Stop the checks") : tr("Pause"));
  again_->showUnless(!free ? session_.whyInUse() : session_.whyNoPatterns(), tr("Check again"));
  chooseAnother_->show(tr("Choose another camera"), free);
  keepFormer_->show(tr("Keep the former camera"), free);
}

std::vector<double> CameraPage::exposures() const {
  return isKept() ? session_.figures<calibration::Stage::camera>()->exposures : exposures_.seconds;
}

bool CameraPage::isKept() const {
  return !isLooking() && exposures_.seconds.empty() && !needsCamera() &&
         session_.figures<calibration::Stage::camera>().has_value();
}

QStringList CameraPage::keptVerdicts() const {
  QStringList sentences;
  if (isKept())
    for (const Message& verdict : session_.figures<calibration::Stage::camera>()->verdicts)
      sentences << fullSentence(verdict);
  return sentences;
}

std::optional<double> CameraPage::flickerPeriod() const {
  if (!check_) return std::nullopt;
  for (const devices::CheckVerdict& verdict : check_->light.verdicts)
    if ((verdict.finding == devices::Finding::lampFlickers ||
         verdict.finding == devices::Finding::colourWheel) &&
        verdict.frame > 0.0)
      return verdict.frame;
  return std::nullopt;
}

void CameraPage::setExposureUnit(double seconds) {
  if (seconds == exposureUnit() || (!session_.areDevicesFree() && !isLooking())) return tellSettings();
  changeUndoably(tr("Exposure times"), exposureUnit(), seconds,
                 [this](double wanted) { keepExposureUnit(wanted); });
}

void CameraPage::keepExposureUnit(double seconds) {
  if (!session_.areDevicesFree() && !isLooking()) return tellSettings();
  try {
    pipeline::CalibrateSettings settings = session_.settings();
    settings.linearization.exposureUnit = seconds;
    session_.changeSettings(settings);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
    return tellSettings();
  }
  startsAgain_ = isLooking();
  if (isLooking())
    finish();
  else
    start();
}

PageCommand* CameraPage::primary() const {
  return keep_;
}

std::vector<PageCommand*> CameraPage::secondary() const {
  if (isLooking()) return {pause_};
  if (needsCamera() && former_) return {keepFormer_};
  if (needsCamera()) return {};
  if (mayChooseCamera()) return {again_, chooseAnother_};
  return {again_};
}

std::optional<double> CameraPage::progress() const {
  return isChecking() ? std::optional(job_.fraction()) : std::nullopt;
}

/// A photograph that the checks took with all projectors white.
void CameraPage::lookAtCheck() {
  if (!isChecking()) return;
  bool isWhite = false;
  for (std::size_t projector = 0; projector < projectors(); ++projector) {
    const LivePictures live = session_.live().pictures(projector);
    const std::vector<float>& drive = live.pattern.data();
    isWhite =
        isWhite || (!drive.empty() && std::ranges::all_of(drive, [](float value) { return value >= 1.0f; }));
  }
  if (!isWhite) return;
  cameras_.resize(std::max(cameras_.size(), cameras()));
  std::vector<std::pair<rig::RawFrame, image::Region>> seen;
  for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
    rig::RawFrame frame = session_.live().pictures(0, camera).frame;
    if (!frame.signal.empty() && cameras_[camera].area == image::Region{})
      cameras_[camera].area = centre(frame.signal.size());
    seen.emplace_back(std::move(frame), cameras_[camera].area);
  }
  firstLooks_.ask([of = shared_, seen = std::move(seen)] {
    FirstLook first{of, {}};
    for (const auto& [frame, area] : seen) {
      std::optional<CameraLook>& look = first.looks.emplace_back();
      if (frame.signal.empty()) continue;
      look.emplace();
      look->frame = frame;
      look->check = image::checkPhotograph(frame.signal, saturation, dark);
      look->sharpness = sharpness(frame.signal, area);
    }
    return first;
  });
}

/// What is seen is kept when it is no longer being looked at.
void CameraPage::goOn() {
  if (!isChecked()) return Q_EMIT nextWanted();
  goOn_ = true;
  if (isLooking())
    job_.cancel();
  else
    ended();
}

void CameraPage::enter() {
  if (needsCamera()) return listCameras();
  bool wanted = session_.progress(calibration::Stage::camera) != calibration::StageProgress::done;
  if (wanted && session_.isOpen() && !job_.isRunning() && session_.areDevicesFree()) start();
}

void CameraPage::leave() {
  waitsForConsent_ = false;
  finish();
}

void CameraPage::finish() {
  if (!job_.isRunning()) return;
  job_.cancel();
}

void CameraPage::setFocusArea(const image::Region& area) {
  if (area == focusArea()) return;
  changeUndoably(tr("Focus area"), focusArea(), area,
                 [this, camera = camera()](const image::Region& wanted) { watch(camera, wanted); });
}

void CameraPage::watch(std::size_t camera, const image::Region& area) {
  if (camera >= cameras_.size()) cameras_.resize(camera + 1);
  cameras_[camera].area = area;
  cameras_[camera].best = 0.0;
  if (shared_) {
    QMutexLocker lock(&shared_->guard);
    if (camera < shared_->cameras.size()) shared_->cameras[camera].area = area;
  }
  tellSettings();
}

bool CameraPage::isFocusJudged() const {
  return look() && image::tooBrightWithin(look()->check, look()->frame.signal.size(), focusArea()) <= 0.5;
}

void CameraPage::chooseExposure(std::size_t index) {
  if (!mayChooseExposure()) return tellSettings();
  // Noise looks sharp: that of another exposure is no mark for this one.
  if (std::exchange(exposure_, index) != index) forgetBest();
  if (shared_) {
    QMutexLocker lock(&shared_->guard);
    shared_->exposure = index;
  }
  tellSettings();
}

void CameraPage::choosePixels(const reduction::PixelUse& use) {
  // Devices that measure keep the pixels that they measure with; what is shown goes back to those.
  if (use == pixels() || (!session_.areDevicesFree() && !isLooking())) return tellSettings();
  changeUndoably(tr("Camera pixels"), pixels(), use,
                 [this](const reduction::PixelUse& wanted) { keepPixels(wanted); });
}

void CameraPage::keepPixels(const reduction::PixelUse& use) {
  if (!session_.areDevicesFree() && !isLooking()) return tellSettings();
  try {
    session_.changePixels(use);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
  }
  tellSettings();
}

void CameraPage::start() {
  if (needsCamera() || !session_.areDevicesFree()) return;
  // The checks go from black to white and back.
  waitsForConsent_ = !session_.mayMeasure();
  if (waitsForConsent_) return tellStatus();
  goOn_ = false;
  isChecking_ = true;
  forgetChecks();
  shared_ = std::make_shared<Shared>();
  cameras_.resize(std::max(cameras_.size(), cameras()));
  for (const Watched& camera : cameras_) shared_->cameras.push_back({.area = camera.area});
  lease_ = session_.leaseDevices(stepName, DeviceWork::light, [this] {
    if (!isChecking_) return;  // the light that follows the checks stands still
    startsAgain_ = true;
    finish();
  });
  job_.start([this, shared = shared_, work = workOf(session_), settings = session_.settings().acquisition,
              unit = exposureUnit()](Progress& progress) {
    Progress opening = progress.part(0.1, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->openUnproved(opening);
    if (work.devices->hasScreen()) {
      Progress first =
          progress.part(0.1, RELUCENT_MESSAGE("stage.looking-through-camera", "Looking through the camera"));
      work.devices->lookFirst(first);
      Progress proving = progress.part(
          0.2, RELUCENT_MESSAGE("stage.finding-projector-picture", "Looking for the projector's picture"));
      work.devices->open(proving);
      Progress checking = progress.part(
          0.3, RELUCENT_MESSAGE("stage.checking-projector-and-camera", "Checking projector and camera"));
      pipeline::RigCheck check = work.devices->check(checking);
      QMutexLocker lock(&shared->guard);
      shared->check = std::move(check);
    }
    rig::NoShotLog nothing;
    rig::ShotTaker shots(rig, nothing, "camera");
    Progress exposing =
        progress.part(0.2, RELUCENT_MESSAGE("stage.finding-exposures", "Finding the exposures"));
    linearization::ExposureChoice choice = linearization::chooseExposures(shots, exposing, unit);
    std::vector<pipeline::PixelForecast> pixels =
        pipeline::pixelForecasts(rig, choice, shots.times(), settings, platform::memoryLeft());
    Progress covering = progress.part(
        0.1, RELUCENT_MESSAGE("stage.finding-what-is-seen", "Finding which part of the picture is seen"));
    linearization::RigCoverage coverage = linearization::coverageOf(shots, choice.flood.front(), covering);
    // A large camera's photographs would take up the memory that measuring needs.
    choice.whites.clear();
    choice.black = {};
    {
      QMutexLocker lock(&shared->guard);
      shared->pixels = std::move(pixels);
      shared->coverage = std::move(coverage);
      shared->cameras.resize(rig.cameras.size());
      shared->choice = choice;
      // The one between bright parts and shadows.
      shared->exposure = choice.seconds.size() / 2;
      for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera)
        if (shared->cameras[camera].area == image::Region{})
          shared->cameras[camera].area = centre(rig.cameras[camera]->size());
    }
    Progress looking =
        progress.part(0.0, RELUCENT_MESSAGE("stage.looking-through-camera", "Looking through the camera"));
    linearization::showEven(rig, {1, 1, 1});
    for (int number = shots.shots();; ++number) {
      looking.checkpoint();
      QElapsedTimer since;
      since.start();
      for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
        looking.checkpoint();
        std::size_t exposure = 0;
        image::Region area;
        {
          QMutexLocker lock(&shared->guard);
          const Watched& watched = shared->cameras[camera];
          exposure = std::min(shared->exposure, choice.seconds.size() - 1);
          area = watched.area;
          // The ends are looked at first: they tell what no exposure covers.
          if (!watched.tooBright)
            exposure = choice.seconds.size() - 1;
          else if (!watched.tooDark)
            exposure = 0;
        }
        CameraLook look;
        look.frame = rig.cameras[camera]->capture({{"camera", number}, 0, choice.seconds[exposure]});
        look.check = image::checkPhotograph(look.frame.signal, saturation, dark);
        look.sharpness = sharpness(look.frame.signal, area);
        look.exposure = exposure;
        QMutexLocker lock(&shared->guard);
        Watched& watched = shared->cameras[camera];
        if (exposure + 1 == choice.seconds.size()) watched.tooBright = look.check.tooBright;
        if (exposure == 0) watched.tooDark = look.check.tooDark;
        watched.look = std::move(look);
      }
      QMutexLocker lock(&shared->guard);
      if (!std::exchange(shared->posted, true))
        QMetaObject::invokeMethod(this, [this] { takeSharedState(); }, Qt::QueuedConnection);
      lock.unlock();
      // Twice a second: the screen's own light falls into the room.
      while (since.elapsed() < 500) {
        looking.checkpoint();
        QThread::msleep(restMilliseconds);
      }
    }
  });
  tellResult();
}

void CameraPage::takeSharedState() {
  if (!shared_) return;
  {
    QMutexLocker lock(&shared_->guard);
    shared_->posted = false;
    if (shared_->choice) {
      exposures_ = *std::exchange(shared_->choice, std::nullopt);
      pixels_ = shared_->pixels;
      rigCoverage_ = *shared_->coverage;
      coverage_ = rigCoverage_.byAnyCamera();
      exposure_ = shared_->exposure;
      isChecking_ = false;
    }
    if (shared_->check) check_ = std::exchange(shared_->check, std::nullopt);
    cameras_.resize(std::max(cameras_.size(), shared_->cameras.size()));
    for (std::size_t camera = 0; camera < shared_->cameras.size(); ++camera) {
      const Watched& seen = shared_->cameras[camera];
      cameras_[camera].tooBright = seen.tooBright;
      cameras_[camera].tooDark = seen.tooDark;
      cameras_[camera].area = seen.area;
      if (seen.look) cameras_[camera].look = seen.look;
    }
  }
  learnBest();
  tellAll();
}

/// Of looks with the exposure that is looked with.
void CameraPage::learnBest() {
  for (Watched& camera : cameras_)
    if (camera.look && camera.look->exposure == exposure_)
      camera.best = std::max(camera.best, camera.look->sharpness);
}

void CameraPage::ended() {
  takeSharedState();
  isChecking_ = false;
  // What was chosen last may not have been looked with any more: the picture that stays says which one was.
  if (look() && look()->exposure) exposure_ = *look()->exposure;
  lease_.release();
  if (job_.state() == Job::State::failed)
    Q_EMIT failed({job_.failure(), tr("Nothing is measured at this step, so nothing is lost.")});
  if (std::exchange(goOn_, false)) keepLook();
  if (std::exchange(startsAgain_, false)) return start();
  tellResult();
}

void CameraPage::keepLook() {
  calibration::CameraCheckResult kept;
  kept.exposures = exposures_.seconds;
  for (std::size_t camera = 0; camera < cameras(); ++camera)
    kept.tooBright = std::max(kept.tooBright, tooBrightEverywhere(camera).value_or(0.0));
  if (check_) {
    kept.latencySeconds = check_->latency.seconds;
    for (const devices::CheckVerdict& verdict : pipeline::verdictsOf(*check_))
      kept.verdicts.push_back(devices::messageOf(verdict));
  }
  try {
    session_.decide(kept);
    Q_EMIT nextWanted();
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
  }
}

}  // namespace relucent::gui
