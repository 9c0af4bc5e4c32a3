// SPDX-License-Identifier: MIT
#include "wizard/preview/preview_page.h"

#include <QFileInfo>
#include <QGuiApplication>
#include <algorithm>
#include <utility>

#include "output/default_picture.h"
#include "relucent/base/message.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/stored_settings.h"
#include "views/number_text.h"
#include "wizard/devices/projector_screens.h"
#include "wizard/session/results_beside.h"

namespace relucent::gui {
namespace {

void chooseInverse(const std::filesystem::path& path, Progress& progress) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::write);
  Progress reading =
      progress.part(0.3, RELUCENT_MESSAGE("stage.reading-light-transport", "Reading the light transport"));
  compensation::MeasuredVenue venue = pipeline::loadMeasuredVenue(folder, reading);
  Progress inverting = progress.part(
      0.7, RELUCENT_MESSAGE("stage.inverting-light-transport", "Inverting the light transport"));
  pipeline::measureInverse(folder, venue, inverting);
}

void make(PreviewEngine& engine, const std::filesystem::path& path, Progress& progress) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  engine.measured = pipeline::loadCalibration(folder, progress, pipeline::Held::allMeasured);
  compensation::CompensatorSettings settings;
  settings.clustering = pipeline::settingsOf(folder).clustering;
  engine.compensator.emplace(engine.measured.venue, engine.measured.inverse, settings);
  for (const linearization::ProjectorResponse& response : engine.measured.linearization.projectors)
    engine.encoders.emplace_back(response, 8, engine::Dither::blueNoise);
}

}  // namespace

PreviewPage::PreviewPage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent),
      computing_(
          [this](const Predicted& predicted) {
            preview_ = predicted.second;
            contradiction_ = nullptr;
            problem_.clear();
            surface_.present(sent());
            adoptContent(preview_->picture, preview_->content);
            findContradiction(predicted.first);
            compareNext();
            acceptSet();
            tellAll();
          },
          [this](const Failure& failure) { refuse(failure); }),
      contradicting_(
          [this](const Contradicting& found) {
            if (found.first != preview_) return;
            contradiction_ = found.second;
            tellResult();
          },
          [this](const Failure& failure) { refuse(failure); }),
      comparing_(
          [this](std::pair<int, MethodPreview> answer) {
            if (answer.first == round_) table_.push_back(answer.second);
            compareNext();
            tellResult();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("What is measured is safe.")}); }),
      reading_(
          [this](const std::pair<std::string, std::shared_ptr<const image::Image>>& read) {
            adoptContent(read.first, read.second);
            pipeline::ContentSettings after = settings_;
            after.picture = read.first;
            setSettings(after, tr("Picture"));
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("The picture of before stays.")}); }),
      perfecting_(session, stepName),
      masks_(
          settings_,
          [this](const pipeline::ContentSettings& settings, const QString& what) {
            setSettings(settings, what);
          },
          this) {
  connect(&perfecting_, &Perfecting::changed, this, [this] {
    tellStatus();
    tellResult();
  });
  connect(&perfecting_, &Perfecting::progressed, this, &PreviewPage::tellProgress);
  connect(&perfecting_, &Perfecting::failed, this, [this](const Failure& failure) {
    Q_EMIT failed({failure, tr("The picture is shown as before.")});
  });
  accept_ = addCommand(Icon::next, [this] { accept(); });
  goOnMeasuring_ = addCommand(Icon::play, [this] { Q_EMIT stepWanted("acquire"); });
  if (session_.isOpen()) settings_ = stored_ = session_.settings().content;
  set_ = session_.sets().nameInUse();
  shine_ = addCommand(Icon::projector, [this] { isShining() ? stopShining() : shine(); });
  compare_ = addCommand(Icon::picture, [this] { setShinesCorrected(!shinesCorrected()); });
  connect(&surface_, &SurfacePictures::changed, this, &PreviewPage::surfaceChanged);
  for (auto signal : {&QGuiApplication::screenAdded, &QGuiApplication::screenRemoved})
    connect(qGuiApp, signal, this, &PreviewPage::tellStatus);
  connect(&session_, &Session::opened, this, [this] {
    finish();
    masks_.choose(std::nullopt);
    settings_ = stored_ = session_.settings().content;
    set_ = session_.sets().nameInUse();
    isOtherSet_ = false;
    engine_ = nullptr;
    preview_ = nullptr;
    contradiction_ = nullptr;
    content_ = nullptr;
    problem_.clear();
    preparedFor_.clear();
    forgetTable();
    looked_ = false;
  });
  connect(&session_, &Session::stepsChanged, this, [this] {
    followSet();
    followContent();
    if (looked_) prepare();
    tellAll();
  });
  connect(&session_, &Session::devicesChanged, this, [this] {
    if (looked_) prepare();
    tellStatus();
  });
  connect(&job_, &Job::progressed, this, &PreviewPage::tellProgress);
  connect(&job_, &Job::ended, this, &PreviewPage::prepared);
  updateCommands();
}

