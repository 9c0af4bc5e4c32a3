// SPDX-License-Identifier: MIT
#include "rig/watched_rig.h"

#include "base/error.h"

namespace relucent {
namespace {

class WatchedProjector : public Projector {
 public:
  WatchedProjector(std::unique_ptr<Projector> projector, std::size_t index,
                   std::shared_ptr<RigWatcher> watcher)
      : projector_(std::move(projector)), index_(index), watcher_(std::move(watcher)) {}

  std::string name() const override { return projector_->name(); }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const Image& encodedDrive) override {
    watcher_->beforeShowing(index_, *projector_);
    projector_->show(encodedDrive);
    watcher_->shown(index_, encodedDrive);
  }

 private:
  std::unique_ptr<Projector> projector_;
  std::size_t index_;
  std::shared_ptr<RigWatcher> watcher_;
};

class WatchedCamera : public Camera {
 public:
  WatchedCamera(std::unique_ptr<Camera> camera, std::size_t index, std::shared_ptr<RigWatcher> watcher)
      : camera_(std::move(camera)), index_(index), watcher_(std::move(watcher)) {}

  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  ExposureRange exposures() const override { return camera_->exposures(); }
  RawFrame capture(const CaptureRequest& request) override {
    RawFrame frame = camera_->capture(request);
    watcher_->photographed(index_, request, frame);
    return frame;
  }

 private:
  std::unique_ptr<Camera> camera_;
  std::size_t index_;
  std::shared_ptr<RigWatcher> watcher_;
};

}  // namespace

Rig watched(Rig rig, std::shared_ptr<RigWatcher> watcher) {
  require(watcher != nullptr, "somebody has to watch");
  for (std::size_t i = 0; i < rig.projectors.size(); ++i)
    rig.projectors[i] = std::make_unique<WatchedProjector>(std::move(rig.projectors[i]), i, watcher);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    rig.cameras[i] = std::make_unique<WatchedCamera>(std::move(rig.cameras[i]), i, watcher);
  return rig;
}

}  // namespace relucent
