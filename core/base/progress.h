// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/base/raster.h"

namespace relucent {

/// Thrown by Progress::checkpoint() after the user asked to stop. What is on disk stays valid.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped on request"; }
};

/// A request to stop, shared between its source (a button, a signal handler) and the work.
class StopRequest {
 public:
  enum class Kind { none, keep, cancel };
  /// Safe to call from a signal handler. A later request to keep does not replace one to cancel.
  void ask(Kind kind) noexcept;
  Kind asked() const noexcept { return static_cast<Kind>(state_.load(std::memory_order_relaxed)); }

 private:
  static_assert(std::atomic<int>::is_always_lock_free);
  std::atomic<int> state_{0};
};

/// A small preview of work in progress, linear RGB.
struct Preview {
  std::string name;
  Size size;
  std::vector<float> rgb;
};

/// Forecast of the remaining part of a measurement.
struct WorkLeft {
  int shots = 0;  // patterns to be photographed
  int leastShots = 0, mostShots = 0;
  int exposures = 0;
  double seconds = 0.0;
  std::uint64_t diskBytes = 0;
  std::uint64_t memoryBytes = 0;  // at its peak ...
  std::uint64_t mappedBytes = 0;  // ... of which the system may move so much to the disk
};

/// Receives progress: a terminal, a log, a Qt signal. Called from the thread that does the work.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `fraction` of the whole, 0 to 1, never decreasing; `stage` names the innermost active part.
  virtual void progressed(double fraction, const Message& stage) = 0;
  virtual void previewed(const Preview&) {}
  /// Called repeatedly, more precise as a measurement proceeds.
  virtual void expected(const WorkLeft&) {}
};

/// A stage's share of a longer job. Pass by reference, last parameter; split with part().
class Progress {
 public:
  /// Ignores all reports.
  Progress();
  Progress(ProgressSink& sink, StopRequest& stop);

  /// The next `share` (0 to 1) of this progress, as a Progress named `stage`. Its reports
  /// advance this one from its present position; when the part ends, this one has advanced by `share`.
  Progress part(double share, Message stage);

  /// Reports the progress of this part, 0 to 1; decreasing values are ignored. Then calls checkpoint().
  void report(double fraction);

  /// Throws: Cancelled if the user asked to cancel.
  void checkpoint() const;

  /// True if the user asked to stop and keep: the stage then ends early with a valid result.
  bool stopAndKeep() const;

  void preview(const Preview& preview) const;
  void expect(const WorkLeft& work) const;
  const Message& stage() const { return stage_; }

 private:
  /// Position of `done_` in the whole. Exact at both ends, so that a part ends exactly where the next begins.
  double place() const;
  Progress(ProgressSink* sink, StopRequest* stop, double begin, double end, Message stage);

  ProgressSink* sink_ = nullptr;
  StopRequest* stop_ = nullptr;
  double begin_ = 0.0;
  double end_ = 1.0;
  double done_ = 0.0;
  Message stage_;
};

}  // namespace relucent
