// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <memory>
#include <utility>

#include "output/frame_renderer.h"

namespace relucent {

/// A copy of what went to the first projector, for the operator to see.
class OutputTap {
 public:
  void put(const QImage& drive) {
    QMutexLocker lock(&guard_);
    drive_ = drive;
  }
  QImage get() const {
    QMutexLocker lock(&guard_);
    return drive_;
  }

 private:
  mutable QMutex guard_;
  QImage drive_;
};

/// A renderer that lets somebody look on.
class TappedRenderer : public FrameRenderer {
 public:
  TappedRenderer(std::unique_ptr<FrameRenderer> renderer, std::shared_ptr<OutputTap> tap)
      : renderer_(std::move(renderer)), tap_(std::move(tap)) {}
  std::vector<QSize> projectors() const override { return renderer_->projectors(); }
  Canvas canvas() const override { return renderer_->canvas(); }
  QString name() const override { return renderer_->name(); }
  void interrupt() override { renderer_->interrupt(); }
  RenderedFrame render(const ContentPicture& content, const RenderRequest& request,
                       const Outdated& outdated) override {
    RenderedFrame frame = renderer_->render(content, request, outdated);
    if (!frame.drives.empty()) tap_->put(frame.drives.front());
    return frame;
  }

 private:
  std::unique_ptr<FrameRenderer> renderer_;
  std::shared_ptr<OutputTap> tap_;
};

}  // namespace relucent
