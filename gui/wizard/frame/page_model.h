// SPDX-License-Identifier: MIT
#pragma once

#include <QKeySequence>
#include <QObject>
#include <QPointer>
#include <QUndoStack>
#include <optional>
#include <vector>

#include "jobs/failure.h"
#include "wizard/frame/command.h"
#include "wizard/frame/undoable.h"
#include "wizard/session/step_name.h"

namespace relucent::gui {

/// Where a step stands, as the rail shows it. Whether it can be opened at all follows from the steps before.
enum class StepState {
  open,
  busy,
  outOfDate,
  coarse,    // done, on a measurement that was stopped early
  doubtful,  // done, on a measurement by which nothing would be corrected
  done,
  failed
};

struct StepStatus {
  StepState state = StepState::open;
  QString result;          // one short line
  bool hasResult = false;  // while it is busy: an earlier result is used until the new one is ready
  bool isHeldUp = false;   // while it is busy: something is missing that it waits for
};
/// Later steps can use what this one came to.
inline bool isUsable(const StepStatus& status) {
  return status.state == StepState::done || status.state == StepState::coarse ||
         status.state == StepState::doubtful || status.state == StepState::outOfDate ||
         (status.state == StepState::busy && status.hasResult);
}

/// What stands above the stage. At most one.
struct Banner {
  enum class Kind { information, amber };
  Kind kind = Kind::information;
  QString sentence, more;
  PageCommand* command = nullptr;  // the page's, never its primary; nullptr: there is nothing to do here
};

/// A failure as the user is told of it: what happened, what is safe, what to do. Or what an answer would end.
struct FailureReport {
  Failure failure;
  QString safe;
  PageCommand *resume = nullptr, *keep = nullptr, *goOn = nullptr;  // the page's; nullptr: not to be chosen
  bool isQuestion = false;                                          // nothing has happened yet
  PageCommand* repair = nullptr;  // helps to put right what happened; nullptr: nothing here does
  bool isPutRight = false;        // what happened is over, and only the answer is missing
  /// Where it goes, nobody has to be told or asked any more; nullptr: that does not happen.
  QPointer<QObject> reason{};
  bool endsWork = false;  // a question: what happens is that work ends
};

/// A page without widgets: all that it knows and can do. The frame (rail, action bar, banner) asks for the
/// parts below; the page's own view knows the class itself. What has changed is told by the narrowest
/// signals.
class PageModel : public QObject {
  Q_OBJECT

 public:
  explicit PageModel(const StepName& step, QObject* parent = nullptr) : QObject(parent), step_(step) {}

  const StepName& step() const { return step_; }
  QString name() const { return step_.text(); }  // in the rail
  virtual QString title() const { return name(); }
  virtual QString subtitle() const = 0;  // what this step is for
  virtual StepStatus status() const = 0;
  /// Beside the buttons: the time, or why the primary command is not possible. Why another one is not
  /// (PageCommand::whyNot()) the action bar adds to it.
  virtual QString hint() const { return {}; }
  /// What the hint says can be changed on this page: remedyWanted() asks where.
  virtual bool hasRemedy() const { return false; }
  /// Why nothing can be decided here now; empty: it can.
  virtual QString whyLocked() const { return {}; }
  /// The command that leads on; nullptr: there is none now.
  virtual PageCommand* primary() const = 0;
  virtual std::vector<PageCommand*> secondary() const { return {}; }
  /// Of a measurement under way, 0 to 1.
  virtual std::optional<double> progress() const { return std::nullopt; }
  virtual std::optional<Banner> banner() const { return std::nullopt; }
  /// What ends the wait for a device that is lost with what there is; nullptr: nothing does.
  virtual PageCommand* insteadOfWaiting() const { return nullptr; }
  /// False: the stage has the whole width now.
  virtual bool usesInspector() const { return true; }
  /// Its work was interrupted when the venue was open last: opened again, the wizard begins here.
  virtual bool wasInterrupted() const { return false; }
  /// The page is looked at, or no longer.
  virtual void enter() {}
  virtual void leave() {}
  /// What is decided here differs from what the steps after this one follow: it counts once it is kept, by
  /// the primary command or by going on to another page.
  virtual bool isChanged() const { return false; }
  /// Somebody goes on to another page: what is changed counts there, at once, or as soon as it can be kept.
  void keepChanges() {
    keeps_ = isChanged();
    keepWherePossible();
  }
  /// Somebody is here again, or another calibration is open: nothing is kept by the way any more.
  void stopKeeping() { keeps_ = false; }
  /// Back within the page; false if there is nothing to go back to.
  virtual bool goBack() { return false; }
  virtual bool canGoBack() const { return false; }
  /// Ends what goes on in the background, keeping what is measured.
  virtual void finish() {}
  /// What the user changed on this page. Emptied when another calibration is opened.
  QUndoStack& undoStack() { return undo_; }
  /// Looks again at what no signal tells: the language, the free space of a disk, a folder.
  void refresh() { tellStatus(); }

