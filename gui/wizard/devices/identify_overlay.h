// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QScreen>
#include <QTimer>
#include <QWindow>
#include <memory>
#include <vector>

namespace relucent::gui {

/// Its number among the screens, from 1 without the operator's, in the order of their places.
int screenNumber(const QScreen& screen);
/// "Screen 1".
QString screenTitle(const QScreen& screen);

/// On every screen but the operator's: its number and name, and lines of one pixel at its edge and within. If
/// they are not sharp, the projector scales its picture. It leaves after eight seconds, when it is
/// hidden, or with its parent, the widget that offers it: closed, the program does not wait for it.
class IdentifyOverlay : public QObject {
  Q_OBJECT

 public:
  static constexpr int milliseconds = 8000;
  explicit IdentifyOverlay(QObject* parent = nullptr);
  ~IdentifyOverlay() override;
  bool isShown() const { return !windows_.empty(); }
  void show();
  void hide();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  std::vector<std::unique_ptr<QWindow>> windows_;
  QTimer leaving_;
};

}  // namespace relucent::gui
