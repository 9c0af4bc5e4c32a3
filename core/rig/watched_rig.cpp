// SPDX-License-Identifier: MIT
#include "relucent/rig/watched_rig.h"

#include <utility>
#include <vector>

#include "relucent/base/error.h"

namespace relucent::rig {
namespace {

/// The projectors themselves, and what each of several shows: one alone is shown its pattern next anyway.
class Projectors {
 public:
  explicit Projectors(std::vector<std::unique_ptr<Projector>> projectors)
      : projectors_(std::move(projectors)), shown_(projectors_.size()) {}

  Projector& at(std::size_t index) const { return *projectors_[index]; }
  void show(std::size_t index, const image::Image& encodedDrive) {
    projectors_[index]->show(encodedDrive);
    if (projectors_.size() > 1) shown_[index] = encodedDrive;
  }
  void darken() const {
    for (const auto& projector : projectors_) projector->show(image::Image(projector->size(), 3, 0.0f));
  }
  void restoreAllExcept(std::size_t coming) const {
    for (std::size_t i = 0; i < projectors_.size(); ++i)
      if (i != coming && !shown_[i].empty()) projectors_[i]->show(shown_[i]);
  }

 private:
  std::vector<std::unique_ptr<Projector>> projectors_;
  std::vector<image::Image> shown_;
};

class PreviousLight : public RigLight {
 public:
  PreviousLight(const Projectors& projectors, std::size_t coming)
      : projectors_(projectors), coming_(coming) {}
  void darken() override { projectors_.darken(); }
  void restore() override { projectors_.restoreAllExcept(coming_); }

 private:
  const Projectors& projectors_;
  std::size_t coming_;
};

class WatchedProjector : public Projector {
 public:
  WatchedProjector(std::shared_ptr<Projectors> projectors, std::size_t index,
                   std::shared_ptr<RigWatcher> watcher)
      : projectors_(std::move(projectors)), index_(index), watcher_(std::move(watcher)) {}

  std::string name() const override { return projectors_->at(index_).name(); }
  Size size() const override { return projectors_->at(index_).size(); }
  int bits() const override { return projectors_->at(index_).bits(); }
  void show(const image::Image& encodedDrive) override {
    PreviousLight light(*projectors_, index_);
    watcher_->beforeShowing(index_, light);
    projectors_->show(index_, encodedDrive);
    watcher_->shown(index_, encodedDrive);
  }

 private:
  std::shared_ptr<Projectors> projectors_;
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
    RawFrame frame = taken(request);
    watcher_->photographed(index_, request, frame);
    return frame;
  }

 private:
  RawFrame taken(const CaptureRequest& request) {
    struct Told {
      WatchedCamera& camera;
      ~Told() { camera.watcher_->afterPhotographing(camera.index_); }
    };
    watcher_->beforePhotographing(index_, request);
    Told told{*this};
    return camera_->capture(request);
  }

  std::unique_ptr<Camera> camera_;
  std::size_t index_;
  std::shared_ptr<RigWatcher> watcher_;
};

}  // namespace

Rig watched(Rig rig, const std::shared_ptr<RigWatcher>& watcher) {
  require(watcher != nullptr, "somebody has to watch");
  std::size_t count = rig.projectors.size();
  auto projectors = std::make_shared<Projectors>(std::exchange(rig.projectors, {}));
  for (std::size_t i = 0; i < count; ++i)
    rig.projectors.push_back(std::make_unique<WatchedProjector>(projectors, i, watcher));
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    rig.cameras[i] = std::make_unique<WatchedCamera>(std::move(rig.cameras[i]), i, watcher);
  return rig;
}

}  // namespace relucent::rig
