// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/progress.h"
#include "relucent/photography/photographer.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/rig/shot.h"

namespace relucent::pipeline {

/// Photographs of projections, by the devices of a calibration as it measured with them: with their noise,
/// with every exposure, and kept nowhere.
class ProjectionPhotographs {
 public:
  /// `whole`: the devices with all that their cameras deliver (reductions.h); it and `measured` must outlive
  /// this. `stage`: what the shots are called.
  ProjectionPhotographs(rig::Rig& whole, const MeasuredCalibration& measured, const std::string& stage);

  /// The radiance under linear drive, e included; at least so much where every exposure saturates.
  /// Throws: Error{device}; Cancelled.
  hdr::HdrFrame of(const ProjectorStack& linear, const Progress& progress);
  /// Under black projectors.
  hdr::BlackLevel black(const Progress& progress);
  int exposures() const { return shots_.exposures(); }
  const rig::ShotTimes& times() const { return shots_.times(); }

 private:
  ProjectorStack encoded(const ProjectorStack& linear) const;

  const MeasuredCalibration& measured_;
  rig::Rig rig_;
  rig::NoShotLog log_;
  rig::ShotTaker shots_;
  photography::Photographer photographer_;
};

}  // namespace relucent::pipeline
