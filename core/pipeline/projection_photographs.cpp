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

ProjectorStack ProjectionPhotographs::encoded(const ProjectorStack& linear) const {
  const Rasters& projectors = measured_.venue.transport.projectors();
  return ProjectorStack(
      image::stackFromImages(encodedDrive(linear, projectors, measured_.linearization), projectors));
}

hdr::HdrFrame ProjectionPhotographs::of(const ProjectorStack& linear, const Progress& progress) {
  return photographer_.takeAll(encoded(linear), progress);
}

hdr::BlackLevel ProjectionPhotographs::black(const Progress& progress) {
  const ProjectorStack dark(3 * measured_.venue.transport.projectors().count(), 0.0f);
  return hdr::BlackLevel(photographer_.takeAll(dark, progress));
}

}  // namespace relucent::pipeline
