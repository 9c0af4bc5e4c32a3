// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonArray>
#include <chrono>
#include <map>
#include <vector>

#include "content/live_state.h"

namespace relucent::gui {

/// What a show's log says of streams: what is connected to, and each loss and each return once, however often
/// a stream is opened and however many attempts fail in between.
class StreamTeller {
 public:
  using Time = std::chrono::steady_clock::time_point;
  struct Line {
    Message sentence;
    bool isWarning = false;
  };
  /// What is new since the last call.
  std::vector<Line> news(const std::vector<LiveState>& streams, Time now);

 private:
  /// Of an address.
  struct Told {
    std::uint64_t opening = 0;
    int losses = 0;  // of that opening
    QSize size;      // empty: it has not played yet
    bool isLost = false;
    Time since;  // that it is lost
  };
  std::map<QString, Told> told_;
};

/// As health.json has them.
QJsonArray toJson(const std::vector<LiveState>& streams);

}  // namespace relucent::gui
