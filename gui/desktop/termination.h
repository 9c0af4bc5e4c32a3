// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QSocketNotifier>

namespace relucent::gui {

/// Turns the signals that ask a program to end (SIGTERM, SIGINT, SIGHUP) into a Qt signal. One at a time.
class Termination : public QObject {
  Q_OBJECT

 public:
  explicit Termination(QObject* parent = nullptr);
  ~Termination() override;

 Q_SIGNALS:
  void requested();

 private:
  QSocketNotifier notifier_;
};

}  // namespace relucent::gui
