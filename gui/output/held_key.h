// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QTimer>
#include <Qt>
#include <chrono>

class QWindow;

namespace relucent::gui {

/// A key that is held, at one of some windows: when it goes down and up, whatever the X server repeats
/// meanwhile, and whether it was held for long enough to count, so that what stands unattended is not ended
/// by a stray one.
class HeldKey : public QObject {
  Q_OBJECT

 public:
  explicit HeldKey(Qt::Key key, std::chrono::milliseconds time = {}, QObject* parent = nullptr);
  /// Its keys are looked at as well, as long as it lives.
  void watch(QWindow& window);
  /// The same for whoever filters events already: what a window was told.
  void take(const QEvent& event);
  bool isDown() const { return isDown_; }

 Q_SIGNALS:
  void pressed();
  /// For certain, or nobody would hear of it: another window has the keys now.
  void released();
  /// It was held for long enough; once for each time that it is pressed.
  void held();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void letGo();

  Qt::Key key_;
  std::chrono::milliseconds enough_;
  bool isDown_ = false;
  QTimer time_, release_;
};

}  // namespace relucent::gui
