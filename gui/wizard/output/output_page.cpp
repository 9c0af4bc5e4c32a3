// SPDX-License-Identifier: MIT
#include "wizard/output/output_page.h"

#include <QDesktopServices>
#include <QGuiApplication>
#include <QStandardPaths>
#include <QUrl>

#include "views/number_text.h"
#include "wizard/devices/on_measurement.h"

namespace relucent::gui {
OutputPage::OutputPage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent),
      proof_(session, stepName),
      perfecting_(session, stepName),
      config_(QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation)) {
  open_ = addCommand(Icon::play, [this] { open(); });
  install_ = addCommand(Icon::power, [this] { install(); });
  freeze_ = addCommand(Icon::pause, [this] { setFrozen(!isFrozen()); }, QKeySequence("Ctrl+P"));
  black_ = addCommand(Icon::black, [this] { setBlack(!isBlack()); }, QKeySequence("Ctrl+B"));
  close_ = addCommand(Icon::stop, [this] { close(); });
  prove_ = addCommand(Icon::camera, [this] { verify(); });
  checkDrift_ = addCommand(Icon::drift, [this] { checkDrift(); });
  repair_ = addCommand(Icon::retry, [this] { repair(); });
  pushBack_ = addCommand(Icon::camera, [this] { pushBack(); });
  measureAgain_ = addCommand(Icon::retry, [this] { Q_EMIT stepWanted("acquire"); });
  removeShow_ = addCommand(Icon::remove, [this] { removeInstalled(); });
  keepShow_ = addCommand(Icon::power, [] {});
  undoRepair_ = addCommand(Icon::back, [this] { undoRepair(); });
  keepRepair_ = addCommand(Icon::tick, [this] { undoing_.reset(); });
  aimAgain_ = addCommand(Icon::camera, [this] { Q_EMIT stepWanted("camera"); });
  goOnMeasuring_ = addCommand(Icon::play, [this] { Q_EMIT stepWanted("acquire"); });
  endChart_ = addCommand(Icon::play, [this] { projection_.endChart(); });
  hideFigures_ = addCommand(Icon::pulse, [this] { projection_.setOverlay(false); });
  stop_ = addCommand(Icon::stop, [this] {
    proof_.cancel();
    perfecting_.cancel();
  });
  renew_ = addCommand(Icon::play, [this] { renew(); });
  review_ = addCommand(Icon::next, [this] { Q_EMIT stepWanted(stepToReview()); });
  connect(&session_, &Session::opened, this, [this] {
    close();
    projection_.mirrorProjector(projector());
    wished_.clear();
    reportFile_.clear();
    overruled_.reset();
    nightAt_ = {};
    listScreens();
    detectInstalledShow();
    preferred_ = QString::fromStdString(session_.settings().content.picture);
    playlist_.open(session_.isOpen() ? QString::fromStdString(session_.path().string()) : QString(),
                   preferred_);
  });
  connect(&session_, &Session::devicesChanged, this, &OutputPage::tellResult);
  connect(&session_, &Session::stepsChanged, this, [this] {
    followScreen();
    QString picture = QString::fromStdString(session_.settings().content.picture);
    if (session_.isOpen() && std::exchange(preferred_, picture) != picture) {
      const PlaylistSettings before = playlist_.settings();
      playlist_.prefer(picture);
      // What plays is counted by its place in the list.
      if (isOpen() && !(playlist_.settings().items == before.items))
        projection_.setList(playlist_.settings());
    }
    if (chosen_.size() != projectors()) listScreens();
    tellAll();
  });
  connect(&playlist_, &OutputPlaylist::unreadable, this, [this](const QString& sentence) {
    tell({ErrorKind::format, sentence, tr("Make the list again."), sentence});
  });
  connect(&playlist_, &OutputPlaylist::changed, this, [this] {
    lookAtPicture();
    tellSettings();
  });
  connect(&proof_, &OutputProof::changed, this, &OutputPage::tellResult);
  connect(&proof_, &OutputProof::progressed, this, &OutputPage::tellProgress);
  connect(&proof_, &OutputProof::ended, this,
          [this](OutputProof::Work work) { work == OutputProof::Work::repair ? repairEnded() : reopen(); });
  connect(&proof_, &OutputProof::failed, this, &OutputPage::tell);
  connect(&proof_, &OutputProof::reported, this, [this](const QString& file) {
    reportFile_ = file;
    // It is what was asked for, whether or not a browser is there.
    isReportShown_ = QDesktopServices::openUrl(QUrl::fromLocalFile(file));
    tellResult();
  });
  connect(&perfecting_, &Perfecting::changed, this, &OutputPage::tellResult);
  connect(&perfecting_, &Perfecting::progressed, this, &OutputPage::tellProgress);
  connect(&perfecting_, &Perfecting::ended, this, &OutputPage::perfectingEnded);
  connect(&perfecting_, &Perfecting::failed, this, &OutputPage::tell);
  connect(&projection_, &OutputProjection::progressed, this, &OutputPage::lookAtPicture);
  connect(&projection_, &OutputProjection::progressed, this, &OutputPage::tellProgress);
  connect(&projection_, &OutputProjection::changed, this, [this] {
    session_.setShowing(isOpen() || reopening_);
    if (isOpen() != second_.isActive()) isOpen() ? second_.start() : second_.stop();
    lookAtPicture();
    tellProgress();
    tellResult();
  });
  connect(&projection_, &OutputProjection::failed, this, &OutputPage::tell);
  connect(&projection_, &OutputProjection::setRefused, this, [this] {
    playsFrom_.clear();  // another one than is in use
    tellAll();
  });
  second_.setInterval(1000);
  connect(&second_, &QTimer::timeout, this, &OutputPage::followTimes);
  connect(qApp, &QGuiApplication::screenAdded, this, &OutputPage::listScreens);
  connect(qApp, &QGuiApplication::screenRemoved, this, &OutputPage::listScreens);
  listScreens();
}

