// SPDX-License-Identifier: MIT
#include "wizard/camera/camera_page.h"

#include <QDateTime>
#include <QLocale>
#include <algorithm>
#include <utility>

#include "relucent/base/message.h"
#include "text/message_text.h"
#include "text/written_times.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

constexpr double mostTooBright = 0.05;  // of the view, in every exposure

}  // namespace

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

double CameraPage::keptTooBright() const {
  const auto& kept = session_.figures<calibration::Stage::camera>();
  return kept ? kept->tooBright : 0.0;
}

StepStatus CameraPage::status() const {
  if (isLooking()) {
    bool done = session_.progress(calibration::Stage::camera) == calibration::StageProgress::done;
    return {done ? StepState::done : StepState::open, areChecksDone() ? tr("Checks done") : tr("Checking")};
  }
  if (const auto& result = session_.result(calibration::Stage::camera)) {
    const double bright = keptTooBright();
    if (bright > mostTooBright) return {StepState::doubtful, tr("%1 too bright").arg(percentText(bright))};
    QDateTime when = timeWritten(result->stored).toLocalTime();
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
  if (!session_.areDevicesFree() && !isLooking()) return session_.whyInUse();
  if (isChecking()) return job_.stage().isEmpty() ? tr("Opening the devices") : job_.stage();
  for (std::size_t camera = 0; camera < cameras(); ++camera)
    if (const std::optional<double> bright = tooBrightEverywhere(camera); bright && *bright > mostTooBright)
      return cameras() == 1 ? tr("%1 is too bright in every exposure.").arg(percentText(*bright))
                            : tr("Camera %1: %2 is too bright in every exposure.")
                                  .arg(camera + 1)
                                  .arg(percentText(*bright));
  if (waitsForConsent_) return whyNoChecks();
  if (isKept()) return tr("Checked before. Check again if camera or projector were moved.");
  if (!isChecked()) return tr("Look through the camera first.");
  return tr("Next: test patterns for the projector's response");
}

void CameraPage::updateCommands() {
  DevicePage::updateCommands();
  const bool seen =
      isChecked() || session_.progress(calibration::Stage::camera) == calibration::StageProgress::done;
  const bool free = session_.areDevicesFree();
  keep_->show(isKept() ? tr("Continue") : tr("Keep exposures"), seen && (free || isLooking()));
  // The checks begin anew, the view goes on where it was.
  pause_->setGlyph(isChecking() ? Icon::stop : Icon::pause);
  pause_->show(isChecking() ? tr("Stop the checks") : tr("Pause"));
  again_->showUnless(!free ? session_.whyInUse() : whyNoChecks(), tr("Check again"));
  chooseAnother_->show(tr("Choose another camera"), free);
  keepFormer_->show(tr("Keep the former camera"), free);
}

/// Of waiting, too, where they begin by themselves.
QString CameraPage::whyNoChecks() const {
  if (session_.mayMeasure() || !waitsForConsent_) return session_.whyNoPatterns();
  return tr("Confirm that the room is clear: the checks begin with that.");
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

bool CameraPage::isFocusJudged() const {
  return look() && image::tooBrightWithin(look()->check, look()->frame.signal.size(), focusArea()) <= 0.5;
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

}  // namespace relucent::gui
