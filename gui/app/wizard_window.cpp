// SPDX-License-Identifier: MIT
#include "app/wizard_window.h"

#include <QApplication>
#include <utility>

#include "app/help_window.h"
#include "app/settings_dialog.h"
#include "theme/theme.h"

namespace relucent {

WizardWindow::WizardWindow(QSettings& settings, std::filesystem::path cache, const QString& translations)
    : preferences_(settings),
      languageCode_(preferences_.language()),
      language_(languageCode_, translations),
      session_(std::move(cache)),
      venue_(session_, RecentVenues(settings)),
      camera_(session_),
      linearize_(session_),
      acquire_(session_),
      threshold_(session_),
      cluster_(session_),
      preview_(session_),
      output_(session_),
      wizard_(session_) {
  Theme::instance().apply(preferences_.isLight() ? Look::light : Look::dark);
  follow();
  for (PageModel* page : std::initializer_list<PageModel*>{&venue_, &camera_, &linearize_, &acquire_,
                                                           &threshold_, &cluster_, &preview_, &output_})
    wizard_.add(*page);
  window_ = makeWindow();
  QObject::connect(&preferences_, &Preferences::changed, &session_, [this] { follow(); });
  auto sound = [this] {
    if (preferences_.hasSound()) QApplication::beep();
  };
  QObject::connect(&acquire_, &AcquirePage::measured, &session_, sound);
  QObject::connect(&acquire_, &AcquirePage::asks, &session_, sound);
  QObject::connect(&acquire_, &AcquirePage::secondsToLeaveChosen, &preferences_,
                   &Preferences::setSecondsToLeave);
  QObject::connect(&acquire_, &AcquirePage::soundChosen, &preferences_, &Preferences::setSound);
}

std::unique_ptr<MainWindow> WizardWindow::makeWindow() {
  auto window = std::make_unique<MainWindow>(
      session_, wizard_, preferences_, language_,
      std::vector<PageView>{viewOf(venue_), viewOf(camera_), viewOf(linearize_), viewOf(acquire_),
                            viewOf(threshold_), viewOf(cluster_), viewOf(preview_), viewOf(output_)});
  QObject::connect(window.get(), &MainWindow::dropped, &venue_, &VenuePage::open);
  return window;
}

/// Pages know no widgets and go on with what they do; the window round them is made anew in its place.
void WizardWindow::speakAnew() {
  PageModel* busy = nullptr;
  for (std::size_t i = 0; i < wizard_.count(); ++i)
    if (wizard_.page(i).name() == session_.busy()) busy = &wizard_.page(i);
  language_.choose(languageCode_);
  // By its new name, by which it will say that it is done.
  if (busy != nullptr) session_.setBusy(busy->name());
  std::unique_ptr<MainWindow> before = std::exchange(window_, makeWindow());
  window_->setGeometry(before->geometry());
  if (before->isVisible()) {
    window_->setWindowState(before->windowState());
    window_->show();
    const auto* help = before->findChild<HelpWindow*>();
    if (help != nullptr && help->isVisible()) {
      window_->showHelp();
      window_->findChild<HelpWindow*>()->replace(*help);
    }
    const auto* settings = before->findChild<SettingsDialog*>();
    if (settings != nullptr && settings->isVisible()) window_->showSettings();
  }
  before->hide();
  // It may be its own settings that ask for this.
  before.release()->deleteLater();
}

WizardWindow::~WizardWindow() = default;

void WizardWindow::follow() {
  Look look = preferences_.isLight() ? Look::light : Look::dark;
  if (Theme::instance().look() != look) Theme::instance().apply(look);
  Theme::instance().setDimmed(preferences_.isDimmed());
  session_.setFlashLimit(preferences_.flashLimit());
  venue_.setUsualFolder(preferences_.folder());
  acquire_.setSecondsToLeave(preferences_.secondsToLeave());
  acquire_.setSound(preferences_.hasSound());
  if (std::exchange(languageCode_, preferences_.language()) != preferences_.language()) speakAnew();
}

}  // namespace relucent
