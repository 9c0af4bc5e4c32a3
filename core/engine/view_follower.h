// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "relucent/compensation/correspondence.h"
#include "relucent/compensation/viewer.h"
#include "relucent/compensation/white_levels.h"
#include "relucent/engine/engine_plan.h"

namespace relucent::engine {

/// Prepared content for a viewer who moves: what depends on the weights of the views changes, the placement,
/// which takes long, does not.
class ViewFollower {
 public:
  /// `engine` must outlive it. `content`: of prepareContent().
  ViewFollower(const EngineVenue& engine, const EngineContent& content);

  /// Weights for a viewer at a place: followedWeights() of those views that show something, blended by his
  /// presence with what is asked for when nobody is followed. Empty: nothing is asked for where he stands.
  ///   home: of the views themselves;  rest: when nobody is followed, home or for whoever stands at a sweet
  ///   spot.
  std::vector<double> weightsFor(std::span<const compensation::Position> cameras,
                                 std::span<const double> home, std::span<const double> rest,
                                 const compensation::Position& viewer, double presence) const;

  /// `content` becomes what prepareContent() makes with these weights. Whatever back end has it must be told:
  /// EngineBackend::contentFollowed(). The first time that other views than ever before have a weight costs a
  /// product with T.
  ///   weights: one for each view, 0 or more, one of them more.
  /// Throws: as WhiteLevels::at().
  void follow(std::span<const double> weights, EngineContent& content);
  /// Whether a view has content that can be lit: the only one of weight, it could be followed.
  bool shows(std::size_t view) const { return shows_[view]; }

 private:
  /// What is lit for some of the views.
  struct Lit {
    ProjectorMask free;
    std::vector<std::int32_t> brightest;
    CameraStack lit;
    std::uint64_t version = 0;
  };
  const Lit& litFor(const std::vector<bool>& views);

  const EngineVenue& engine_;
  compensation::Target target_;  // only `inside`, `placements` and `viewWeight`
  compensation::WhiteLevels white_;
  std::vector<bool> shows_;
  compensation::ViewCorrespondence correspondence_;
  std::map<std::vector<bool>, Lit> lit_;  // by the views that have a weight
  std::uint64_t versions_ = 0;
};

}  // namespace relucent::engine
