// SPDX-License-Identifier: MIT
#pragma once

#include <QPushButton>

namespace relucent::gui {

/// A button that Enter presses while it has the focus, as Space does. In a dialog Qt would press the default
/// one, whichever has the focus. Held down, the key presses once.
class EnterButton : public QPushButton {
 public:
  using QPushButton::QPushButton;

 protected:
  void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace relucent::gui