void PreviewPage::leave() {
  masks_.cancel();
  looked_ = false;
  stopShining();
}

void PreviewPage::finish() {
  stopShining();
  perfecting_.cancel();
  job_.cancel();
}

void PreviewPage::enter() {
  looked_ = true;
  lookAtPicture();
  // What failed is tried again when somebody comes back to it, not before.
  if (job_.state() == Job::State::failed) preparedFor_.clear();
  prepare();
}

/// While it is measured again, of the earlier result.
void PreviewPage::prepare() {
  const bool isBeside = ResultsBeside::areNeeded(session_);
  if (!session_.isOpen() || job_.isRunning() || (!isBeside && !session_.areDevicesFree())) return;
  if (session_.correction() == preparedFor_) return;
  preparedFor_ = session_.correction();
  engine_ = nullptr;
  forgetTable();
  made_ = std::make_shared<PreviewEngine>();
  if (!isBeside) lease_ = session_.leaseDevices(stepName);
  job_.start([made = made_, path = session_.path(), isBeside](Progress& progress) {
    if (isBeside) return make(*made, ResultsBeside(path).path(), progress);
    Progress choosing = progress.part(
        0.7, RELUCENT_MESSAGE("stage.inverting-light-transport", "Inverting the light transport"));
    chooseInverse(path, choosing);
    Progress making =
        progress.part(0.3, RELUCENT_MESSAGE("stage.preparing-preview", "Preparing the preview"));
    make(*made, path, making);
  });
  tellStatus();
}

void PreviewPage::prepared() {
  const bool isLeased = session_.devicesUser() == stepName && !isShining();
  if (!isShining()) lease_.release();
  if (job_.state() == Job::State::done) {
    engine_ = std::exchange(made_, nullptr);
    const std::optional<Failure> unread = isLeased ? session_.readAgain() : std::nullopt;
    if (unread) Q_EMIT failed({*unread, tr("What is measured is safe.")});
    compute();
  } else {
    if (job_.state() == Job::State::cancelled) preparedFor_.clear();
    if (job_.state() == Job::State::failed) Q_EMIT failed({job_.failure(), tr("What is measured is safe.")});
  }
  tellResult();
}

QString PreviewPage::pictureName() const {
  return settings_.picture.empty() ? tr("Demonstration picture")
                                   : QFileInfo(QString::fromStdString(settings_.picture)).fileName();
}

void PreviewPage::choosePicture(const QString& file) {
  reading_.ask([file]() -> std::pair<std::string, std::shared_ptr<const image::Image>> {
    return {file.toStdString(), std::make_shared<image::Image>(linearContentOf(file))};
  });
}

