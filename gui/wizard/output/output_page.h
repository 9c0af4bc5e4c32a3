// SPDX-License-Identifier: MIT
#pragma once

#include <QTimer>

#include "output/output_playlist.h"
#include "output/output_projection.h"
#include "wizard/devices/device_page.h"
#include "wizard/devices/nudge.h"
#include "wizard/devices/perfecting.h"
#include "wizard/output/output_proof.h"
#include "wizard/session/results_beside.h"

namespace relucent::gui {

/// A screen that the output can shine on; for a rehearsal, whose projector is simulated, also none: this page
/// alone shows what it would project.
struct OutputScreen {
  ScreenIdentity identity{};
  QSize size{};            // in its own pixels
  bool operators = false;  // the one with this window
  double framesPerSecond = 0.0;
  bool isPageOnly = false;
};

/// Step 8: the content on the projector, corrected in real time; proved; handed over.
class OutputPage : public DevicePage {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"output", "relucent::gui::OutputPage",
                                     QT_TRANSLATE_NOOP("relucent::gui::OutputPage", "Output")};

  explicit OutputPage(Session& session, QObject* parent = nullptr);
  ~OutputPage() override;

  QString subtitle() const override {
    return tr("Play corrected content, prove that it works with one photograph, and hand the venue over.");
  }
  StepStatus status() const override;
  QString hint() const override;
  bool hasRemedy() const override { return projectorWithoutScreen().has_value() || needsConsent(); }
  PageCommand* primary() const override;
  std::optional<Banner> banner() const override;
  std::vector<PageCommand*> secondary() const override;
  std::optional<double> progress() const override;
  void enter() override;
  void leave() override { isLookedAt_ = false; }
  void finish() override;

  const std::vector<OutputScreen>& screens() const { return screens_; }
  /// The shown projector's screen.
  std::optional<std::size_t> chosen() const { return screenOf(projector()); }
  /// Another projector that had that screen gets this one's in return. Of a calibration whose projector is a
  /// screen, another of its pixels becomes that projector's.
  void choose(std::size_t index);
  std::optional<std::size_t> screenOf(std::size_t projector) const {
    return projector < chosen_.size() ? chosen_[projector] : std::nullopt;
  }
  /// Of the screens that are the projectors.
  QStringList connectors() const;
  /// The one that was chosen for the shown projector and is not there now; empty: it is, or none was chosen.
  QString missingScreen() const;
  /// A step's light stands on the projectors' screens before what plays.
  bool isCovered() const;
  /// How what plays is doing, where it is live; none: it is not.
  std::optional<LiveState> livePlaying() const;
  /// How what is projected goes, in a line; empty: nothing of it is seen.
  QString figures() const;
  /// What stands on the projectors while the output is closed, a sentence.
  QString whatIsProjected() const;
  /// What it means for what is measured that the projector is another screen now; empty: nothing.
  QString meaningOfScreen() const;

  const OutputPlaylist& playlist() const { return playlist_; }
  void addFiles(const QStringList& files);
  void removeItem(qsizetype index);
  void moveItem(qsizetype index, qsizetype by);
  void setRepeat(bool repeat);
  void setFade(double seconds);
  /// How long a picture of the list stands; of anything else nothing changes.
  void setPictureSeconds(qsizetype index, double seconds);

  /// The calibration's set in use, which plays. What plays goes on as it is until another one is prepared.
  const pipeline::TargetSets& sets() const { return session_.sets(); }
  void useSet(const std::string& name);
  /// A night has passed in another program: what it has perfected is looked for.
  void nightHasPassed() { perfecting_.lookAgain(); }
  /// Why no other one can be chosen now; empty: it can.
  QString whyNoSets() const;
  /// When the show changes sets: the installed one, and this one while it plays and the page is looked at, so
  /// that nothing changes under the hands of whoever works at Preview. What is chosen by hand stays until the
  /// next of these times.
  void setTimes(const QList<SetTime>& times);
  /// Looks what they say now; each second while it plays.
  void followTimes();
  /// Of the day; tests have their own.
  void setClock(std::function<QTime()> now) { now_ = std::move(now); }

  bool isOpen() const { return projection_.isOpen(); }
  /// It is open, and a projector's screen is unplugged.
  bool isScreenLost() const { return isOpen() && projectorWithoutScreen().has_value(); }
  bool isBlack() const { return projection_.isBlack(); }
  bool isFrozen() const { return projection_.isFrozen(); }
  /// A test chart is on the projectors in place of the playlist.
  bool showsChart() const { return projection_.showsChart(); }
  bool isCompensated() const { return projection_.isCompensated(); }
  void setBlack(bool black) { projection_.setBlack(black); }
  void setFrozen(bool frozen) { projection_.setFrozen(frozen); }
  void setCompensated(bool compensated) { projection_.setCompensated(compensated); }
  /// What plays, and how it goes.
  OutputProjection& projection() { return projection_; }
  const OutputProjection& projection() const { return projection_; }
  /// Of the shown projector.
  Size projectorSize() const { return session_.projectorSize(projector()); }
  /// Not the one for films: how pictures that stand are solved. Empty: like films.
  QString stillMethod() const;

  void open() { openWith({}); }
  void close();
  /// What is measured or chosen has become newer than what the output was opened with and goes on playing.
  bool playsEarlier() const { return isOpen() && playsFrom_ != session_.shownFrom(); }
  /// Another program plays on the same projectors while the output is open.
  bool isContested() const;
  /// Opens the output again, with what is newest.
  void renew();

