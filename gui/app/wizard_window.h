// SPDX-License-Identifier: MIT
#pragma once

#include <QSettings>
#include <memory>
#include <vector>

#include "app/language.h"
#include "app/main_window.h"
#include "relucent/base/error.h"
#include "wizard/steps.h"

namespace relucent::gui {

/// The wizard with all its pages, and the window around them.
class WizardWindow {
 public:
  /// `cache`: folder of traced venues. `settings` must outlive it. `translations`: see Language.
  WizardWindow(QSettings& settings, std::filesystem::path cache,
               const QString& translations = ":/translations");
  ~WizardWindow();

  /// Replaced when the language changes.
  MainWindow& window() { return *window_; }
  Wizard& wizard() { return wizard_; }
  Preferences& preferences() { return preferences_; }
  Session& session() { return session_; }
  /// Contract: there is such a page.
  template <typename Page>
  Page& page() {
    Page* found = nullptr;
    for (const std::unique_ptr<PageModel>& made : pages_)
      if (auto* that = qobject_cast<Page*>(made.get())) found = that;
    require(found != nullptr, "the wizard has no such page");
    return *found;
  }
  /// A calibration's folder, or its file in there: see VenuePage::open().
  void open(const QString& path);

 private:
  void follow();
  std::unique_ptr<MainWindow> makeWindow();
  void rebuildForLanguage();

  Preferences preferences_;
  QString languageCode_;  // as chosen
  Language language_;     // made before any page has text
  Session session_;
  std::vector<WizardStep> steps_;
  // One a step. They hear of another calibration before the wizard does.
  std::vector<std::unique_ptr<PageModel>> pages_;
  Wizard wizard_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace relucent::gui
