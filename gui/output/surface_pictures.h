// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QObject>
#include <memory>
#include <vector>

#include "output/projector_window.h"

namespace relucent::gui {

/// One still picture on the screen of each projector, as long as it is wanted: to be looked at on the
/// surface, before anything plays. An unplugged screen shows its picture again when it is back.
class SurfacePictures : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;
  ~SurfacePictures() override;

  /// Contract: not shining, as many pictures as screens.
  void shine(const std::vector<ScreenIdentity>& screens, const std::vector<QImage>& pictures);
  /// Others in their place. Does nothing while they do not shine.
  void present(const std::vector<QImage>& pictures);
  void stop();
  bool isShining() const { return !windows_.empty(); }
  /// A screen of theirs is not there now.
  bool isScreenMissing() const;

 Q_SIGNALS:
  /// Shines, no longer shines, or a screen has gone or is back.
  void changed();

 private:
  std::vector<std::unique_ptr<ProjectorWindow>> windows_;
};

}  // namespace relucent::gui
