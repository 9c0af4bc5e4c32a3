// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>

namespace relucent::gui {

/// Shown from when the window is closed until work with the devices has ended, which a photograph under way
/// delays. Nobody closes it: it ends with the window.
class EndingDialog : public QDialog {
  Q_OBJECT

 public:
  explicit EndingDialog(QWidget* parent = nullptr);
  void reject() override {}
};

}  // namespace relucent::gui
