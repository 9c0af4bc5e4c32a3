// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>

#include "wizard/frame/preferences.h"

namespace relucent::gui {

/// User settings that belong to no venue. A change takes effect at once.
class SettingsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `languages`: codes of the available languages, "de".
  SettingsDialog(Preferences& preferences, QStringList languages, QWidget* parent = nullptr);

 private:
  QWidget* lookPart();
  QWidget* measuringPart();
  QWidget* folderPart();
  Preferences& preferences_;
  QStringList languages_;
};

}  // namespace relucent::gui