void PreviewPage::adoptContent(const std::string& picture, std::shared_ptr<const image::Image> content) {
  if (contentOf_ != picture || !content_) forgetTable();
  contentOf_ = picture;
  content_ = std::move(content);
}

void PreviewPage::setSettings(const pipeline::ContentSettings& settings, const QString& what) {
  changeUndoably(what, settings_, settings,
                 [this](const pipeline::ContentSettings& wanted) { adopt(wanted); });
}

void PreviewPage::adopt(const pipeline::ContentSettings& settings) {
  // The methods are compared with the content in one place under one light.
  pipeline::ContentSettings sameMethod = settings;
  sameMethod.method = settings_.method;
  if (sameMethod != settings_) forgetTable();
  settings_ = settings;
  problem_.clear();
  compute();
  if (looked_) lookAtPicture();
  tellSettings();
}

void PreviewPage::setCorners(const compensation::Corners& corners) {
  if (!compensation::isConvex(corners)) {
    problem_ = tr("The corners cross over. Drag them apart.");
    tellSettings();
    return;
  }
  if (camera() > 0) {
    compensation::ViewSettings changed = view(camera());
    if (changed.placement != compensation::ViewPlacement::own) return;
    changed.corners = corners;
    return setView(camera(), changed, tr("Corners"));
  }
  pipeline::ContentSettings after = settings_;
  after.corners = corners;
  setSettings(after, tr("Corners"));
}

void PreviewPage::placeAutomatically() {
  if (camera() > 0) {
    compensation::ViewSettings changed = view(camera());
    changed.corners.reset();
    return setView(camera(), changed, tr("Automatic place"));
  }
  pipeline::ContentSettings after = settings_;
  after.corners.reset();
  setSettings(after, tr("Automatic place"));
}

bool PreviewPage::isPlacedByHand() const {
  return camera() == 0 ? settings_.corners.has_value() : view(camera()).corners.has_value();
}

std::optional<compensation::Corners> PreviewPage::corners() const {
  if (camera() > 0) {
    if (view(camera()).placement != compensation::ViewPlacement::own) return std::nullopt;
    if (view(camera()).corners) return view(camera()).corners;
  } else if (settings_.corners) {
    return settings_.corners;
  }
  return preview_ && camera() < preview_->views.size() ? preview_->views[camera()].corners : std::nullopt;
}

/// A place where nothing can be shown is no failure: the sentence stands beside the picture.
void PreviewPage::refuse(const Failure& failure) {
  if (failure.kind == ErrorKind::input)
    problem_ = session_.wasEndedEarly()
                   ? tr("What was measured is too coarse to place content. Go on measuring.")
                   : failure.what + ' ' + failure.advice;
  else
    Q_EMIT failed({failure, tr("What is measured is safe.")});
  tellSettings();
}

void PreviewPage::compute() {
  if (!engine_) return;
  computing_.ask(
      [engine = engine_, known = contentOf_ == settings_.picture ? content_ : nullptr,
       settings = placedSettings()] { return Predicted(settings, previewOf(*engine, settings, known)); });
  tellStatus();
}

/// Of another measurement, threshold, content or place, and what is still being computed for it.
void PreviewPage::forgetTable() {
  ++round_;
  table_.clear();
}

std::optional<MethodPreview> PreviewPage::chosenRow() const {
  const auto row = std::ranges::find(table_, settings_.method, &MethodPreview::method);
  return row == table_.end() ? std::nullopt : std::optional(*row);
}

std::optional<double> PreviewPage::expectedOfOthers() const {
  const auto& measured = session_.figures<calibration::Stage::acquisition>();
  return measured && measured->expected ? std::optional(measured->expected->now) : std::nullopt;
}

void PreviewPage::findContradiction(const pipeline::ContentSettings& settings) {
  if (!engine_ || preview_->views.size() < 2) return;
  contradicting_.ask([engine = engine_, settings, preview = preview_] {
    return Contradicting(preview, contradictionIn(*engine, settings, *preview));
  });
}

