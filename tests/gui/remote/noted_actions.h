// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>
#include <optional>

#include "remote/remote_actions.h"

namespace relucent::gui {

/// Notes what it is told.
class NotedActions : public RemoteActions {
 public:
  RemoteState now{false, false, true, 1.0, {}, 0, 3};
  std::optional<compensation::Position> viewer;
  Message whyNoViewer;

  RemoteState state() const override { return now; }
  void setPaused(bool paused) override { now.paused = paused; }
  void setBlack(bool black) override { now.black = black; }
  void setCompensated(bool compensated) override { now.compensated = compensated; }
  void setBrightness(double brightness) override { now.brightness = brightness; }
  void setChart(std::optional<TestChart> chart) override { now.chart = chart; }
  void playItem(qsizetype index) override { now.item = index; }
  Message useSet(const QString& name) override {
    now.set = name;
    return {};
  }
  Message moveViewer(const compensation::Position& position) override {
    if (whyNoViewer.empty()) viewer = position;
    return whyNoViewer;
  }
  Message whyNoPhotographs;
  QStringList begun;
  Message check() override { return photograph("check"); }
  Message perfect() override { return photograph("perfect"); }
  Message photograph(const char* work) {
    if (whyNoPhotographs.empty()) begun.append(work);
    return whyNoPhotographs;
  }
};

}  // namespace relucent::gui