  const OutputProof& proof() const { return proof_; }
  /// Why nothing is photographed now, a short sentence; empty: it can be.
  QString whyNoPhotograph() const;
  /// Why the picture is not proved nor perfected now: only what is on the projectors is.
  QString whyNotProve() const;
  bool mayProve() const { return whyNotProve().isEmpty(); }
  /// Why no patterns are photographed now.
  QString whyNoPatterns() const;
  /// Projects the picture that plays and photographs it. Real devices have the output closed meanwhile.
  void verify();
  /// Corrects the picture that plays by photographs of itself; as verify().
  void perfect();
  Perfecting& perfecting() { return perfecting_; }
  void checkDrift() {
    whileClosed([this] { proof_.checkDrift(); });
  }
  /// Makes the calibration fit what the venue has become. Real devices have the output closed meanwhile.
  void repair();
  /// The measurement from before the repair is used again, and shown: not without a question, as there is no
  /// way back but repairing once more.
  void askToUndoRepair();
  /// Shows full light and looks, until pushedBack(): nudgeWanted() asks for what shows that.
  void pushBack();
  /// What the devices were looked at with is gone. `last`: seen before that; none: nothing was.
  /// `wasElsewhere`: it was seen to look elsewhere, too.
  void pushedBack(const std::optional<NudgeSight>& last, bool wasElsewhere);
  /// Writes the report and lets the desktop show it.
  void report();
  /// Where it is; empty: not written since the calibration was opened.
  const QString& reportFile() const { return reportFile_; }
  /// False: no program here opens it.
  bool isReportShown() const { return isReportShown_; }

  /// The show that starts at log-in: of a user there is one.
  enum class InstalledShow { none, thisVenues, anotherVenues };
  InstalledShow installedShow() const { return installed_; }
  /// Share of the measured light that Threshold left.
  double lightKept() const;
  bool isInstalled() const { return installed_ == InstalledShow::thisVenues; }
  /// Devices that are simulated play for nobody: a rehearsal's show is not installed.
  bool isInstallable() const { return !session_.isSimulated(); }
  /// Keeps the playlist and makes the show start at log-in, in place of one that did.
  void install();
  /// When the installed show looks after the picture every night, see show_nights.h; not valid: never.
  QTime nightAt() const { return nightAt_; }
  /// Of an installed show at once.
  void setNightAt(QTime time);
  /// Whichever starts at log-in does so no more.
  /// Asks first: it may be another venue's, and that of tonight.
  void askToRemoveInstalled();
  void removeInstalled();
  /// Of the user; tests have their own.
  void setConfigFolder(const QString& folder);

 Q_SIGNALS:
  void nudgeWanted();

 protected:
  void updateCommands() override;

 private:
  bool needsConsent() const;
  void listScreens();
  void detectInstalledShow();
  std::optional<std::size_t> projectorWithoutScreen() const;
  bool coversOperator() const;
  bool isOnPageOnly() const;
  QString playingHint() const;
  QString doubtedHint() const;
  QString photographicWork() const;
  QString screenHint(std::size_t projector) const;
  QString missingScreenOf(std::size_t projector) const;
  QString stepToReview() const;
  std::optional<std::size_t> usualScreen(std::size_t projector) const;
  void changeSet(const std::string& name);
  void keepScreen();
  void followScreen();
  void projectorChanged() override { projection_.mirrorProjector(projector()); }
  void edit(const QString& what, const PlaylistSettings& after);
  void setPlaylist(const PlaylistSettings& settings);
  void whileClosed(const std::function<void()>& work);
  void openWith(const OutputProjection::Wanted::Beginning& beginning);
  void closeForNow();
  void reopen();
  void repairEnded();
  bool isJudged() const;
  bool isDoubted() const;
  void undoRepair();
  void lookAtPicture();
  Canvas canvasOfPicture() const;
  void perfectingEnded(bool isOther);
  QString pictureToProve() const;
  QStringList showArguments() const;
  void tell(const Failure& failure);

  PageCommand *open_, *install_, *freeze_, *black_, *close_;
  PageCommand *prove_, *checkDrift_, *repair_, *pushBack_, *measureAgain_, *removeShow_, *keepShow_,
      *aimAgain_;  // what comes before installing
  PageCommand *undoRepair_, *keepRepair_;
  std::unique_ptr<QObject> undoing_;  // while that is asked
  PageCommand *renew_, *endChart_, *hideFigures_, *stop_;
  PageCommand *goOnMeasuring_, *review_;  // of the banner
  OutputPlaylist playlist_;
  OutputProof proof_;
  Perfecting perfecting_;
  std::unique_ptr<ResultsBeside> earlier_;  // what plays while it is measured again
  OutputProjection projection_;
  std::vector<OutputScreen> screens_;
  // A projector's. What was chosen stays chosen while it is unplugged.
  std::vector<std::optional<OutputScreen>> wished_;
  std::vector<std::optional<std::size_t>> chosen_;                // where that is among screens_
  std::string playsFrom_;                                         // what the output was opened with
  std::vector<ScreenIdentity> screensBefore_;                     // the calibration's
  std::optional<OutputProjection::Wanted::Beginning> reopening_;  // when the photographs are taken
  QString preferred_;                                             // Preview's picture
  QString config_;
  InstalledShow installed_ = InstalledShow::none;
  QDateTime installedAt_;  // this venue's
  QTime nightAt_;
  QString reportFile_;
  bool isReportShown_ = false;
  bool isLookedAt_ = false;
  std::function<QTime()> now_ = [] { return QTime::currentTime(); };
  QTimer second_;                     // each, while it plays
  std::optional<QString> overruled_;  // the set of the times that another one was chosen in place of
};

}  // namespace relucent::gui