/// The table fills row by row while the pictures are there already.
void PreviewPage::compareNext() {
  if (!engine_ || !content_ || comparing_.isBusy() || computing_.isBusy() ||
      table_.size() >= comparedMethods.size())
    return;
  compensation::Method method = comparedMethods[table_.size()];
  comparing_.ask([engine = engine_, content = content_, settings = placedSettings(), method, round = round_] {
    return std::pair(round, methodPreviewOf(*engine, settings, *content, method));
  });
}

std::optional<Banner> PreviewPage::banner() const {
  using calibration::Stage;
  // Whatever else is out of date, it cannot be brought up to date by that.
  if (isNothingToldApart(session_) ||
      session_.progress(Stage::acquisition) == calibration::StageProgress::stale ||
      session_.progress(Stage::content) != calibration::StageProgress::stale)
    return onMeasurement(session_, goOnMeasuring_);
  const auto isSince = [&](Stage stage) {
    return session_.result(stage) && session_.result(stage)->stored > session_.result(Stage::content)->stored;
  };
  // Neither: somebody went back to what was measured or chosen before.
  return Banner{Banner::Kind::amber,
                isSince(Stage::acquisition) ? tr("It has been measured again since the content was placed")
                : isSince(Stage::threshold)
                    ? tr("The threshold has been changed since the content was placed")
                    : tr("The content was placed on another measurement or threshold"),
                tr("What you see here is predicted anew. Going to the output keeps it.")};
}

bool PreviewPage::isChanged() const {
  return session_.progress(calibration::Stage::content) != calibration::StageProgress::open &&
         placedSettings() != session_.settings().content;
}

StepStatus PreviewPage::status() const {
  if (job_.isRunning())
    return {session_.progress(calibration::Stage::content) == calibration::StageProgress::open
                ? StepState::open
                : StepState::done,
            tr("Preparing")};
  switch (session_.progress(calibration::Stage::content)) {
    case calibration::StageProgress::done:
      return {doneOn(session_),
              tr("%1 in reach").arg(percentText(session_.figures<calibration::Stage::content>()->reachable))};
    case calibration::StageProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case calibration::StageProgress::open:
      break;
  }
  return {};
}

QString PreviewPage::hint() const {
  if (isShining() && surface_.isScreenMissing()) return tr("The projector's screen is unplugged.");
  if (isShining())
    return shinesCorrected_ ? tr("On the surface now: the corrected picture.")
                            : tr("On the surface now: the uncorrected picture.");
  if (job_.isRunning()) return job_.stage();
  if (perfecting_.isRunning()) return perfecting_.stage();
  if (!engine_)
    return session_.areDevicesFree() ? tr("The preview is not prepared.")
                                     : tr("The devices are in use at %1.").arg(session_.devicesUserName());
  if (const QString why = whyLocked(); !why.isEmpty()) return why;
  if (!problem_.isEmpty()) return problem_;
  if (isComputing()) return tr("Predicting");
  if (!preview_) return {};
  if (session_.underWay().show) return tr("Predicted from the measurement. The output stays as it is.");
  return session_.isShownElsewhere()
             ? tr("Predicted from the measurement. Another program's show is projected.")
             : tr("Predicted from the measurement. Nothing is projected now.");
}

void PreviewPage::updateCommands() {
  goOnMeasuring_->show(toAcquireText(session_));
  accept_->show(tr("Go to output"), preview_ != nullptr && engine_ != nullptr && whyLocked().isEmpty());
  const QString why = whyNotShining();
  shine_->setGlyph(isShining() ? Icon::stop : Icon::projector);
  const QString borrowed = borrowedScreens();
  shine_->showUnless(why, isShining()          ? tr("Stop shining")
                          : borrowed.isEmpty() ? tr("Shine on surface")
                                               : tr("Shine on %1").arg(borrowed));
  shine_->setToolTip(!why.isEmpty() ? why
                     : borrowed.isEmpty()
                         ? tr("Shows this picture on the surface until you stop it or leave.")
                         : tr("A rehearsal has no surface: this lights the screen %1 until you "
                              "stop it or leave.")
                               .arg(borrowed));
  compare_->show(shinesCorrected_ ? tr("Show uncorrected") : tr("Show corrected"));
}

