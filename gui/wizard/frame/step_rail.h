// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <vector>

#include "theme/controls.h"
#include "wizard/frame/wizard.h"

namespace relucent::gui {

/// One step in the rail: number or shape, name, result.
class StepButton : public QAbstractButton {
  Q_OBJECT

 public:
  StepButton(int number, QWidget* parent = nullptr);
  void show(const QString& name, const StepStatus& status, bool current, bool locked);
  QSize sizeHint() const override { return {208, 50}; }
  /// Its name is shown in full; the result below may end in an ellipsis.
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void paintBadge(QPainter& painter, QRectF circle) const;
  int number_;
  StepStatus status_;
  bool current_ = false, locked_ = false;
};

/// The steps, their states and results; the name of the program and of the venue above.
class StepRail : public QWidget {
  Q_OBJECT

 public:
  StepRail(Wizard& wizard, Session& session, QWidget* parent = nullptr);
  QWidget* firstFocus() const;
  QLayout* footer() const { return footer_; }

 private:
  void refresh();
  Wizard& wizard_;
  Session& session_;
  ElidedLabel* venue_;
  std::vector<StepButton*> steps_;
  QLayout* footer_;
};

}  // namespace relucent::gui
