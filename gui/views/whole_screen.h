// SPDX-License-Identifier: MIT
#pragma once

#include <QPointer>
#include <QWidget>

namespace relucent::gui {

/// Shows a view full screen, in a window of its own, until that is closed by the view, Esc or F11. Then the
/// view returns to its place in the page.
class WholeScreen : public QWidget {
  Q_OBJECT

 public:
  /// `view` is in a layout of a window, which owns this object.
  explicit WholeScreen(QWidget& view);
  ~WholeScreen() override;

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void giveBack();

  QPointer<QWidget> view_, place_;
};

}  // namespace relucent::gui