OutputPage::~OutputPage() {
  finish();
}

void OutputPage::finish() {
  reopening_.reset();
  proof_.cancel();
  perfecting_.cancel();
  close();
}

void OutputPage::enter() {
  isLookedAt_ = true;
  listScreens();
  lookAtPicture();
  detectInstalledShow();
}

StepStatus OutputPage::status() const {
  if (isScreenLost()) return {StepState::busy, tr("Screen unplugged"), false, true};
  if (const QString work = photographicWork(); !work.isEmpty()) return {StepState::busy, work};
  if (isCovered()) return {StepState::busy, tr("Covered by %1").arg(session_.devicesUserName())};
  if (isContested()) return {StepState::busy, tr("Two shows at once"), false, true};
  if (isBlack()) return {StepState::busy, tr("Black"), false, playsEarlier() || isDoubted()};
  if (playsEarlier()) return {StepState::busy, tr("Another correction"), false, true};
  if (isOpen() && isDoubted()) return {StepState::busy, tr("Not as predicted"), false, true};
  if (isOpen())
    return {StepState::busy, showsChart() ? tr("Test chart") : isFrozen() ? tr("Frozen") : tr("Playing")};
  if (session_.isShownElsewhere()) return {StepState::busy, tr("Another program plays")};
  if (isDoubted()) return {StepState::doubtful, tr("Not as predicted")};
  if (proof_.isOutOfDate()) return {StepState::outOfDate, tr("Proof out of date")};
  if (isInstalled()) return {StepState::done, tr("Show installed")};
  return {};
}

/// Two windows are on the projectors, of which the desktop shows one.
bool OutputPage::isContested() const {
  return isOpen() && session_.isShownElsewhere() && !isOnPageOnly();
}

/// What is done by photographs now, for the rail; empty: nothing.
QString OutputPage::photographicWork() const {
  if (perfecting_.isRunning()) return tr("Perfecting");
  switch (proof_.work()) {
    case OutputProof::Work::photograph:
      return tr("Photographing");
    case OutputProof::Work::drift:
      return tr("Checking for drift");
    case OutputProof::Work::repair:
      return tr("Repairing");
    case OutputProof::Work::none:
    case OutputProof::Work::report:
      break;
  }
  return {};
}

