// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <functional>

#include "jobs/latest.h"
#include "relucent/devices/camera_registry.h"

namespace relucent::gui {

/// Looks for cameras on another thread.
class CameraFinder : public QObject {
  Q_OBJECT

 public:
  explicit CameraFinder(QObject* parent = nullptr);

  /// What was there to choose from when it was looked for, the most suitable first (camera_ranking.h).
  const devices::CameraList& cameras() const { return cameras_; }
  bool isLooking() const { return looking_.isBusy(); }
  void look();
  /// Who looks for cameras; for tests.
  void setLister(std::function<devices::CameraList()> lister) { lister_ = std::move(lister); }

 Q_SIGNALS:
  /// It begins to look for cameras, or has.
  void changed();
  void failed(const gui::Failure& failure);

 private:
  std::function<devices::CameraList()> lister_ = [] { return devices::cameraRegistry().list(); };
  devices::CameraList cameras_;
  Latest<devices::CameraList> looking_;
};

}  // namespace relucent::gui
