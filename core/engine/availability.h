// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "relucent/engine/engine_plan.h"

namespace relucent::engine {

/// How much of each projector's light a picture is made of: 1 all, 0 none, as where somebody stands in it.
struct Availability {
  /// Of one projector: square cells of so many pixels, the first at the upper left corner.
  struct Grid {
    int side = 1;
    Size cells;
    std::vector<float> share;  // per cell, 0 to 1
    bool operator==(const Grid&) const = default;
  };
  std::vector<Grid> projectors;

  bool isComplete() const;
  bool operator==(const Availability&) const = default;
};

/// All of a projector's light, in cells of that side.
Availability::Grid completeGrid(Size projector, int side);
/// Per pixel of a projector, bilinear between the cells' middles, constant beyond the outer ones.
std::vector<float> sharesOfPixels(const Availability::Grid& grid, Size projector);

/// Prepared content for light that somebody stands in. What is projected is a p, a of every projector pixel,
/// as if a filter were in front of it: T diag(a) instead of T. With a mask, a is the product of its share
/// (EngineContent::kept) and of what somebody leaves. It becomes so smoothly:
///   a(t + dt) = a* + (a(t) - a*) exp(-dt / 0.05 s)
/// and with it what no longer arrives, T (1 - a) of what is free, which is linear in a: a product with T for
/// every a* that is asked for, and then a mean of two pictures a frame.
class AvailabilityFollower {
 public:
  /// `engine` must outlive it.
  explicit AvailabilityFollower(const EngineVenue& engine) : engine_(engine) {}

  /// Where `content` is to go from now on. Contract: a grid for each projector, covering it; shares of 0
  /// to 1.
  void aim(const Availability& wanted, const EngineContent& content);
  /// Goes there for so long. Whether content.available and content.missing have changed: then whatever back
  /// end has the content must be told, EngineBackend::availabilityFollowed(). After another
  /// ViewFollower::follow() it must be called, too.
  bool advance(std::chrono::duration<double> elapsed, EngineContent& content);
  /// Whether it is there.
  bool settled() const { return settled_; }
  /// Whether it is there, and nobody stands in any light.
  bool isComplete() const { return settled_ && wanted_.empty(); }

 private:
  void findMissing(const EngineContent& content);

  const EngineVenue& engine_;
  std::vector<float> wanted_;  // a*; empty: all that masks leave
  CameraStack missing_;        // of a*
  std::uint64_t freeVersion_ = 0;
  bool settled_ = true;
};

}  // namespace relucent::engine