std::vector<PageCommand*> PreviewPage::secondary() const {
  if (isShining()) return {compare_, shine_};
  return {shine_};
}

/// One of what was measured before may be seen meanwhile.
QString PreviewPage::whyNoPreview() const {
  return job_.isRunning() ? tr("The preview is being prepared.") : tr("There is no preview yet.");
}

QString PreviewPage::whyNotShining() const {
  if (isShining()) return {};
  if (!preview_ || !engine_) return whyNoPreview();
  if (!session_.areDevicesFree()) return tr("The devices are in use at %1.").arg(session_.devicesUserName());
  const std::vector<ScreenIdentity> screens = projectorScreens(session_);
  if (screens.size() < preview_->sentWith.size())
    return tr("The projector's screen is not there. Plug it in and extend the desktop to it.");
  if (std::ranges::any_of(screens, &ProjectorWindow::isTaken))
    return tr("To shine on the surface, close the output first.");
  return {};
}

/// Of a rehearsal, which nobody expects to shine into the room: the screens that would, by name.
QString PreviewPage::borrowedScreens() const {
  QStringList names;
  if (session_.isOpen() && session_.isSimulated())
    for (const ScreenIdentity& screen : projectorScreens(session_)) names << screen.connector;
  return QLocale().createSeparatedList(names);
}

/// The devices are held meanwhile: nothing measures while the picture is in its way.
void PreviewPage::shine() {
  if (isShining() || !whyNotShining().isEmpty()) return;
  lease_ = session_.leaseDevices(stepName, DeviceWork::light);
  shinesCorrected_ = true;
  surface_.shine(projectorScreens(session_), sent());
}

const std::vector<QImage>& PreviewPage::sent() const {
  return shinesCorrected_ ? preview_->sentWith : preview_->sentWithout;
}

void PreviewPage::setShinesCorrected(bool corrected) {
  if (!isShining() || std::exchange(shinesCorrected_, corrected) == corrected) return;
  surface_.present(sent());
  tellStatus();
}

void PreviewPage::surfaceChanged() {
  if (!isShining() && !job_.isRunning()) lease_.release();
  tellStatus();
}

std::optional<double> PreviewPage::progress() const {
  if (perfecting_.isRunning()) return perfecting_.fraction();
  return job_.isRunning() ? std::optional(job_.fraction()) : std::nullopt;
}

void PreviewPage::accept() {
  if (keepPlacement()) Q_EMIT nextWanted();
}

bool PreviewPage::keepPlacement() {
  try {
    pipeline::CalibrateSettings settings = session_.settings();
    settings.content = placedSettings();
    session_.changeSettings(settings);
    session_.decide(calibration::ContentResult{preview_->reachableShare, preview_->deltaEMean});
    return true;
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe.")});
    return false;
  }
}

QString PreviewPage::whyNotPerfect() const {
  if (!preview_) return whyNoPreview();
  if (isShining()) return tr("A picture is on the surface.");
  // Real projectors show the output: the camera would photograph that.
  if (session_.underWay().show && !session_.isSimulated()) return tr("The output is open. Close it first.");
  return perfecting_.whyNot();
}

void PreviewPage::perfect() {
  if (whyNotPerfect().isEmpty() && keepPlacement()) perfecting_.start();
}

void PreviewPage::lookAtPicture() {
  const QString picture = QString::fromStdString(settings_.picture);
  perfecting_.lookAt(picture.isEmpty() ? defaultPicture() : picture, Canvas{QSize(0, 0)});
}

}  // namespace relucent::gui
