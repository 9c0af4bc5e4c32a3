// SPDX-License-Identifier: MIT
#include "output/still_solver.h"

#include "relucent/base/message.h"
#include "relucent/image/colour.h"

namespace relucent::gui {
namespace {

compensation::CompensatorSettings with(const clustering::ClusteringSettings& clustering) {
  compensation::CompensatorSettings settings;
  settings.clustering = clustering;
  return settings;
}

image::Image linearOf(const QImage& picture) {
  image::Image linear(Size{picture.width(), picture.height()}, 3);
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
  return image::srgbDecoded(linear);
}

/// Stops what is outdated. As progress is reported, so that work is looked at between its steps.
class Watch : public ProgressSink {
 public:
  Watch(const Outdated& outdated, StopRequest& stop) : outdated_(outdated), stop_(stop) {}
  void progressed(double, const Message&) override {
    if (outdated_ && outdated_()) stop_.ask(StopRequest::Kind::cancel);
  }

 private:
  const Outdated& outdated_;
  StopRequest& stop_;
};

}  // namespace

StillSolver::StillSolver(const pipeline::MeasuredCalibration& calibration,
                         const compensation::TargetSettings& target,
                         const clustering::ClusteringSettings& clustering, compensation::Method method)
    : calibration_(calibration),
      target_(target),
      method_(method),
      compensator_(calibration.venue, calibration.inverse, with(clustering)) {}

const compensation::Compensation* StillSolver::solve(const ContentPicture& content, const Outdated& outdated,
                                                     const std::vector<double>& viewWeights) {
  if (content.number == number_ && viewWeights == viewWeights_ && !last_.projector.empty()) return &last_;
  auto stop = std::make_shared<StopRequest>();
  {
    std::scoped_lock lock(guard_);
    stop_ = stop;
  }
  try {
    Watch watch(outdated, *stop);
    Progress progress(watch, *stop);
    compensation::TargetSettings settings = target_;
    if (!viewWeights.empty()) {
      settings.views.resize(viewWeights.size());
      settings.viewer.reset();  // weighed already
    }
    for (std::size_t view = 0; view < viewWeights.size(); ++view)
      settings.views[view].weight = viewWeights[view];
    compensation::Target target = fitTarget(linearOf(content.image), calibration_.venue, settings);
    last_ = compensator_.solve(method_, target, progress);
    number_ = content.number;
    viewWeights_ = viewWeights;
    return &last_;
  } catch (const Cancelled&) {
    return nullptr;
  }
}

void StillSolver::interrupt() {
  std::scoped_lock lock(guard_);
  if (stop_) stop_->ask(StopRequest::Kind::cancel);
}

}  // namespace relucent::gui
