// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/message.h"
#include "base/raster.h"

namespace relucent {

/// Thrown by Progress::checkpoint() after the user asked to stop. What is on disk stays valid.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped on request"; }
};

/// A request to stop, shared between whoever may ask (a button, a signal handler) and the work.
class StopRequest {
 public:
  enum class Kind { none, keep, cancel };
  /// Safe to call from a signal handler. A cancel is never weakened to a keep.
  void ask(Kind kind) noexcept;
  Kind asked() const noexcept { return static_cast<Kind>(state_.load(std::memory_order_relaxed)); }

 private:
  static_assert(std::atomic<int>::is_always_lock_free);
  std::atomic<int> state_{0};
};

/// A small picture of work under way, linear RGB.
struct Preview {
  std::string name;
  Size size;
  std::vector<float> rgb;
};

/// What a measurement has still to do, as far as can be told.
struct WorkLeft {
  int shots = 0;  // patterns to be photographed
  int leastShots = 0, mostShots = 0;
  int exposures = 0;
  double seconds = 0.0;
  std::uint64_t diskBytes = 0;
  std::uint64_t memoryBytes = 0;  // at its peak
};

/// Where progress goes: a terminal, a log, a Qt signal. Called from the thread that does the work.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `fraction` of the whole, 0 to 1, never going back; `stage` names the innermost part under way.
  virtual void progressed(double fraction, const Message& stage) = 0;
  virtual void previewed(const Preview&) {}
  /// Better and better known while a measurement goes on.
  virtual void expected(const WorkLeft&) {}
};

/// A stage's share of a longer job. Pass by reference, last parameter; split with part().
class Progress {
 public:
  /// For callers that do not care.
  Progress();
  Progress(ProgressSink& sink, StopRequest& stop);

  /// The next `share` (0 to 1) of this progress, as a progress of its own named `stage`. Its reports
  /// move this one from where it stands; when the part ends, this one stands `share` further.
  Progress part(double share, Message stage);

  /// Says how far this part is, 0 to 1; smaller values than before are ignored. Then checkpoint().
  void report(double fraction);

  /// Throws: Cancelled if the user asked to cancel.
  void checkpoint() const;

  /// True when the user asked to stop and keep what there is: the stage ends early with a valid result.
  bool stopAndKeep() const;

  void preview(Preview preview) const;
  void expect(const WorkLeft& work) const;
  const Message& stage() const { return stage_; }

 private:
  /// Where `done_` stands in the whole. Exact at both ends, so that a part ends on the bit where the next
  /// begins.
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
