// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QGridLayout>
#include <QPointer>
#include <QProgressBar>
#include <QPushButton>

#include "theme/controls.h"
#include "wizard/frame/wizard.h"

namespace relucent::gui {

/// Back; the time or a reason; secondary actions; the one primary action, named by its verb. Where the window
/// is narrow, time or reason stand in a row of their own above.
class ActionBar : public QFrame {
  Q_OBJECT

 public:
  explicit ActionBar(Wizard& wizard, QWidget* parent = nullptr);
  QWidget* firstFocus() const;
  /// Triggers the primary command if it is enabled.
  void runPrimary();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  void refreshSecondary(const std::vector<PageCommand*>& commands);
  void arrange();
  Wizard& wizard_;
  QProgressBar* progress_;
  QPushButton *back_, *primary_;
  QWidget* reason_;
  QLabel* hint_;
  QGridLayout* grid_;
  QWidget* secondary_;
  std::vector<QPushButton*> buttons_;
  std::vector<QPointer<PageCommand>> commands_;
};

}  // namespace relucent::gui
