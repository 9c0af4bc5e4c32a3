// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QFrame>
#include <QTimer>
#include <vector>

#include "theme/controls.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Projector, camera, disk, the room's light once it is known, and the last saved state. Where the window is
/// narrow, icons stand for names.
class StatusStrip : public QFrame {
  Q_OBJECT

 public:
  explicit StatusStrip(Session& session, QWidget* parent = nullptr);
  /// For some seconds, in place of the last saved state.
  void say(const QString& sentence);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  QString projectorText() const;
  void showDisk(const QString& folder);
  bool isScreenThere() const;
  void showRoomLight();
  Session& session_;
  ElidedLabel *projector_, *camera_, *disk_, *saved_;
  QWidget* room_;
  ElidedLabel* roomLight_;
  std::vector<QLabel*> names_;
  int photographs_ = 0;
  QDateTime lastPhotograph_;
  QTimer often_, said_;
};

}  // namespace relucent::gui
