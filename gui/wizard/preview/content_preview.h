// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <memory>
#include <optional>

#include "relucent/compensation/contradiction.h"
#include "relucent/compensation/methods.h"
#include "relucent/engine/drive_encoder.h"
#include "relucent/pipeline/measured_venue.h"

namespace relucent::gui {

/// What one method is predicted to do with the content.
struct MethodPreview {
  compensation::Method method = compensation::Method::none;
  double psnr = 0.0;  // dB over the reachable pixels
  double ssim = 0.0;  // over the content
  double deltaE = 0.0;
  double seconds = 0.0;
};

/// One camera's pictures, linear.
struct ViewPreview {
  image::Image without, with;  // predicted: nothing corrected, and by the chosen method
  image::Image deltaE;         // CIEDE2000; NaN outside the content
  // How far off the light may be, 95 of 100 values, as a share of the content's white there; empty: not
  // known.
  std::vector<float> uncertainty{};
  std::vector<float> reach;  // brightest possible, as a share of the content's white there
  CameraMask reachable, inside;
  double reachableShare = 0.0, deltaEMean = 0.0, psnr = 0.0;
  double uncertaintyMean = 0.0;                  // root of the mean square over the content
  double weight = 1.0;                           // of this view in the solve, the heaviest is 1
  std::optional<compensation::Corners> corners;  // none: it lies on the surface
};

/// The content in every view, and the white it is looked at with.
struct ContentPreview {
  std::vector<ViewPreview> views;
  const ViewPreview& first() const { return views.front(); }
  float white = 1.0f;               // mean over the content: what an eye gets used to
  double blackLift = 0.0;           // share of white added to black
  compensation::Corners corners{};  // in the first view
  double reachableShare = 0.0, clipped = 0.0, deltaEMean = 0.0, psnr = 0.0;  // of the first view
  double tooDark = 0.0, tooBright = 0.0;        // with what is reachable, the whole content
  double unlit = 0.0;                           // share of the content that no projector lights
  std::shared_ptr<const image::Image> content;  // what was placed
  std::string picture;                          // where it came from
  // What the projectors are sent for either, a picture each.
  std::vector<QImage> sentWithout, sentWith;
  compensation::Compensation corrected;  // by the chosen method
};

/// Everything that predicting needs, made once for a threshold.
struct PreviewEngine {
  pipeline::MeasuredCalibration measured;
  std::optional<compensation::Compensator> compensator;
  std::vector<engine::DriveEncoder> encoders;  // of the projectors
};

/// The content in its place, by the settings' method and uncorrected. Takes as long as the method.
/// `known`: the settings' picture, where it was read already.
/// Throws: as fitTarget().
std::shared_ptr<const ContentPreview> previewOf(const PreviewEngine& engine,
                                                const pipeline::ContentSettings& settings,
                                                std::shared_ptr<const image::Image> known);
/// Where the views of that preview contradict each other (compensation/contradiction.h). Takes as long as
/// `refined` once more, and once for each view.  Throws: as fitTarget().
std::shared_ptr<const compensation::Contradiction> contradictionIn(const PreviewEngine& engine,
                                                                   const pipeline::ContentSettings& settings,
                                                                   const ContentPreview& preview);
/// The same content by another method, timed; figures are means over the views that ask for something.
MethodPreview methodPreviewOf(const PreviewEngine& engine, const pipeline::ContentSettings& settings,
                              const image::Image& content, compensation::Method method);

}  // namespace relucent::gui
