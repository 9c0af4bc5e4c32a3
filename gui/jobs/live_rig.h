// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QMutex>
#include <QObject>
#include <QWaitCondition>
#include <memory>
#include <vector>

#include "linearization/ramp_preview.h"
#include "rig/watched_rig.h"

namespace relucent {

/// The last pattern of one projector and the last photograph of one camera while they are at work.
struct LivePictures {
  Image pattern;  // encoded drive
  RawFrame frame;
  CaptureRequest request;
  int photographs = 0;  // by all cameras, since the start
};

/// Observes devices while they measure, and blocks them while paused. The measuring thread writes, the
/// interface reads; seen() is emitted at most twice a second, so that the laptop's light stays constant.
class LiveRig : public QObject, public RigWatcher {
  Q_OBJECT

 public:
  /// `interval`: least time between two signals, milliseconds.
  explicit LiveRig(int interval = 500);

  void beforeShowing(std::size_t index, RigLight& light) override;
  void shown(std::size_t index, const Image& encodedDrive) override;
  void photographed(std::size_t index, const CaptureRequest& request, const RawFrame& frame) override;

  /// Least time between two patterns, milliseconds, while people may be looking. 0: none.
  void setLeastInterval(int milliseconds);

  /// Empty pictures for devices that do not exist.
  LivePictures pictures(std::size_t projector = 0, std::size_t camera = 0) const;
  /// The last photograph of a camera, not overexposed, of fully white projectors, some of which may be dark;
  /// and its number, 0: none.
  struct Floodlight {
    Image signal;
    int number = 0;
  };
  Floodlight floodlight(std::size_t camera = 0) const;
  int floodlightNumber(std::size_t camera = 0) const;
  /// Of a projector that is lit alone, in the first camera's photographs.
  std::array<std::map<double, double>, 3> ramps(std::size_t projector = 0) const;

  /// Pauses before the next pattern; the projectors show black meanwhile.
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
  struct Shown {
    Image pattern;
    bool dark = true, white = false;
    RampPreview ramps;
  };
  struct Photographed {
    RawFrame frame;
    CaptureRequest request;
    Floodlight floodlight;
  };
  bool isFloodlit() const;
  std::vector<Shown> projectors_;
  std::vector<Photographed> cameras_;
  int photographs_ = 0;
  QElapsedTimer since_;
};

}  // namespace relucent
