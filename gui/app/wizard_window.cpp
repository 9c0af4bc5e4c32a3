// SPDX-License-Identifier: MIT
#include "app/wizard_window.h"

#include <QApplication>
#include <QLocale>
#include <QTranslator>

#include "theme/theme.h"

namespace relucent {
namespace {

/// The user's language where there is one, else English, whose plurals need a file too.
/// Called before any page says a word.
QSettings& inUsersLanguage(QSettings& settings) {
  static QTranslator translator;
  if (!translator.isEmpty()) return settings;
  QString chosen = Preferences(settings).language();
  QLocale locale = chosen.isEmpty() ? QLocale() : QLocale(chosen);
  if (translator.load(locale, "relucent", "_", ":/translations") ||
      translator.load(":/translations/relucent_en.qm"))
    QCoreApplication::installTranslator(&translator);
  return settings;
}

}  // namespace

WizardWindow::WizardWindow(QSettings& settings, std::filesystem::path cache)
    : preferences_(inUsersLanguage(settings)),
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
  window_ = std::make_unique<MainWindow>(
      session_, wizard_, preferences_,
      std::vector<PageView>{viewOf(venue_), viewOf(camera_), viewOf(linearize_), viewOf(acquire_),
                            viewOf(threshold_), viewOf(cluster_), viewOf(preview_), viewOf(output_)});
  QObject::connect(&preferences_, &Preferences::changed, window_.get(), [this] { follow(); });
  QObject::connect(&acquire_, &AcquirePage::measured, window_.get(), [this] {
    if (preferences_.hasSound()) QApplication::beep();
  });
  QObject::connect(window_.get(), &MainWindow::dropped, &venue_, &VenuePage::open);
}

WizardWindow::~WizardWindow() = default;

void WizardWindow::follow() {
  Look look = preferences_.isLight() ? Look::light : Look::dark;
  if (Theme::instance().look() != look) Theme::instance().apply(look);
  Theme::instance().setDimmed(preferences_.isDimmed());
  session_.setFlashLimit(preferences_.flashLimit());
  venue_.setUsualFolder(preferences_.folder());
}

}  // namespace relucent