 Q_SIGNALS:
  /// Title, status, hint, commands or banner: what the frame shows.
  void statusChanged();
  /// What is decided here, or which of several devices are shown.
  void settingsChanged();
  /// What was measured or computed, or whether it is being measured.
  void resultChanged();
  /// How far work is, and what its devices show and see.
  void progressChanged();
  /// The user asks where that can be changed which stands against going on: the view knows the place.
  void remedyWanted();
  /// The step is done: the next one, please.
  void nextWanted();
  /// Where the open calibration stands, please.
  void standingWanted();
  /// That step, please: by its id.
  void stepWanted(const QString& id);
  void failed(const gui::FailureReport& report);

 protected:
  /// A command of this page; text and all that changes come from updateCommands().
  template <typename Run>
  PageCommand* addCommand(Icon icon, Run run, const QKeySequence& shortcut = {}) {
    auto* command = new PageCommand(icon, this);
    command->setShortcut(shortcut);
    connect(command, &QAction::triggered, this, run);
    return command;
  }
  /// Shows the commands as things are now. Called before the frame is told; the constructor calls it last.
  virtual void updateCommands() {}

  void tellStatus() {
    updateCommands();
    if (PageCommand* command = primary()) command->setToolTip(command->isEnabled() ? QString() : hint());
    Q_EMIT statusChanged();
    // Not within what told: keeping changes the calibration, which others are about to look at.
    if (keeps_) QMetaObject::invokeMethod(this, &PageModel::keepWherePossible, Qt::QueuedConnection);
  }
  /// What is changed can be kept now.
  virtual bool mayKeep() const { return primary() != nullptr && primary()->isEnabled(); }
  /// Keeps it, as the primary command does, without going on. What fails is told by failed().
  virtual void keepChange() {}
  /// These change what the frame shows as well.
  void tellSettings() {
    Q_EMIT settingsChanged();
    tellStatus();
  }
  void tellResult() {
    Q_EMIT resultChanged();
    tellStatus();
  }
  void tellProgress() {
    updateCommands();
    Q_EMIT progressChanged();
  }
  void tellAll() {
    Q_EMIT settingsChanged();
    tellResult();
  }

  /// Makes a change that can be taken back: apply(after) now, apply(before) when it is undone. `name`: what
  /// was changed; changes of one name in quick succession are one.
  template <typename Value, typename Apply>
  void changeUndoably(const QString& name, Value before, Value after, Apply apply) {
    undo_.push(new Undoable<Value>(name, std::move(before), std::move(after), std::move(apply)));
  }

 private:
  void keepWherePossible() {
    if (!keeps_ || !isChanged() || !mayKeep()) return;
    keeps_ = false;
    keepChange();
  }

  StepName step_;
  QUndoStack undo_;
  bool keeps_ = false;  // what was changed when the page was left and could not be kept then
};

}  // namespace relucent::gui

Q_DECLARE_METATYPE(relucent::gui::FailureReport)
