// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "relucent/compensation/methods.h"
#include "relucent/image/image.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/reduction/reduction.h"
#include "relucent/venue/venue.h"

// The only place that asks a simulated venue for its true light transport. Contract: `evaluate` alone uses
// it.
namespace relucent::pipeline {

/// How well T was measured, by the true one.
TransportScore transportScore(const transport::TransportMatrix& transport, const venue::SimulatedVenue& venue,
                              const std::vector<reduction::Reduction>& reductions);

/// Judges projections by what they truly look like in the venue. Keeps references, which outlive it.
class Judge {
 public:
  /// `rasters`: of what its cameras see, reduced.
  Judge(const MeasuredCalibration& measured, const venue::SimulatedVenue& venue,
        std::vector<reduction::Reduction> reductions, Rasters rasters);

  /// Pixels inside the target that the true venue can reach: e <= wanted <= T 1 + e in all channels.
  CameraMask reachable(const compensation::Target& target) const { return within(target, brightest_); }
  /// The part of them that is asked for at most `share` of T 1 in all channels.
  CameraMask roomy(const compensation::Target& target, float share) const;
  /// The same with one projector alone.
  CameraMask reachableAlone(const compensation::Target& target, std::size_t projector) const;

  std::size_t views() const { return rasters_.devices(); }
  const CameraStack& black() const { return black_; }

  /// What the cameras would see, free of noise.
  CameraStack seen(const compensation::Compensation& compensation) const;
  /// The same by direct light alone (compensation/direct_light.h), without black, of projectors that are
  /// linear.
  CameraStack direct(const compensation::Compensation& compensation, Progress& progress) const;
  /// Of a stack of all cameras.
  image::Image view(const CameraStack& stack, std::size_t camera) const;
  CameraMask view(const CameraMask& mask, std::size_t camera) const;

  /// What a camera sees against what is wanted there; none if that is nothing.
  std::optional<MethodScore> scoreOf(compensation::Method method, const CameraStack& seen,
                                     const compensation::Target& target, const CameraMask& reachable,
                                     std::size_t camera) const;

 private:
  CameraStack brightestOf(const ProjectorStack& white) const;
  CameraMask within(const compensation::Target& target, const CameraStack& brightest) const;
  MethodScore score(compensation::Method method, const CameraStack& seen, const compensation::Target& target,
                    const CameraMask& reachable, std::size_t camera) const;

  const MeasuredCalibration& measured_;
  const venue::SimulatedVenue& venue_;
  std::vector<reduction::Reduction> reductions_;
  Rasters rasters_;
  CameraStack black_, brightest_;
};

/// What viewers are to see who stand where no camera does.
class UnseenPlaces {
 public:
  /// None: the venue has none.
  static std::optional<UnseenPlaces> of(const MeasuredCalibration& measured,
                                        const venue::SimulatedVenue& venue, Progress& progress);

  const Judge& judge() const { return *judge_; }

  /// The content on the surface, where the first camera sees it.
  compensation::Target target(const compensation::Target& seen) const;

 private:
  UnseenPlaces(const MeasuredCalibration& measured, const venue::SimulatedVenue& places);

  const MeasuredCalibration* measured_;
  std::unique_ptr<venue::SimulatedVenue> places_;
  std::optional<Judge> judge_;
  compensation::ViewMap map_;
};

}  // namespace relucent::pipeline
