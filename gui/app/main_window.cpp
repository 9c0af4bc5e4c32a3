// SPDX-License-Identifier: MIT
#include "app/main_window.h"

#include <QAbstractButton>
#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QKeyEvent>
#include <QMimeData>
#include <QShortcut>

#include "app/help_window.h"
#include "app/settings_dialog.h"
#include "relucent/calibration/calibration_folder.h"
#include "theme/quiet_wheel.h"
#include "theme/theme.h"
#include "wizard/frame/ending_dialog.h"
#include "wizard/frame/failure_dialog.h"
#include "wizard/frame/stage_scroll.h"

namespace relucent::gui {
namespace {

/// Half a Full HD screen, on a desktop that scales by two, with what it puts round a window.
constexpr QSize leastSize(940, 440);  // half of Full HD, less what a desktop takes
constexpr int narrowBelow = 1100, lowBelow = 640, narrowRail = 64, lowHeader = 48;

/// The one folder or calibration's file that is dragged; empty: neither.
QString calibrationIn(const QMimeData& data) {
  if (data.urls().size() != 1) return {};
  QFileInfo file(data.urls().first().toLocalFile());
  return file.isDir() || file.fileName() == calibration::CalibrationFolder::manifestName ? file.filePath()
                                                                                         : QString();
}

}  // namespace

MainWindow::MainWindow(Session& session, Wizard& wizard, Preferences& preferences, const Language& language,
                       std::vector<PageView> views)
    : session_(session),
      wizard_(wizard),
      preferences_(preferences),
      language_(language),
      views_(std::move(views)),
      endQuestion_(session) {
  setWindowTitle("Relucent");
  const auto tellVenue = [this, &session] {
    setWindowFilePath(QString::fromStdString(session.path().string()));
  };
  connect(&session, &Session::opened, this, tellVenue);
  tellVenue();
  setAcceptDrops(true);
  auto* whole = new QWidget;
  setRole(whole, "window");
  auto* rows = new QVBoxLayout(whole);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  auto* upper = new QHBoxLayout;
  upper->setSpacing(0);
  upper->addWidget(rail_ = new StepRail(wizard_, session_));
  auto* right = new QVBoxLayout;
  right->setSpacing(0);
  buildHeader();
  buildRailFooter();
  right->addWidget(header_);

  auto* content = new QHBoxLayout;
  content->setContentsMargins(space::page, 0, space::page, space::gap);
  content->setSpacing(space::gap);
  auto* stageColumn = new QVBoxLayout;
  stageColumn->setSpacing(0);
  stageColumn->addWidget(banner_ = new BannerBar(wizard_));
  stageColumn->addWidget(stages_ = new QStackedWidget, 1);
  content->addLayout(stageColumn, 1);
  content->addWidget(inspectors_ = new QStackedWidget);
  for (const PageView& view : views_) {
    stages_->addWidget(stageScroll(view.stage));
    inspectors_->addWidget(view.inspector);
  }
  right->addLayout(content, 1);
  right->addWidget(actions_ = new ActionBar(wizard_));
  upper->addLayout(right, 1);
  rows->addLayout(upper, 1);
  rows->addWidget(strip_ = new StatusStrip(session_));
  setCentralWidget(whole);
  setMinimumSize(leastSize);

  for (std::size_t i = 0; i < wizard_.count(); ++i) {
    PageModel* page = &wizard_.page(i);
    connect(page, &PageModel::failed, this,
            [this, page](const FailureReport& report) { tell(*page, report); });
  }
  connect(&wizard_, &Wizard::statusChanged, this, &MainWindow::refresh);
  connect(&wizard_, &Wizard::statusChanged, this, &MainWindow::returnFocus, Qt::QueuedConnection);
  connect(&wizard_, &Wizard::moved, this, [this] {
    refresh();
    focusLent_ = nullptr;
    hasWorked_ = false;
    focusFirst(stages_);
  });
  connect(rail_, &StepRail::lockedPressed, this, [this](const QString& why) { strip_->say(why); });
  connect(rail_, &StepRail::currentPressed, this, [this] { focusFirst(stages_); });
  connect(qApp, &QApplication::focusChanged, this, &MainWindow::followFocus);
  new QuietWheel(this);
  bindKeys();
  refresh();
}

void MainWindow::buildHeader() {
  header_ = new QWidget;
  auto* row = new QHBoxLayout(header_);
  row->setContentsMargins(space::page, 8, space::page, 8);
  auto* titles = new QVBoxLayout;
  titles->setSpacing(2);
  titles->addWidget(title_ = elidedLabel("title"));
  titles->addWidget(subtitle_ = elidedLabel("secondary"));
  row->addLayout(titles, 1);
  dim_ = buttonOf(tr("Dim pictures"), "flat");
  dim_->setCheckable(true);
  row->addWidget(dim_);
  connect(dim_, &QPushButton::toggled, &preferences_, &Preferences::setDimmed);
  connect(&preferences_, &Preferences::changed, dim_, [this] { dim_->setChecked(preferences_.isDimmed()); });
  auto look = [this] {
    dim_->setText(Theme::instance().isDimmed() ? tr("Pictures dimmed") : tr("Dim pictures"));
    dim_->setToolTip(tr("Less light from this screen falls into the room (F9)"));
    dim_->setIcon(iconOf(Icon::moon, colours().text));
  };
  connect(&Theme::instance(), &Theme::changed, this, look);
  dim_->setChecked(preferences_.isDimmed());
  look();
}

void MainWindow::buildRailFooter() {
  QPushButton* settings = buttonOf(tr("Settings"), "flat");
  QPushButton* help = buttonOf(tr("Help"), "flat");
  settings->setObjectName("open-settings");
  help->setObjectName("open-help");
  settings->setToolTip(settings->text());
  help->setToolTip(QString("%1 (%2)").arg(help->text(), tr("F1")));
  for (QPushButton* button : {settings, help}) {
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    button->setAccessibleName(button->text());
    // Clicked, they leave the focus on the page: there Enter does what the page says.
    button->setFocusPolicy(Qt::TabFocus);
    rail_->footer()->addWidget(button);
    footer_.push_back(button);
  }
  connect(settings, &QPushButton::clicked, this, &MainWindow::showSettings);
  connect(help, &QPushButton::clicked, this, &MainWindow::showHelp);
  auto look = [=] {
    settings->setIcon(iconOf(Icon::settings, colours().text));
    help->setIcon(iconOf(Icon::help, colours().text));
  };
  connect(&Theme::instance(), &Theme::changed, settings, look);
  look();
}

/// Words, below each other where they have no room beside each other; icons alone where the rail has none.
void MainWindow::fitRailFooter() {
  int needed = 0;
  for (QPushButton* button : footer_) {
    button->ensurePolished();
    button->setText(button->accessibleName());
    needed += button->sizeHint().width();
  }
  // Each as wide as its words want.
  for (std::size_t i = 0; i < footer_.size(); ++i)
    rail_->footer()->setStretch(static_cast<int>(i), footer_[i]->sizeHint().width());
  QMargins margins = rail_->layout()->contentsMargins();
  int spaces = static_cast<int>(footer_.size()) - 1;
  int room = rail_->width() - margins.left() - margins.right() - spaces * rail_->footer()->spacing();
  const bool isNarrow = rail_->width() <= narrowRail;
  rail_->footer()->setDirection(isNarrow || needed > room ? QBoxLayout::TopToBottom
                                                          : QBoxLayout::LeftToRight);
  if (!isNarrow) return;
  for (QPushButton* button : footer_) button->setText({});
}

void MainWindow::showSettings() {
  auto* dialog = new SettingsDialog(preferences_, language_.available(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

void MainWindow::showHelp() {
  if (help_ == nullptr) help_ = new HelpWindow(language_.spoken(), this);
  help_->showPage(static_cast<int>(wizard_.current()));
  help_->show();
  help_->raise();
  help_->activateWindow();
}

void MainWindow::bindKeys() {
  // Held down, a key does not run from one action into the next.
  auto key = [this](const QKeySequence& keys, auto action) {
    auto* shortcut = new QShortcut(keys, this);
    shortcut->setAutoRepeat(false);
    connect(shortcut, &QShortcut::activated, this, action);
  };
  for (std::size_t i = 0; i < wizard_.count(); ++i)
    key(QKeySequence(QString("Alt+%1").arg(i + 1)), [this, i] { wizard_.go(i); });
  key(QKeySequence("Alt+Left"), [this] { wizard_.back(); });
  key(QKeySequence("Ctrl+Return"), [this] { actions_->runPrimary(); });
  key(QKeySequence("Ctrl+Enter"), [this] { actions_->runPrimary(); });
  key(QKeySequence("Ctrl+Z"), [this] { undo(); });
  const auto redo = [this] { this->redo(); };
  key(QKeySequence("Ctrl+Shift+Z"), redo);
  key(QKeySequence("Ctrl+Y"), redo);
  key(QKeySequence("F1"), [this] { showHelp(); });
  key(QKeySequence("F6"), [this] { moveToNextRegion(); });
  key(QKeySequence("F9"), [this] { dim_->toggle(); });
  key(QKeySequence("F11"), [this] { setFullScreen(!isFullScreen()); });
}

/// What it was before, maximized or not, it is again afterwards.
void MainWindow::setFullScreen(bool whole) {
  setWindowState(windowState().setFlag(Qt::WindowFullScreen, whole));
}

/// By nobody: of what cannot be pressed any more, the focus goes to whatever is next, for which the next key
/// was never meant: the page would be left, a show installed, the room said to be clear.
bool MainWindow::isPassedOn(const QWidget* before, const QWidget* now) const {
  if (before == nullptr || now == nullptr || !isAncestorOf(before) || !isAncestorOf(now)) return false;
  // What comes after it in a list on the stage is as good.
  if (stages_->isAncestorOf(before) && stages_->isAncestorOf(now)) return false;
  return !(before->isVisible() && before->isEnabled());
}

void MainWindow::followFocus(QWidget* before, QWidget* now) {
  if (!isPassedOn(before, now)) {
    if (now != inspectors_) forgetKeptFocus();  // somebody went elsewhere
    // What is clicked is in sight and must not move under the pointer; nor does anything when a button that
    // started something can be pressed again.
    const bool isClicked = QGuiApplication::mouseButtons() != Qt::NoButton;
    if (now != nullptr && isAncestorOf(now) && !isClicked && !isReturning_) bringIntoSight(now);
    return;
  }
  if (now == inspectors_ || now == stages_) return;
  // A button of the inspector that started something has it again when it can be pressed again.
  if (inspectors_->isAncestorOf(before)) {
    if (focusKept_ == nullptr) {
      focusKept_ = before;
      before->installEventFilter(this);
    }
    inspectors_->setFocus();
    QMetaObject::invokeMethod(this, &MainWindow::returnKeptFocus, Qt::QueuedConnection);
    return;
  }
  stages_->setFocus();
  const bool isOffer = banner_->isAncestorOf(before);
  // Once the stage knows what has ended, unless another page has the focus by then.
  QMetaObject::invokeMethod(
      this,
      [this, isOffer] {
        if (focusWidget() != stages_) return;
        focusFirst(stages_);  // where nothing takes it, the stage itself has it
        // After a banner's offer that began no work, the focus is not to come back on what leads on.
        const bool isAtWork = wizard_.currentPage().progress().has_value();
        focusLent_ = isOffer && !isAtWork ? nullptr : focusWidget();
        returnFocus();
      },
      Qt::QueuedConnection);
}

void MainWindow::returnKeptFocus() {
  if (focusKept_ == nullptr) return;
  if (focusWidget() != inspectors_ || !focusKept_->isVisible() || !focusKept_->isEnabled()) return;
  QWidget* kept = focusKept_;
  forgetKeptFocus();
  isReturning_ = true;
  kept->setFocus();
  isReturning_ = false;
}

void MainWindow::forgetKeptFocus() {
  if (focusKept_ != nullptr) focusKept_->removeEventFilter(this);
  focusKept_ = nullptr;
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  if (watched == focusKept_ && (event->type() == QEvent::EnabledChange || event->type() == QEvent::Show))
    QMetaObject::invokeMethod(this, &MainWindow::returnKeptFocus, Qt::QueuedConnection);
  return QMainWindow::eventFilter(watched, event);
}

/// After a job what leads on has the focus again once it is possible, as long as nobody has gone elsewhere
/// meanwhile.
void MainWindow::returnFocus() {
  const bool isAtWork = wizard_.currentPage().progress().has_value();
  hasWorked_ = hasWorked_ || isAtWork;
  if (isAtWork || !hasWorked_ || focusLent_ == nullptr || focusWidget() != focusLent_) return;
  if (!actions_->focusPrimary()) return;
  focusLent_ = nullptr;
  hasWorked_ = false;
}

/// Enter does what the button with the focus says, as it does on tiles. Esc leaves the whole screen, where
/// nothing on the page has a use for it.
void MainWindow::keyPressEvent(QKeyEvent* event) {
  auto* button = qobject_cast<QAbstractButton*>(focusWidget());
  const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (isEnter && !event->isAutoRepeat() && button != nullptr && !button->isCheckable())
    return button->click();
  if (event->key() == Qt::Key_Escape && isFullScreen()) return setFullScreen(false);
  QMainWindow::keyPressEvent(event);
}

/// Taken back is only what can be changed. What that was is said: it may be out of sight, and another change
/// than the one that somebody thinks of, since not all can be taken back.
void MainWindow::undo() {
  PageModel& page = wizard_.currentPage();
  if (!page.whyLocked().isEmpty()) return;
  QUndoStack& changes = page.undoStack();
  strip_->say(changes.canUndo() ? tr("Undone: %1").arg(changes.undoText()) : tr("Nothing to undo here"));
  changes.undo();
}

void MainWindow::redo() {
  PageModel& page = wizard_.currentPage();
  if (!page.whyLocked().isEmpty()) return;
  QUndoStack& changes = page.undoStack();
  strip_->say(changes.canRedo() ? tr("Done again: %1").arg(changes.redoText()) : tr("Nothing to do again"));
  changes.redo();
}

void MainWindow::moveToNextRegion() {
  std::vector<QWidget*> regions{stages_, inspectors_, actions_, rail_};
  std::size_t now = 0;
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (QWidget* focus = QApplication::focusWidget(); focus != nullptr && regions[i]->isAncestorOf(focus))
      now = i + 1;
  for (std::size_t step = 0; step < regions.size(); ++step) {
    if (focusFirst(regions[(now + step) % regions.size()])) return;
  }
}

void MainWindow::refresh() {
  const PageModel& page = wizard_.currentPage();
  title_->setWhole(page.title());
  subtitle_->setWhole(page.subtitle());
  int index = static_cast<int>(wizard_.current());
  if (stages_->currentIndex() != index) {
    stages_->setCurrentIndex(index);
    inspectors_->setCurrentIndex(index);
  }
  inspectors_->setVisible(page.usesInspector());
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (focusWidget() == nullptr || rail_->isAncestorOf(focusWidget())) focusFirst(stages_);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  const bool isWide = width() >= space::wideFrom, isNarrow = width() < narrowBelow,
             isLow = height() < lowBelow;
  rail_->setNarrow(isNarrow);
  rail_->setFixedWidth(isWide ? space::wideRail : isNarrow ? narrowRail : space::rail);
  fitRailFooter();
  inspectors_->setFixedWidth(isWide ? space::wideInspector : space::inspector);
  subtitle_->setVisible(!isLow);
  header_->setFixedHeight(isLow ? lowHeader : space::header);
  QMainWindow::resizeEvent(event);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (!calibrationIn(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  if (QString folder = calibrationIn(*event->mimeData()); !folder.isEmpty()) Q_EMIT dropped(folder);
}

void MainWindow::closeWithoutAsking() {
  asksBeforeClosing_ = false;
  close();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (asksBeforeClosing_ && endQuestion_.isNeeded()) {
    event->ignore();
    return endQuestion_.whenNothingEnds(
        [this] { closeWithoutAsking(); },
        [this](const FailureReport& question) { tell(wizard_.currentPage(), question); });
  }
  // What is measured is in the journal: nothing is lost, and the next start offers to go on.
  for (std::size_t i = 0; i < wizard_.count(); ++i) wizard_.page(i).finish();
  if (!session_.areDevicesFree()) {
    event->ignore();
    return closeOnceDevicesAreFree();
  }
  // A picture on the whole screen, or the guide, would keep the program without its window.
  for (QWidget* other : QApplication::topLevelWidgets())
    if (other != this && other->isVisible()) other->close();
  QMainWindow::closeEvent(event);
}

/// A window that is gone while its program still works with the devices would leave them to nobody.
void MainWindow::closeOnceDevicesAreFree() {
  asksBeforeClosing_ = false;
  if (findChild<EndingDialog*>() != nullptr) return;
  (new EndingDialog(this))->open();
  // Once the page whose work it was has put it away.
  connect(
      &session_, &Session::devicesChanged, this,
      [this] {
        if (session_.areDevicesFree()) close();
      },
      Qt::QueuedConnection);
}

void MainWindow::tell(const PageModel& page, const FailureReport& report) {
  auto* dialog = new FailureDialog(report, page.name(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setModal(true);
  dialog->open();
}

}  // namespace relucent::gui
