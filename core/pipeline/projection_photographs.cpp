// SPDX-License-Identifier: MIT
#include "relucent/pipeline/projection_photographs.h"

#include "relucent/image/image.h"
#include "relucent/pipeline/projection.h"
#include "relucent/reduction/reduced_rig.h"

namespace relucent::pipeline {

ProjectionPhotographs::ProjectionPhotographs(rig::Rig& whole, const MeasuredCalibration& measured,
                                             const std::string& stage)
    : measured_(measured),
      rig_(reduction::reduced(whole, measured.reductions)),
      shots_(rig_, log_, stage),
      photographer_(shots_, measured.linearization) {}

CameraStack ProjectionPhotographs::of(const ProjectorStack& linear, const Progress& progress) {
  const Rasters& projectors = measured_.venue.transport.projectors();
  return photographer_
      .takeAll(ProjectorStack(image::stackFromImages(
                   encodedDrive(linear, projectors, measured_.linearization), projectors)),
               progress)
      .radiance;
}

}  // namespace relucent::pipeline
