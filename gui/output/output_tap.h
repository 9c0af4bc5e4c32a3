// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "output/frame_renderer.h"

namespace relucent::gui {

/// A copy of what went to the projectors, for the operator to see.
class OutputTap {
 public:
  void put(const std::vector<DrivePicture>& drives) {
    QMutexLocker lock(&guard_);
    drives_ = drives;
  }
  /// Null where there is none.
  DrivePicture get(std::size_t projector) const {
    QMutexLocker lock(&guard_);
    return projector < drives_.size() ? drives_[projector] : DrivePicture();
  }

 private:
  mutable QMutex guard_;
  std::vector<DrivePicture> drives_;
};

/// A renderer that lets somebody look on.
class TappedRenderer : public FrameRenderer {
 public:
  /// `look`: at every frame, on the rendering thread.
  using Look = std::function<void(const std::vector<DrivePicture>&)>;
  TappedRenderer(std::unique_ptr<FrameRenderer> renderer, Look look)
      : renderer_(std::move(renderer)), look_(std::move(look)) {}
  std::vector<QSize> projectors() const override { return renderer_->projectors(); }
  Canvas canvas() const override { return renderer_->canvas(); }
  QString name() const override { return renderer_->name(); }
  std::vector<compensation::Position> cameras() const override { return renderer_->cameras(); }
  std::shared_ptr<PreparedSet> prepare(const std::string& set) override { return renderer_->prepare(set); }
  void interrupt() override { renderer_->interrupt(); }
  RenderedFrame render(const ContentPicture& content, const RenderRequest& request,
                       const Outdated& outdated) override {
    RenderedFrame frame = renderer_->render(content, request, outdated);
    if (!frame.drives.empty()) look_(frame.drives);
    return frame;
  }

 private:
  std::unique_ptr<FrameRenderer> renderer_;
  Look look_;
};

}  // namespace relucent::gui
