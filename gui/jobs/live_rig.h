// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QMutex>
#include <QObject>
#include <QWaitCondition>
#include <memory>

#include "linearization/ramp_preview.h"
#include "rig/watched_rig.h"

namespace relucent {

/// The last pattern and photograph of devices that are at work.
struct LivePictures {
  Image pattern;  // encoded drive
  RawFrame frame;
  CaptureRequest request;
  int photographs = 0;  // taken since this began
};

/// Looks on while devices measure, and holds them up while paused. The measuring thread writes, the interface
/// reads; seen() comes at most twice a second, so that the laptop's own light stays even.
class LiveRig : public QObject, public RigWatcher {
  Q_OBJECT

 public:
  /// `interval`: least time between two signals, milliseconds.
  explicit LiveRig(int interval = 500);

  void beforeShowing(std::size_t index, Projector& projector) override;
  void shown(std::size_t index, const Image& encodedDrive) override;
  void photographed(std::size_t index, const CaptureRequest& request, const RawFrame& frame) override;

  /// Between two patterns, milliseconds: people may be looking. 0: none.
  void setLeastInterval(int milliseconds);

  LivePictures pictures() const;
  std::array<std::map<double, double>, 3> ramps() const;

  /// Before the next pattern; the projectors are black meanwhile.
  void pause();
  void resume();
  bool isPaused() const;

 Q_SIGNALS:
  void seen();

 private:
  int interval_;
  int leastBetween_ = 0;
  QElapsedTimer shownLast_;
  mutable QMutex guard_;
  QWaitCondition resumed_;
  bool paused_ = false;
  LivePictures pictures_;
  RampPreview ramps_;
  QElapsedTimer since_;
};

}  // namespace relucent
