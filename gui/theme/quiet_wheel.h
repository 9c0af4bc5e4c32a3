// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

namespace relucent::gui {

/// Keeps the wheel from changing sliders, lists and numbers while a page is scrolled: lists that are closed
/// do not react to it, the others only while they have the focus, and it does not give it to them. Installed
/// for all widgets of the program.
class QuietWheel : public QObject {
 public:
  explicit QuietWheel(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace relucent::gui
