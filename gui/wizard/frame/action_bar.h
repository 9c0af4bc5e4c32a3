// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QHBoxLayout>
#include <QPointer>
#include <QProgressBar>
#include <QPushButton>

#include "theme/controls.h"
#include "wizard/frame/wizard.h"

namespace relucent::gui {

/// Back; the time or a reason; secondary actions; the one primary action, named by its verb.
class ActionBar : public QFrame {
  Q_OBJECT

 public:
  explicit ActionBar(Wizard& wizard, QWidget* parent = nullptr);
  QWidget* firstFocus() const;
  /// Triggers the primary command if it is enabled.
  void runPrimary();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void refresh();
  void refreshSecondary(const std::vector<PageCommand*>& commands);
  Wizard& wizard_;
  QProgressBar* progress_;
  QPushButton *back_, *primary_;
  QLabel* hint_;
  QHBoxLayout* secondary_;
  std::vector<QPushButton*> buttons_;
  std::vector<QPointer<PageCommand>> commands_;
};

}  // namespace relucent::gui
