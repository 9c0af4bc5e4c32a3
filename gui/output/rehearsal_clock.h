// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QString>
#include <chrono>
#include <functional>
#include <optional>

namespace relucent::gui {

/// How the time of a rehearsed show goes by. Local times.
struct RehearsalPlan {
  QDateTime from;      // it begins then ...
  QDateTime until;     // ... and stands still there
  double speed = 1.0;  // times as fast as the real one

  bool operator==(const RehearsalPlan&) const = default;
};

/// Of "FROM UNTIL SPEED", as "2026-05-04T08:50 2026-05-04T18:10 4000"; none if it is anything else, ends
/// before it begins, or is slower than the real time.
std::optional<RehearsalPlan> rehearsalPlanFrom(const QString& line);

/// The time of a show that is rehearsed: days go by within seconds, as the first line of a file says. `until`
/// and `speed` may change while the show runs, so that whoever rehearses lets it go on when he has seen what
/// he waited for.
class RehearsalClock {
 public:
  using Now = std::function<std::chrono::steady_clock::time_point()>;
  /// So many times faster than usual a rehearsed show looks around and waits, whatever the speed: minutes of
  /// patience are half seconds. Frames, messages and what the network needs have their real time.
  static constexpr int haste = 120;

  /// Throws: Error{disk} if the file cannot be read; Error{format} if it has no plan.
  explicit RehearsalClock(QString file, Now now = std::chrono::steady_clock::now);

  /// Never goes back, whatever the file says.
  QDateTime now() const;
  double speed() const { return plan_.speed; }
  /// Reads the file again. One that has no plan changes nothing.
  void follow();

 private:
  QString file_;
  Now now_;
  RehearsalPlan plan_;
  QDateTime begun_;                              // what it was ...
  std::chrono::steady_clock::time_point since_;  // ... when the plan was read
};

}  // namespace relucent::gui