QString OutputPage::whatIsProjected() const {
  if (perfecting_.isRunning() || proof_.work() == OutputProof::Work::photograph)
    return tr("The output is closed. A picture to be photographed is projected.");
  if (!photographicWork().isEmpty())
    return tr("The output is closed. Patterns to be photographed are projected.");
  if (session_.isProjecting())
    return tr("The output is closed. The devices are in use at %1.").arg(session_.devicesUserName());
  if (session_.isAnotherVenueShown())
    return tr("The output is closed here. Another program plays a show of another venue on this projector.");
  if (session_.isShownElsewhere())
    return tr("The output is closed here. Another program plays a show of this venue.");
  return tr("The output is closed. Nothing is projected from here.");
}

bool OutputPage::isCovered() const {
  return isOpen() && session_.screenRig() != nullptr && session_.isProjecting() &&
         photographicWork().isEmpty();
}

QString OutputPage::hint() const {
  if (projection_.isOpening()) return projection_.stage();
  if (proof_.work() != OutputProof::Work::none) {
    const QString stage = proof_.stage();
    return stage.isEmpty() ? photographicWork() : stage;
  }
  if (perfecting_.isRunning()) return perfecting_.stage();
  if (isCovered() || (!isOpen() && !session_.areDevicesFree()))
    return tr("The devices are in use at %1.").arg(session_.devicesUserName());
  if (playlist_.isEmpty()) return tr("Add a picture or a film to the playlist.");
  if (isScreenLost()) return tr("Waiting for the projector's screen to come back.");
  if (auto missing = projectorWithoutScreen()) return screenHint(*missing);
  if (isContested())
    return tr("The output is open here and in another program: whose picture is seen is not known. End one.");
  const auto evenIfBlack = [this](const QString& hint) {
    return isBlack() ? tr("Black. %1").arg(hint) : hint;
  };
  if (playsEarlier())
    return evenIfBlack(tr("What plays is not what was measured or chosen last. Show that first."));
  if (isOpen()) {
    const OutputProof::Next next = proof_.next();
    if (next == OutputProof::Next::install) return playingHint();
    if (next != OutputProof::Next::photograph)
      // Installed all the same: what was found of it stands.
      return evenIfBlack(isInstalled() ? tr("Installed as it is. %1").arg(doubtedHint()) : doubtedHint());
    if (isBlack() || isFrozen() || showsChart() || (isInstalled() && !proof_.isUnsettled()))
      return playingHint();
    if (!isInstallable())
      return tr("Take a verification photograph: it proves that the venue is measured well.");
    return isJudged() ? tr("Take a verification photograph. What was found before is not settled.")
                      : tr("Take a verification photograph, or install without proof.");
  }
  if (session_.isAnotherVenueShown())
    return tr("Another program plays a show of another venue on this projector.");
  if (session_.isShownElsewhere()) return tr("Another program plays a show of this venue.");
  if (isNothingToldApart(session_))
    return tr("What was measured is too coarse to place content. Go on measuring.");
  if (isDoubted())
    return tr("The surface did not look as predicted. Open the output: it leads to what helps.");
  if (isOnPageOnly()) return tr("This rehearsal plays on this page only: nothing is projected.");
  if (coversOperator()) return tr("The output will cover this window. Esc closes the output.");
  return tr("Nothing is projected before you open the output.");
}

/// Of what is shown and does not look as it should: what helps.
QString OutputPage::doubtedHint() const {
  switch (proof_.next()) {
    case OutputProof::Next::photograph:
    case OutputProof::Next::install:
      break;
    case OutputProof::Next::checkDrift:
      return needsConsent() ? tr("Confirm that the room is clear: the patterns flash.")
                            : tr("The surface does not look as predicted. Find out whether something moved.");
    case OutputProof::Next::pushBack:
      return tr("The camera's view has moved. Put it back, then photograph again.");
    case OutputProof::Next::repair:
      return needsConsent() ? tr("Confirm that the room is clear: the patterns flash.")
                            : tr("Something has changed since it was measured. Repair the calibration: "
                                 "only that is measured again.");
    case OutputProof::Next::measureAgain:
      return tr("Something has changed since it was measured. Measure again, then install.");
    case OutputProof::Next::aimAgain:
      return proof_.isBeyondRepair()
                 ? tr("Hardly anything fits. Put the camera back, or aim and measure again.")
                 : tr("Hardly anything fits. Put the camera back, repair the calibration, or aim and "
                      "measure again.");
  }
  return {};
}

