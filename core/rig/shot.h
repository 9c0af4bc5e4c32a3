// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "rig/rig.h"

namespace relucent {

/// One pattern photographed by every camera at every exposure of a bracket.
struct Shot {
  ShotId id;
  std::string fingerprint;                    // of the patterns shown and the exposures asked for
  std::vector<std::vector<RawFrame>> frames;  // [exposure][camera]
  std::vector<double> exposuresAsked{};       // seconds; what the cameras report is in the frames
};

/// Where shots are kept as soon as they are taken. A log makes a run resumable: what it holds is not
/// photographed again.
class ShotLog {
 public:
  virtual ~ShotLog() = default;
  /// The shot `id`, if it is kept and was taken with this fingerprint.
  virtual std::optional<Shot> find(const ShotId& id, const std::string& fingerprint) = 0;
  /// On disk when this returns. Throws: Error{disk}.
  virtual void keep(const Shot& shot) = 0;
  /// Drops a shot that turned out not to be trusted; find() does not find it any more. A log that holds
  /// shots from one run to the next has to. Throws: Error{disk}.
  virtual void forget(const ShotId&, const std::string& /*fingerprint*/) {}
};

/// Keeps nothing: for tests and previews.
class NoShotLog : public ShotLog {
 public:
  std::optional<Shot> find(const ShotId&, const std::string&) override { return std::nullopt; }
  void keep(const Shot&) override {}
};

/// What shots took that were taken and not read from a log, summed: a benchmark of the devices. Seconds.
struct ShotTimes {
  int shots = 0;
  int exposures = 0;            // photographs
  double showing = 0.0;         // in Projector::show
  double capturing = 0.0;       // in Camera::capture
  double keeping = 0.0;         // in ShotLog::keep
  double between = 0.0;         // from the end of one shot to the begin of the next: computing
  double asked = 0.0;           // exposure times
  double askedSquared = 0.0;    // sum of their squares
  double askedCapturing = 0.0;  // sum of exposure time * time in capture
  std::uint64_t bytes = 0;      // of samples that a log keeps

  /// What a shot takes besides its exposures, mean.
  double shotSeconds() const;
  /// What an exposure of `asked` seconds takes: the line through those that were taken, by least squares. A
  /// simulated camera takes the same time for all of them, a real one at least the exposure's.
  double exposureSeconds(double asked) const;
};

/// Takes the numbered shots of one stage, one after the other. Each is kept in the log before the next
/// begins; a shot that the log already holds for the same patterns and exposures is read instead of taken,
/// so that running a stage again with the same settings is how it is resumed.
class ShotTaker {
 public:
  using Clock = std::function<std::chrono::duration<double>()>;

  /// `clock`: what shots are timed by; none: the machine's.
  ShotTaker(Rig& rig, ShotLog& log, std::string stage, Clock clock = {});

  /// Shows `encodedPatterns` (one per projector) and photographs them with each of `exposures` (seconds).
  /// Throws: Error{device, input, disk}; Cancelled.
  Shot take(const std::vector<Image>& encodedPatterns, const std::vector<double>& exposures,
            const Progress& progress);

  /// Goes on counting at `shot`, one that was taken before: what the log holds from there is read again.
  void goBackTo(int shot);
  /// The log forgets what was taken from `shot` on: the next run, or the same after goBackTo(), takes it
  /// anew.
  void forgetFrom(int shot);

  const Rig& rig() const { return rig_; }
  /// Shots and single exposures so far, those read from the log included.
  int shots() const { return static_cast<int>(taken_.size()); }
  int exposures() const;
  const ShotTimes& times() const { return times_; }

 private:
  double now() const { return clock_().count(); }
  void addExposure(const RawFrame& frame, double asked, double took);

  Rig& rig_;
  ShotLog& log_;
  std::string stage_;
  struct Taken {
    std::string fingerprint;
    int exposures = 0;
  };
  std::vector<Taken> taken_;
  Clock clock_;
  ShotTimes times_;
  std::optional<double> lastEnd_;  // of the last shot, if that was taken
};

}  // namespace relucent
