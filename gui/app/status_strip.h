// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QTimer>

#include "theme/controls.h"
#include "wizard/session.h"

namespace relucent {

/// Projector, camera, disk, and what was saved last.
class StatusStrip : public QFrame {
  Q_OBJECT

 public:
  explicit StatusStrip(Session& session, QWidget* parent = nullptr);

 private:
  void refresh();
  Session& session_;
  QLabel *projector_, *camera_, *disk_, *saved_;
  QTimer often_;
};

}  // namespace relucent
