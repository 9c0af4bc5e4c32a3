// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/engine/availability.h"
#include "relucent/monitoring/finding.h"
#include "relucent/monitoring/shadow_evidence.h"

namespace relucent::monitoring {

struct ShadowSettings {
  double within = 0.15;    // share of its light that the border of a projector's shadow has, so that it tells
  double beside = 0.5;     // likewise beside it
  double others = 0.15;    // share of all light that other projectors must have where they are to take over
  std::size_t least = 8;   // cells of a shadow
  double certain = 40.0;   // by which the misfit must become less for a shadow to begin, or to be gone
  double explained = 0.7;  // share of a shadow in which light must be as it says
  double explainedAround = 0.75;  // likewise of its surroundings
  int patience = 3;               // photographs in which a filled shadow may not be as it says
  double given = 5.0;             // seconds after which what was given up is looked for again
  double unknown = 1.0;           // seconds after which light is tried again of which nothing was seen
  double firm = 8.0;              // seconds at most for which a cell stays blocked that was freed too early
};

/// Whose light does not arrive where, by photographs of what plays, one after the other: visitors who stand
/// in a projector's light, of which T knows nothing. Every photograph is judged at once, from what was
/// believed before:
///  1. of every projector by itself, the cells whose share of light would have to be another one; connected
///     ones are a hypothesis: blocked, or no longer;
///  2. the one by which the photograph fits best is taken, the others are looked at again, until none is left
///     that makes it fit better by far; with it, what nothing is known of and what would be blocked besides
///     is free;
///  3. cells along the borders follow, one by one; what is left then, too little for a shadow, is free.
/// A blocked cell whose light others can give goes dark; along the border of a shadow a little light is left,
/// whose arrival tells that it has become smaller. Where the photographs that follow are not as expected, as
/// of somebody who stands before the camera and in no light, all goes back.
class ShadowTracker {
 public:
  /// `venue` must outlive it.
  explicit ShadowTracker(const WatchedVenue& venue, ShadowSettings settings = {});

  /// Whether light overlaps anywhere, so that there is something to fill.
  bool canFill() const;
  /// A photograph, whose exposure shows that moment. Whether available() is another one now.
  /// `seconds`: when, of any clock that goes on.
  bool look(const Observed& seen, const Moment& moment, const KnownLight& known, double seconds);
  /// What is to be projected, by cells.
  const engine::Availability& available() const { return available_; }
  std::vector<FilledShadow> filled() const;
  const BlockedCells& blocked() const { return blocked_; }
  const ShadowMap& map() const { return map_; }
  /// Whether the last photograph was evidence.
  bool recognised() const { return recognised_; }
  /// Nothing is known.
  void forget();

 private:
  struct Hypothesis {
    std::vector<std::size_t> cells;
    bool blocked = false;
  };
  std::vector<Hypothesis> hypothesesOf(std::size_t projector, const ShadowEvidence& evidence,
                                       double seconds) const;
  std::vector<std::vector<std::size_t>> connected(const BlockedCells& chosen) const;
  bool isLarge(const Hypothesis& hypothesis, const ShadowEvidence& evidence) const;
  /// Those that are not at the border of what is blocked, where camera pixels see both sides; if there are
  /// none, all.
  std::vector<std::size_t> within(const std::vector<std::size_t>& cells,
                                  const ShadowEvidence& evidence) const;
  /// Those two cells away: whoever stands before the camera is unlike what is predicted beside, too.
  std::vector<std::size_t> around(const std::vector<std::size_t>& cells) const;
  /// Whether light is as the hypothesis says, which the evidence assumes.
  bool isAsSeen(const Hypothesis& hypothesis, const ShadowEvidence& evidence) const;
  /// Takes it, and frees what is unknown in the same place. Returns the cells that changed.
  std::vector<std::size_t> take(const Hypothesis& hypothesis, ShadowEvidence& evidence) const;
  void search(ShadowEvidence& evidence, double seconds) const;
  void followBorders(ShadowEvidence& evidence, double seconds) const;
  /// Cells that are left of a shadow, too few to be one, unless the photograph is sure of them.
  void freeRemnants(ShadowEvidence& evidence) const;
  void giveUp(const ShadowEvidence& evidence, double seconds);
  void freeUnknown(const ShadowEvidence& evidence, double seconds);
  /// A cell that is blocked again soon after it was freed is not freed again as soon.
  void steady(const BlockedCells& before, double seconds);
  bool canOthersGive(std::size_t cell) const;
  bool choose();

  const WatchedVenue& venue_;
  ShadowSettings settings_;
  ShadowMap map_;
  std::vector<std::vector<std::size_t>> around_;
  BlockedCells blocked_, filled_;
  std::vector<int> unexplained_;             // photographs in turn, per cell
  std::vector<double> lockedUntil_, known_;  // seconds, per cell
  std::vector<double> freed_, firmUntil_, firmness_;
  engine::Availability available_;
  int unrecognised_ = 0;
  bool recognised_ = true;
};

}  // namespace relucent::monitoring
