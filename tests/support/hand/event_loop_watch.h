// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonArray>
#include <QJsonObject>
#include <QObject>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace relucent::test {

/// Knows how long the program's event loop leaves others waiting. A thread of its own sends it an event as
/// soon as the one before was received; from the time between, what the computer gave to other programs
/// meanwhile is taken off (/proc/self/task/.../schedstat). A wait that is too long is kept with the functions
/// in which the loop was in its middle. A loop that does not answer in `hung` is told on standard error, with
/// these, and the program aborted; one that never ends after its loop, too. A crash is told as well.
class EventLoopWatch : public QObject {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds tooLong{1000}, hung{30'000};
  /// Upper ends of the histogram's parts, milliseconds; the last part has none.
  static constexpr std::array parts{20, 100, 250, 1000};

  EventLoopWatch();
  ~EventLoopWatch() override;

  /// {"waits": [how many in each part], "longest": ms, "blocks": [{"ms", "where": ["file(+offset)", ...]}]},
  /// since asked before.
  QJsonObject report();

 private:
  void watch();
  void received();
  double waitedMilliseconds(Clock::time_point now) const;

  std::thread thread_;
  std::atomic<bool> ends_ = false;
  std::mutex lock_;
  bool isOnItsWay_ = false, isFirst_ = true;
  Clock::time_point sent_;
  double elsewhere_ = 0.0;  // milliseconds that the computer was another's, when it was sent
  std::vector<QString> where_;
  std::array<int, parts.size() + 1> waits_{};
  double longest_ = 0.0;
  QJsonArray blocks_;
};

}  // namespace relucent::test
