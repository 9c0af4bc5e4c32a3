// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QTimer>
#include <Qt>
#include <chrono>

class QWindow;

namespace relucent::gui {

/// A key that has to be held for a while at one of some windows before it counts: what stands unattended is
/// not ended by a stray one.
class HeldKey : public QObject {
  Q_OBJECT

 public:
  HeldKey(Qt::Key key, std::chrono::milliseconds time, QObject* parent = nullptr);
  /// Its keys are looked at as well, as long as it lives.
  void watch(QWindow& window);

 Q_SIGNALS:
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
