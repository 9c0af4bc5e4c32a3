// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QScrollArea>

#include "wizard/frame/preferences.h"

namespace relucent::gui {

/// User settings that belong to no venue. A change takes effect at once.
class SettingsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `languages`: codes of the available languages, "de".
  SettingsDialog(Preferences& preferences, QStringList languages, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* lookPart();
  QWidget* measuringPart();
  QWidget* folderPart();
  Preferences& preferences_;
  QScrollArea* scroll_ = nullptr;
  QStringList languages_;
};

}  // namespace relucent::gui