/// What was found of it last asks for more than a photograph.
bool OutputPage::isDoubted() const {
  const OutputProof::Next next = proof_.next();
  return proof_.isUnsettled() ||
         (next != OutputProof::Next::install && next != OutputProof::Next::photograph);
}

/// Something was found of what is shown now.
bool OutputPage::isJudged() const {
  return (proof_.proof() && !proof_.isOutOfDate()) || proof_.drift();
}

/// While nothing stands against the show: what it does, in one voice with the rail.
QString OutputPage::playingHint() const {
  if (isBlack() && isFrozen() && !showsChart())
    return tr("Black: the frozen picture stands unseen until you show it again.");
  if (isBlack() && showsChart())
    return tr("Black: the test chart stands unseen. T shows the next one, then the playlist.");
  if (isBlack()) return tr("Black: the show goes on unseen until you show it again.");
  if (showsChart()) return tr("A test chart is on the surface. T shows the next one, then the playlist.");
  if (isFrozen()) return tr("Frozen: this picture stands until you press Play.");
  if (!isInstallable())
    return tr("Rehearsed to the end. A simulated venue is not installed. Hold A to compare.");
  // Installed again it says when, and is heard.
  return isInstalled() ? tr("Installed at %1: the show starts at the next log-in. Hold A to compare.")
                             .arg(QLocale().toString(installedAt_.time(), QLocale::ShortFormat))
                       : tr("Playing. Hold A to compare.");
}

void OutputPage::updateCommands() {
  DevicePage::updateCommands();
  open_->show(tr("Open output"), !projectorWithoutScreen() && !playlist_.isEmpty() &&
                                     !projection_.isOpening() && session_.areDevicesFree() &&
                                     !isNothingToldApart(session_));
  const bool isProved = proof_.next() == OutputProof::Next::install;
  install_->show(isInstalled() ? tr("Install again")
                 : isProved    ? tr("Install show")
                 : isJudged()  ? tr("Install anyway")
                               : tr("Install without proof"),
                 isInstallable() && !playlist_.isEmpty());
  renew_->show(tr("Show the current correction"),
               session_.areDevicesFree() && !projectorWithoutScreen() && !isNothingToldApart(session_));
  review_->show(tr("Look at it first"));
  endChart_->show(tr("Show the playlist"));
  hideFigures_->show(tr("Hide the figures"));
  prove_->showUnless(whyNotProve(), tr("Take verification photograph"));
  checkDrift_->showUnless(whyNoPatterns(), tr("Check for drift"));
  repair_->showUnless(whyNoPatterns(), tr("Repair the calibration"));
  pushBack_->showUnless(whyNoPhotograph(), tr("Put the camera back"));
  measureAgain_->show(tr("Measure again"));
  aimAgain_->show(tr("Aim again"));
  goOnMeasuring_->show(toAcquireText(session_));
  freeze_->setGlyph(isFrozen() ? Icon::play : Icon::pause);
  freeze_->show(isFrozen() ? tr("Play") : tr("Freeze"));
  black_->show(isBlack() ? tr("Show again") : tr("Black"));
  close_->show(tr("Close output"));
  stop_->show(tr("Stop"));
}

PageCommand* OutputPage::primary() const {
  // Beside another program's show it is possible, and not what is to be done next.
  if (!isOpen() && isNothingToldApart(session_)) return goOnMeasuring_;
  if (!isOpen()) return session_.isShownElsewhere() ? nullptr : open_;
  if (playsEarlier()) return renew_;
  switch (proof_.next()) {
    case OutputProof::Next::photograph:
      return prove_;
    case OutputProof::Next::checkDrift:
      return checkDrift_;
    case OutputProof::Next::pushBack:
    case OutputProof::Next::aimAgain:
      return pushBack_;
    case OutputProof::Next::repair:
      return repair_;
    case OutputProof::Next::measureAgain:
      return measureAgain_;
    case OutputProof::Next::install:
      break;
  }
  // Once it is installed there is nothing left to do; again is for those who look for it.
  return isInstalled() ? nullptr : install_;
}

