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
  int photographs = 0;  // by all cameras, since this began
};

/// Looks on while devices measure, and holds them up while paused. The measuring thread writes, the interface
/// reads; seen() comes at most twice a second, so that the laptop's own light stays even.
class LiveRig : public QObject, public RigWatcher {
  Q_OBJECT

 public:
  /// `interval`: least time between two signals, milliseconds.
  explicit LiveRig(int interval = 500);

  void beforeShowing(std::size_t index, RigLight& light) override;
  void shown(std::size_t index, const Image& encodedDrive) override;
  void photographed(std::size_t index, const CaptureRequest& request, const RawFrame& frame) override;

  /// Between two patterns, milliseconds: people may be looking. 0: none.
  void setLeastInterval(int milliseconds);

  /// Of devices that there are not, empty pictures.
  LivePictures pictures(std::size_t projector = 0, std::size_t camera = 0) const;
  /// The last photograph of a camera, not overexposed, of projectors fully white, some perhaps dark; and its
  /// number, 0: there was none.
  struct Floodlight {
    Image signal;
    int number = 0;
  };
  Floodlight floodlight(std::size_t camera = 0) const;
  int floodlightNumber(std::size_t camera = 0) const;
  /// Of a projector that shines alone, in the first camera's photographs.
  std::array<std::map<double, double>, 3> ramps(std::size_t projector = 0) const;

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
