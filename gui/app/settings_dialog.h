// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>

#include "wizard/preferences.h"

namespace relucent {

/// Everything that is the user's to set and belongs to no venue. A change acts at once.
class SettingsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `languages`: codes of what may be chosen, "de".
  SettingsDialog(Preferences& preferences, QStringList languages, QWidget* parent = nullptr);

 private:
  QWidget* lookPart();
  QWidget* measuringPart();
  QWidget* folderPart();
  Preferences& preferences_;
  QStringList languages_;
};

}  // namespace relucent
