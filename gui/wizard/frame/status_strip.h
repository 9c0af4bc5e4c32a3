// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QTimer>

#include "theme/controls.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Projector, camera, disk, the room's light once it is known, and the last saved state.
class StatusStrip : public QFrame {
  Q_OBJECT

 public:
  explicit StatusStrip(Session& session, QWidget* parent = nullptr);

 private:
  void refresh();
  QString projectorText() const;
  void showRoomLight();
  Session& session_;
  QLabel *projector_, *camera_, *disk_, *saved_;
  QWidget* room_;
  QLabel* roomLight_;
  QTimer often_;
};

}  // namespace relucent::gui
