// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/calibration/shot_journal.h"

namespace relucent::calibration {

/// A journal that tells how long earlier sessions took for what this one finds in it: from each shot to the
/// next, by when they were kept. What lies between two sessions does not count, nor what a result that was
/// stored meanwhile says itself.
class EarlierShots : public rig::ShotLog {
 public:
  /// Two shots that lie further apart are of two sessions.
  static constexpr std::chrono::seconds longestBetween{120};

  /// Keeps a reference: the journal outlives it.
  explicit EarlierShots(ShotJournal& journal)
      : journal_(journal), begin_(std::filesystem::file_time_type::clock::now()) {}

  using Moment = std::filesystem::file_time_type;
  /// What was kept until then took so many seconds: it is on record.
  void remember(Moment until, double seconds) {
    recordedUntil_ = until;
    recorded_ = seconds;
  }

  std::optional<rig::Shot> find(const rig::ShotId& id, const std::string& fingerprint) override;
  void keep(const rig::Shot& shot) override { journal_.keep(shot); }
  std::uint64_t bytesOfLast() const override { return journal_.bytesOfLast(); }
  void forget(const rig::ShotId& id, const std::string& fingerprint) override {
    journal_.forget(id, fingerprint);
  }

  double seconds() const;

 private:
  ShotJournal& journal_;
  Moment begin_;
  std::vector<Moment> kept_;  // of shots that were found
  Moment recordedUntil_ = Moment::min();
  double recorded_ = 0.0;
};

}  // namespace relucent::calibration
