// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <functional>
#include <optional>

#include "wizard/devices/nudge.h"

namespace relucent::gui {

class ImageView;
class Remark;
class ValueRow;

/// Helps to push a camera back that was bumped: what it sees now beside what it saw, an arrow that says where
/// to turn it, and how far. Closed, it waits until the devices are free.
class NudgeDialog : public QDialog {
  Q_OBJECT

 public:
  explicit NudgeDialog(Nudge& nudge, QWidget* parent = nullptr);

  void reject() override;

 private:
  void refresh();
  void showPictures();
  void showVerdict();

  Nudge& nudge_;
  ImageView* view_;
  ValueRow *across_, *along_, *turned_;
  Remark* verdict_;
  bool closing_ = false;
};

/// Begins to look, in a dialog before the window of `above`. `done` comes when that is closed and the devices
/// are free. Nothing happens before a window that is not shown.
void showNudge(QWidget& above, std::unique_ptr<Nudge> nudge, const std::function<void(const Nudge&)>& done);

}  // namespace relucent::gui
