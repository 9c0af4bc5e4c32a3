// SPDX-License-Identifier: MIT
#include "app/wizard_window.h"

#include <QCoreApplication>
#include <QLocale>
#include <QTranslator>

#include "theme/theme.h"

namespace relucent {
namespace {

constexpr const char* themeKey = "look/light";

/// The user's language where there is one, else English, whose plurals need a file too.
/// Called before any page says a word.
QSettings& inUsersLanguage(QSettings& settings) {
  static QTranslator translator;
  if (!translator.isEmpty()) return settings;
  if (translator.load(QLocale(), "relucent", "_", ":/translations") ||
      translator.load(":/translations/relucent_en.qm"))
    QCoreApplication::installTranslator(&translator);
  return settings;
}

}  // namespace

WizardWindow::WizardWindow(QSettings& settings, std::filesystem::path cache)
    : settings_(inUsersLanguage(settings)),
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
  Theme::instance().apply(settings_.value(themeKey).toBool() ? Look::light : Look::dark);
  for (PageModel* page : std::initializer_list<PageModel*>{&venue_, &camera_, &linearize_, &acquire_,
                                                           &threshold_, &cluster_, &preview_, &output_})
    wizard_.add(*page);
  window_ = std::make_unique<MainWindow>(
      session_, wizard_,
      std::vector<PageView>{viewOf(venue_), viewOf(camera_), viewOf(linearize_), viewOf(acquire_),
                            viewOf(threshold_), viewOf(cluster_), viewOf(preview_), viewOf(output_)});
  QObject::connect(window_->themeButton(), &QPushButton::clicked, window_.get(), [this] {
    bool light = Theme::instance().look() == Look::dark;
    settings_.setValue(themeKey, light);
    Theme::instance().apply(light ? Look::light : Look::dark);
  });
  QObject::connect(window_.get(), &MainWindow::dropped, &venue_, &VenuePage::open);
}

WizardWindow::~WizardWindow() = default;

}  // namespace relucent
