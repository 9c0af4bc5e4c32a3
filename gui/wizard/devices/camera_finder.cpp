// SPDX-License-Identifier: MIT
#include "wizard/devices/camera_finder.h"

#include "wizard/devices/camera_ranking.h"

namespace relucent::gui {

CameraFinder::CameraFinder(QObject* parent)
    : QObject(parent),
      looking_(
          [this](devices::CameraList found) {
            cameras_ = std::move(found);
            rank(cameras_.cameras);
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            Q_EMIT failed(failure);
            Q_EMIT changed();
          }) {}

void CameraFinder::look() {
  if (isLooking()) return;
  looking_.ask(lister_);
  Q_EMIT changed();
}

}  // namespace relucent::gui
