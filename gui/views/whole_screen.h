// SPDX-License-Identifier: MIT
#pragma once

#include <QPointer>
#include <QWidget>

namespace relucent {

/// A view on the whole of its screen, in a window of its own, until that is closed: by the view, by Esc or
/// F11. Its place in the page is kept and it goes back there.
class WholeScreen : public QWidget {
  Q_OBJECT

 public:
  /// `view` lies in a layout of a window, which owns this and ends it.
  explicit WholeScreen(QWidget& view);
  ~WholeScreen() override;

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void giveBack();

  QPointer<QWidget> view_, place_;
};

}  // namespace relucent
