// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QMutex>
#include <QObject>
#include <QWaitCondition>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/dark_photographs.h"
#include "relucent/linearization/ramp_preview.h"
#include "relucent/rig/watched_rig.h"

namespace relucent::gui {

/// The last pattern of one projector and the last photograph of one camera while they are at work.
struct LivePictures {
  image::Image pattern;  // encoded drive
  rig::RawFrame frame;
  rig::CaptureRequest request;
  int photographs = 0;  // by all cameras, since the start
};

/// Observes devices while they measure, and blocks them while paused. The measuring thread writes, the
/// interface reads; seen() is emitted at most twice a second, so that the laptop's light stays constant.
class LiveRig : public QObject, public rig::RigWatcher {
  Q_OBJECT

 public:
  /// `interval`: least time between two signals, milliseconds.
  explicit LiveRig(int interval = 500);

  void beforeShowing(std::size_t index, rig::RigLight& light) override;
  void shown(std::size_t index, const image::Image& encodedDrive) override;
  void beforePhotographing(std::size_t index, const rig::CaptureRequest& request) override;
  void afterPhotographing(std::size_t index) noexcept override;
  void photographed(std::size_t index, const rig::CaptureRequest& request,
                    const rig::RawFrame& frame) override;

  using Clock = std::chrono::steady_clock;
  /// A photograph is overdue: by three seconds beyond its exposure, and by twice as long as photographs
  /// before took to arrive, as still cameras need some: the second slowest of the last ones, so that one that
  /// was held up does not count.
  /// The first camera of which one is; none: no photograph is.
  std::optional<std::size_t> silentCamera() const;
  std::optional<std::size_t> silentCamera(Clock::time_point now) const;
  /// Photographs under way wait for another device: from now on for the camera again.
  void waitAnew();
  /// By all cameras, since the start.
  int photographs() const;
  /// Photographs of one stage, and the number of the last one's shot: others may look through the cameras
  /// while it waits.
  struct Taken {
    int photographs = 0, lastShot = -1;
  };
  Taken taken(const std::string& stage) const;

  /// Least time between two patterns, milliseconds, while people may be looking. 0: none.
  void setLeastInterval(int milliseconds);

  /// Empty pictures for devices that do not exist.
  LivePictures pictures(std::size_t projector = 0, std::size_t camera = 0) const;
  /// The last photograph of a camera, not overexposed, of fully white projectors, some of which may be dark;
  /// and its number, 0: none. Where all of them are overexposed, one that is so in the smallest share.
  struct Floodlight {
    image::Image signal;
    int number = 0;
    double clipped = 0.0;  // share of its samples
  };
  Floodlight floodlight(std::size_t camera = 0) const;
  int floodlightNumber(std::size_t camera = 0) const;
  /// As the first camera's photographs show them.
  std::array<std::map<double, double>, 3> ramps(std::size_t projector = 0) const;
  /// The last photographs show next to nothing of what is projected.
  bool isDark() const;
  /// Ramps are measured anew: what photographs from before show is of another time.
  void forgetRamps();

  /// Pauses before the next pattern; the projectors show black meanwhile.
  void pause();
  void resume();
  bool isPaused() const;
  /// For how long it has been paused, in all, as far as measuring had come to a pattern by then.
  Clock::duration paused() const;
  /// What the time is; for tests.
  void setClock(std::function<Clock::time_point()> now);

 Q_SIGNALS:
  void seen();

 private:
  int interval_;
  int leastBetween_ = 0;
  QElapsedTimer shownLast_;
  mutable QMutex guard_;
  QWaitCondition resumed_;
  bool paused_ = false;
  Clock::duration pauses_{};  // that are over
  std::optional<Clock::time_point> pausedSince_;
  std::function<Clock::time_point()> now_ = [] { return Clock::now(); };
  struct Shown {
    bool dark = true, white = false;
  };
  struct Photographed {
    rig::RawFrame frame;
    rig::CaptureRequest request;
    Floodlight floodlight;
  };
  void pauseInTheDark(rig::RigLight& light, QMutexLocker<QMutex>& lock);
  bool isFloodlit() const;
  Clock::duration usualArrival() const;
  std::vector<Shown> projectors_;
  std::vector<image::Image> patterns_;  // of the projectors
  std::vector<Photographed> cameras_;
  struct Asked {
    Clock::time_point when;
    Clock::duration exposure{};
  };
  std::vector<std::optional<Asked>> asked_;  // of the cameras, for a photograph that is on its way
  Clock::duration arrived_{};                // the last one, beyond its exposure
  std::deque<Clock::duration> arrivals_;     // of the last photographs
  std::map<std::string, Taken> taken_;       // by stage
  linearization::RampPreview ramps_;
  DarkPhotographs dark_;
  int photographs_ = 0;
  QElapsedTimer since_;
};

}  // namespace relucent::gui
