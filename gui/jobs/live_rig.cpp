// SPDX-License-Identifier: MIT
#include "jobs/live_rig.h"

namespace relucent {

LiveRig::LiveRig(int interval) : interval_(interval) {}

void LiveRig::beforeShowing(std::size_t, Projector& projector) {
  QMutexLocker lock(&guard_);
  if (paused_) {
    projector.show(Image(projector.size(), 3, 0.0f));
    while (paused_) resumed_.wait(&guard_);
  }
  // Resuming ends no wait but a pause.
  auto left = [&] { return shownLast_.isValid() ? leastBetween_ - shownLast_.elapsed() : 0; };
  for (qint64 wait = left(); wait > 0; wait = left())
    resumed_.wait(&guard_, static_cast<unsigned long>(wait));
  shownLast_.start();
}

void LiveRig::setLeastInterval(int milliseconds) {
  QMutexLocker lock(&guard_);
  leastBetween_ = milliseconds;
}

void LiveRig::shown(std::size_t index, const Image& encodedDrive) {
  QMutexLocker lock(&guard_);
  if (index == 0) pictures_.pattern = encodedDrive;
}

void LiveRig::photographed(std::size_t index, const CaptureRequest& request, const RawFrame& frame) {
  {
    QMutexLocker lock(&guard_);
    ++pictures_.photographs;
    if (index != 0) return;
    pictures_.frame = frame;
    pictures_.request = request;
    ramps_.add(pictures_.pattern, frame);
    if (since_.isValid() && since_.elapsed() < interval_) return;
    since_.start();
  }
  Q_EMIT seen();
}

LivePictures LiveRig::pictures() const {
  QMutexLocker lock(&guard_);
  return pictures_;
}

std::array<std::map<double, double>, 3> LiveRig::ramps() const {
  QMutexLocker lock(&guard_);
  return ramps_.curves();
}

void LiveRig::pause() {
  QMutexLocker lock(&guard_);
  paused_ = true;
}

void LiveRig::resume() {
  QMutexLocker lock(&guard_);
  paused_ = false;
  resumed_.wakeAll();
}

bool LiveRig::isPaused() const {
  QMutexLocker lock(&guard_);
  return paused_;
}

}  // namespace relucent
