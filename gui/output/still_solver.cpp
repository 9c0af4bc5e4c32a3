// SPDX-License-Identifier: MIT
#include "output/still_solver.h"

#include <cmath>

#include "base/stopwatch.h"
#include "image/color.h"
#include "pipeline/projection.h"

namespace relucent {
namespace {

CompensatorSettings with(const ClusteringSettings& clustering) {
  CompensatorSettings settings;
  settings.clustering = clustering;
  return settings;
}

Image linearOf(const QImage& picture) {
  Image linear(Size{picture.width(), picture.height()}, 3);
  if (picture.format() == QImage::Format_RGBX32FPx4) {
    for (int y = 0; y < picture.height(); ++y) {
      auto* line = reinterpret_cast<const float*>(picture.constScanLine(y));
      for (int x = 0; x < picture.width(); ++x)
        for (int c = 0; c < 3; ++c) linear.at(x, y, c) = line[4 * x + c];
    }
    return linear;
  }
  for (int y = 0; y < picture.height(); ++y) {
    const uchar* line = picture.constScanLine(y);
    for (int x = 0; x < picture.width(); ++x)
      for (int c = 0; c < 3; ++c) linear.at(x, y, c) = static_cast<float>(line[4 * x + c]) / 255.0f;
  }
  return srgbDecoded(linear);
}

QImage pixelsOf(const Image& encoded) {
  QImage image(encoded.width(), encoded.height(), QImage::Format_RGBX8888);
  for (int y = 0; y < encoded.height(); ++y) {
    uchar* line = image.scanLine(y);
    for (int x = 0; x < encoded.width(); ++x) {
      for (int c = 0; c < 3; ++c)
        line[4 * x + c] =
            static_cast<uchar>(std::lround(255.0f * std::clamp(encoded.at(x, y, c), 0.0f, 1.0f)));
      line[4 * x + 3] = 255;
    }
  }
  return image;
}

class Quiet : public ProgressSink {
 public:
  void progressed(double, std::string_view) override {}
};

}  // namespace

StillSolver::StillSolver(const MeasuredCalibration& calibration, const TargetSettings& target,
                         const ClusteringSettings& clustering, Method method)
    : calibration_(calibration),
      target_(target),
      method_(method),
      compensator_(calibration.venue, calibration.inverse, with(clustering)) {}

std::optional<RenderedFrame> StillSolver::solve(const ContentPicture& content) {
  if (content.number == number_ && !last_.drives.empty()) return last_;
  auto stop = std::make_shared<StopRequest>();
  {
    std::scoped_lock lock(guard_);
    stop_ = stop;
  }
  try {
    Stopwatch watch;
    Quiet quiet;
    Progress progress(quiet, *stop);
    Target target = fitTarget(linearOf(content.image), calibration_.venue, target_);
    Compensation compensation = compensator_.solve(method_, target, progress);
    RenderedFrame frame;
    const Rasters& projectors = calibration_.venue.transport.projectors();
    for (const Image& drive : encodedDrive(compensation.projector, projectors, calibration_.linearization))
      frame.drives.push_back(pixelsOf(drive));
    frame.clipped = compensation.clipped;
    frame.steps = compensation.iterations;
    frame.seconds = watch.seconds();
    number_ = content.number;
    last_ = frame;
    return frame;
  } catch (const Cancelled&) {
    return std::nullopt;
  }
}

void StillSolver::interrupt() {
  std::scoped_lock lock(guard_);
  if (stop_) stop_->ask(StopRequest::Kind::cancel);
}

}  // namespace relucent
