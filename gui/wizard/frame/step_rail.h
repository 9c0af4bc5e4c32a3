// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QBoxLayout>
#include <QScrollArea>
#include <vector>

#include "theme/controls.h"
#include "wizard/frame/wizard.h"

namespace relucent::gui {

/// One step in the rail: number or shape, name, result.
class StepButton : public QAbstractButton {
  Q_OBJECT

 public:
  StepButton(int number, QWidget* parent = nullptr);
  /// `whyLocked`: why it cannot be opened; empty: it can.
  void show(const QString& name, const StepStatus& status, bool current, const QString& whyLocked);
  /// Number or shape alone; name and result are in the tool tip.
  void setNarrow(bool narrow);
  QSize sizeHint() const override;
  /// Its name is shown in full; the result below may end in an ellipsis.
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  /// By mouse, while it cannot be opened.
  void lockedPressed();

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void paintBadge(QPainter& painter, QRectF circle) const;
  int number_;
  StepStatus status_;
  bool current_ = false, locked_ = false, narrow_ = false;
};

/// The steps, their states and results; the name of the program and of the venue above. The steps scroll
/// where the window is low.
class StepRail : public QWidget {
  Q_OBJECT

 public:
  StepRail(Wizard& wizard, Session& session, QWidget* parent = nullptr);
  QBoxLayout* footer() const { return footer_; }
  /// Badges without words.
  void setNarrow(bool narrow);

 Q_SIGNALS:
  /// The step that is open anyhow.
  void currentPressed();
  /// One that cannot be opened yet. `why`: a sentence.
  void lockedPressed(const QString& why);

 private:
  void refresh();
  Wizard& wizard_;
  Session& session_;
  QWidget* names_;
  ElidedLabel* venue_;
  QHBoxLayout* top_;
  QScrollArea* scroll_;
  std::vector<StepButton*> steps_;
  QBoxLayout* footer_;
};

}  // namespace relucent::gui