/// What comes and goes stands first, so that the others keep their places.
std::vector<PageCommand*> OutputPage::secondary() const {
  if (!photographicWork().isEmpty()) return {stop_};
  if (!isOpen()) return session_.isShownElsewhere() ? std::vector{open_} : std::vector<PageCommand*>();
  std::vector<PageCommand*> commands;
  // What nobody has seen on the projectors is not installed from here.
  if (isInstallable() && !playsEarlier() && primary() != install_) commands.push_back(install_);
  const bool isAimedAgain = proof_.next() == OutputProof::Next::aimAgain && !playsEarlier();
  commands.push_back(isAimedAgain ? aimAgain_ : freeze_);
  commands.insert(commands.end(), {black_, close_});
  return commands;
}

bool OutputPage::needsConsent() const {
  const OutputProof::Next next = proof_.next();
  return isOpen() && (next == OutputProof::Next::checkDrift || next == OutputProof::Next::repair) &&
         !proof_.mayFlash();
}

std::optional<Banner> OutputPage::banner() const {
  if (isScreenLost())
    return Banner{Banner::Kind::amber, tr("The projector's screen is unplugged"),
                  tr("Nothing is lost. Plug it in again: the show comes back by itself.")};
  if (auto beside = besideAnotherShow()) return beside;
  if (isCovered())
    return Banner{Banner::Kind::information,
                  tr("The projector shows the light of another step: %1").arg(session_.devicesUserName()),
                  tr("The show goes on behind it, and is seen again when that has ended.")};
  if (playsEarlier()) {
    const bool isReviewed = stepToReview().isEmpty();
    return Banner{Banner::Kind::amber, tr("The show still plays another correction"),
                  isReviewed ? tr("What was measured or chosen since is not on the projector yet.")
                             : tr("What was measured or chosen since is not on the projector yet. Steps that "
                                  "are out of date count with what was chosen there before."),
                  isReviewed ? nullptr : review_};
  }
  if (isOpen() && showsChart() && !isBlack())
    return Banner{Banner::Kind::information, tr("A test chart is on the surface"),
                  isFrozen() ? tr("The frozen picture stands unseen until you show it again.")
                             : tr("The playlist runs on unseen until you show it again."),
                  endChart_};
  if (projection_.hasOverlay() && !isBlack())
    return Banner{Banner::Kind::information, tr("Figures are on the surface"),
                  tr("Whoever is in the room reads them over the picture."), hideFigures_};
  if (const auto stopped = onMeasurement(session_, goOnMeasuring_)) return stopped;
  if (proof_.isOutOfDate())
    return Banner{
        isOpen() ? Banner::Kind::information : Banner::Kind::amber,
        tr("The verification photograph is out of date"),
        tr("What it was taken of has been measured or chosen anew since, or is another set. Take it "
           "again to prove what "
           "is shown now.")};
  if (isOpen() && !stepToReview().isEmpty())
    return Banner{Banner::Kind::information, tr("Not all was decided on what is measured now"),
                  tr("Steps that are out of date count with what was chosen there before."), review_};
  return std::nullopt;
}

/// The first one whose decision was made on something else; empty: none.
QString OutputPage::stepToReview() const {
  using calibration::Stage;
  for (const auto& [stage, step] : {std::pair(Stage::threshold, "threshold"),
                                    {Stage::clustering, "cluster"},
                                    {Stage::content, "preview"}})
    if (session_.progress(stage) == calibration::StageProgress::stale &&
        !(stage == Stage::clustering && areClustersFollowed(session_)))
      return step;
  return {};
}

std::optional<double> OutputPage::progress() const {
  if (projection_.isOpening()) return projection_.fraction();
  if (perfecting_.isRunning()) return perfecting_.fraction();
  return proof_.work() != OutputProof::Work::none ? std::optional(proof_.fraction()) : std::nullopt;
}

double OutputPage::lightKept() const {
  const auto& threshold = session_.figures<calibration::Stage::threshold>();
  return threshold ? threshold->energyKept : 1.0;
}

void OutputPage::tell(const Failure& failure) {
  Q_EMIT failed({failure, tr("The calibration is as it was.")});
}

}  // namespace relucent::gui
