// SPDX-License-Identifier: MIT
#pragma once

#include <QSettings>
#include <memory>
#include <vector>

#include "app/language.h"
#include "app/main_window.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/cluster/cluster_page.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/output/output_page.h"
#include "wizard/preview/preview_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/venue_page.h"

namespace relucent {

/// The wizard with all its pages: the one place that lists them.
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
  VenuePage& venue() { return venue_; }
  CameraPage& camera() { return camera_; }
  LinearizePage& linearize() { return linearize_; }
  AcquirePage& acquire() { return acquire_; }
  ThresholdPage& threshold() { return threshold_; }
  ClusterPage& cluster() { return cluster_; }
  PreviewPage& preview() { return preview_; }
  OutputPage& output() { return output_; }

 private:
  void follow();
  std::unique_ptr<MainWindow> makeWindow();
  void speakAnew();

  Preferences preferences_;
  QString languageCode_;  // as chosen
  Language language_;     // made before any page has text
  Session session_;
  VenuePage venue_;
  CameraPage camera_;
  LinearizePage linearize_;
  AcquirePage acquire_;
  ThresholdPage threshold_;
  ClusterPage cluster_;
  PreviewPage preview_;
  OutputPage output_;
  Wizard wizard_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace relucent
