// SPDX-License-Identifier: MIT
#pragma once

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

/// Takes the numbered shots of one stage, one after the other. Each is kept in the log before the next
/// begins; a shot that the log already holds for the same patterns and exposures is read instead of taken,
/// so that running a stage again with the same settings is how it is resumed.
class ShotTaker {
 public:
  ShotTaker(Rig& rig, ShotLog& log, std::string stage);

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

 private:
  Rig& rig_;
  ShotLog& log_;
  std::string stage_;
  struct Taken {
    std::string fingerprint;
    int exposures = 0;
  };
  std::vector<Taken> taken_;
};

}  // namespace relucent
