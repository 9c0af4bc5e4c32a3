// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <QCoreApplication>
#include <QThread>
#include <QTimer>

namespace relucent {

/// Deals with events until a thread has ended, asleep between them. Calls each() after them, every 20 ms at
/// least.
inline void waitFor(QThread& worker, const std::function<void()>& each = {}) {
  // processEvents() with a time would not sleep but ask again and again.
  QTimer wakes;
  wakes.start(20);
  while (!worker.isFinished()) {
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    if (each) each();
  }
  worker.wait();
}

}  // namespace relucent
