// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <optional>

#include "content/test_chart.h"
#include "relucent/base/message.h"
#include "relucent/compensation/viewer.h"

namespace relucent::gui {

/// What can be controlled from outside.
struct RemoteState {
  bool paused = false, black = false, compensated = true;
  double brightness = 1.0;
  std::optional<TestChart> chart;
  qsizetype item = -1;  // that plays, from 0; -1 before the first
  qsizetype items = 0;  // of the playlist
  QString set{};        // of the calibration that it is shown by; empty: it has no name
};

/// What carries out the commands of a remote control. Those that cannot be carried out say why, empty: done.
class RemoteActions {
 public:
  virtual ~RemoteActions() = default;
  virtual RemoteState state() const = 0;

  virtual void setPaused(bool paused) = 0;
  virtual void setBlack(bool black) = 0;
  virtual void setCompensated(bool compensated) = 0;
  /// Relative to the calibration's.
  virtual void setBrightness(double brightness) = 0;
  virtual void setChart(std::optional<TestChart> chart) = 0;
  /// Item `index`, from 0, which exists.
  virtual void playItem(qsizetype index) = 0;
  /// Begins it: the picture goes on as it is until that set is prepared.
  virtual Message useSet(const QString& name) = 0;
  virtual Message moveViewer(const compensation::Position& position) = 0;
  /// Begin what takes minutes; RemoteControl::announce() tells how it goes.
  virtual Message check() = 0;
  virtual Message perfect() = 0;
};

}  // namespace relucent::gui
