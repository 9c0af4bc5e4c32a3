// SPDX-License-Identifier: MIT
#include "app/wizard_window.h"

#include <QApplication>
#include <utility>

#include "app/help_window.h"
#include "app/settings_dialog.h"
#include "theme/theme.h"
#include "wizard/venue/venue_page.h"

namespace relucent::gui {
namespace {

std::vector<std::unique_ptr<PageModel>> pagesOf(const std::vector<WizardStep>& steps,
                                                const PageContext& context) {
  std::vector<std::unique_ptr<PageModel>> pages;
  for (const WizardStep& step : steps) pages.push_back(step.makePage(context));
  return pages;
}

}  // namespace

WizardWindow::WizardWindow(QSettings& settings, std::filesystem::path cache, const QString& translations)
    : preferences_(settings),
      languageCode_(preferences_.language()),
      language_(languageCode_, translations),
      session_(std::move(cache)),
      steps_(wizardSteps()),
      pages_(pagesOf(steps_, {session_, preferences_, settings})),
      wizard_(session_) {
  Theme::instance().apply(preferences_.isLight() ? Look::light : Look::dark);
  follow();
  for (const std::unique_ptr<PageModel>& page : pages_) wizard_.add(*page);
  // Under a style sheet, each widget that is put into another has all its children styled again: it comes
  // last.
  const QString sheet = qApp->styleSheet();
  qApp->setStyleSheet({});
  window_ = makeWindow();
  qApp->setStyleSheet(sheet);
  QObject::connect(&preferences_, &Preferences::changed, &session_, [this] { follow(); });
}

std::unique_ptr<MainWindow> WizardWindow::makeWindow() {
  std::vector<PageView> views;
  for (std::size_t i = 0; i < steps_.size(); ++i) views.push_back(steps_[i].makeView(*pages_[i]));
  auto window = std::make_unique<MainWindow>(session_, wizard_, preferences_, language_, std::move(views));
  QObject::connect(window.get(), &MainWindow::dropped, &session_,
                   [this](const QString& path) { open(path); });
  return window;
}

/// Pages know no widgets and go on with what they do; the window round them is made again in its place.
void WizardWindow::rebuildForLanguage() {
  language_.choose(languageCode_);
  for (const std::unique_ptr<PageModel>& page : pages_) page->refresh();
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

void WizardWindow::open(const QString& path) {
  page<VenuePage>().open(path);
}

void WizardWindow::follow() {
  Look look = preferences_.isLight() ? Look::light : Look::dark;
  if (Theme::instance().look() != look) Theme::instance().apply(look);
  Theme::instance().setDimmed(preferences_.isDimmed());
  session_.setFlashLimit(preferences_.flashLimit());
  if (std::exchange(languageCode_, preferences_.language()) != preferences_.language()) rebuildForLanguage();
}

}  // namespace relucent::gui
