// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "base/progress.h"
#include "content/canvas.h"
#include "engine/cpu_backend.h"
#include "engine/engine_plan.h"
#include "output/frame_renderer.h"
#include "pipeline/measured_venue.h"

namespace relucent {

/// The real-time engine over a calibration.
class EngineRenderer : public FrameRenderer {
 public:
  /// Reads a finished calibration and prepares everything; takes seconds.
  /// Throws: as loadCalibration(), prepareVenue() and prepareContent().
  EngineRenderer(const std::filesystem::path& calibration, const Canvas& canvas, Progress& progress);

  std::vector<QSize> projectors() const override;
  QString name() const override;
  RenderedFrame render(const ContentPicture& content, const RenderRequest& request) override;

 private:
  int stepsFor(const RenderRequest& request) const;

  MeasuredCalibration calibration_;
  std::optional<EngineVenue> venue_;
  std::optional<EngineContent> content_;
  std::unique_ptr<EngineBackend> backend_;
  std::vector<std::uint32_t> words_;
  QImage packed_;      // linear content, three floats a pixel
  double rest_ = 0.0;  // seconds of a frame without its steps, and of one step, as the last ones took
  double step_ = 0.0;
};

}  // namespace relucent
