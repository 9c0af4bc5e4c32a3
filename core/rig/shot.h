// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/rig/rig.h"

namespace relucent::rig {

/// One pattern photographed by every camera at every exposure of a bracket.
struct Shot {
  ShotId id;
  std::string fingerprint;                    // of the patterns and the requested exposures
  std::vector<std::vector<RawFrame>> frames;  // [exposure][camera]
  std::vector<double> exposuresAsked{};       // seconds; what the cameras report is in the frames
};

/// Of a shot's samples, uncompressed: whole codes take a byte or two each, anything else four.
std::uint64_t plainBytes(const Shot& shot);

/// Stores shots as soon as they are taken. A log makes a run resumable: shots that it holds are not
/// photographed again.
class ShotLog {
 public:
  virtual ~ShotLog() = default;
  /// The shot `id`, if it is stored and was taken with this fingerprint.
  virtual std::optional<Shot> find(const ShotId& id, const std::string& fingerprint) = 0;
  /// On disk when this returns. Throws: Error{disk}.
  virtual void keep(const Shot& shot) = 0;
  /// Bytes that the shot kept last takes; 0: as many as its samples.
  virtual std::uint64_t bytesOfLast() const { return 0; }
  /// Removes a shot that proved unreliable; find() no longer returns it. Persistent logs must implement this.
  /// Throws: Error{disk}.
  virtual void forget(const ShotId&, const std::string& /*fingerprint*/) {}
};

/// Stores nothing: for tests and previews.
class NoShotLog : public ShotLog {
 public:
  std::optional<Shot> find(const ShotId&, const std::string&) override { return std::nullopt; }
  void keep(const Shot&) override {}
};

/// Total time of the shots that were taken, not read from a log: a benchmark of the devices. Seconds.
struct ShotTimes {
  int shots = 0;
  int exposures = 0;            // photographs
  double showing = 0.0;         // in Projector::show
  double capturing = 0.0;       // in Camera::capture
  double keeping = 0.0;         // in ShotLog::keep
  double between = 0.0;         // from the end of one shot to the beginning of the next: computing
  double asked = 0.0;           // exposure times
  double askedSquared = 0.0;    // sum of their squares
  double askedCapturing = 0.0;  // sum of exposure time * time in capture
  std::uint64_t bytes = 0;      // that a log stores

  /// Mean time of a shot without its exposures.
  double shotSeconds() const;
  /// Predicted time of an exposure of `asked` seconds: a line fitted to the previous exposures by least
  /// squares. A simulated camera takes the same time for all of them, a real one at least the exposure time.
  double exposureSeconds(double asked) const;
};

/// Takes the numbered shots of one stage, one after the other. Each is stored in the log before the next
/// begins; a shot that the log already holds for the same patterns and exposures is read instead of taken, so
/// that a stage is resumed by running it again with the same settings.
class ShotTaker {
 public:
  using Clock = std::function<std::chrono::duration<double>()>;

  /// `clock`: used to time shots; none: the system's.
  ShotTaker(Rig& rig, ShotLog& log, std::string stage, Clock clock = {});

  /// Shows `encodedPatterns` (one per projector) and photographs them with each of `exposures` (seconds).
  /// Throws: Error{device, input, disk}; Cancelled.
  Shot take(const std::vector<image::Image>& encodedPatterns, const std::vector<double>& exposures,
            const Progress& progress);

  /// Continues at `shot`, an earlier one: shots that the log holds from there on are read again.
  void goBackTo(int shot);
  /// Removes the shots from `shot` on from the log: the next run, or this one after goBackTo(), takes them
  /// again.
  void forgetFrom(int shot);

  const Rig& rig() const { return rig_; }
  /// Shots and single exposures so far, those read from the log included.
  int shots() const { return static_cast<int>(taken_.size()); }
  int exposures() const;
  const ShotTimes& times() const { return times_; }

 private:
  double now() const { return clock_().count(); }
  void addExposure(double asked, double took);

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
  std::optional<double> lastEnd_;  // of the last shot, if it was taken, not read
};

}  // namespace relucent::rig
