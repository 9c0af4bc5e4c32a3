// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QFutureWatcher>
#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/outcome.h"
#include "output/content_clock.h"
#include "output/frame_renderer.h"
#include "output/overlay.h"
#include "output/player_statistics.h"
#include "output/projector_window.h"
#include "relucent/base/message.h"

namespace relucent::gui {

/// Plays content on all projectors under one clock. A frame is computed on another thread while the previous
/// one is shown. A still picture is computed once in time, once more as well as possible, and then not again.
class Player : public QObject {
  Q_OBJECT

 public:
  /// `windows`: one a projector, in the renderer's order; they must outlive the player.
  Player(std::unique_ptr<FrameRenderer> renderer, std::shared_ptr<ContentSource> content,
         std::vector<ProjectorWindow*> windows, ContentClock clock = ContentClock(),
         QObject* parent = nullptr);
  ~Player() override;

  void start();
  /// Shows black and computes nothing.
  void stop();

  bool isPlaying() const { return playing_; }
  const ContentClock& clock() const { return clock_; }
  PlayerStatistics statistics() const;

  /// Freezes picture and clock.
  void setFrozen(bool frozen);
  /// Shows black; the clock continues.
  void setBlack(bool black);
  void setCompensated(bool compensated);
  /// Shows figures over the picture, updated twice a second.
  void setOverlay(bool shown);
  /// Of white, relative to the calibration's.
  void setBrightness(double brightness);
  /// The picture is for a viewer at this place, until he has not been heard of for two seconds; then it
  /// becomes again what it was without him. Whether it can be: the places of all cameras are known, and this
  /// one is finite.
  bool moveViewer(const compensation::Position& position);
  /// What somebody leaves of the projectors' light, from the next frame on; nullptr: all.
  void setAvailable(std::shared_ptr<const engine::Availability> available);
  /// Other content from the next frame on, of the renderer's canvas.
  void setContent(std::shared_ptr<ContentSource> content);
  /// What the calibration keeps of the picture that stands is looked for again: it may have been perfected.
  void renew();
  /// Prepares another set of the calibration beside the frames, and shows content by it from the next frame
  /// on once it is prepared; until then as before, so that no frame is dark or missing. Empty: the one in
  /// use. A later wish takes the place of one that is not fulfilled yet.
  void useSet(const std::string& name);
  /// Prepares it, so that useSet() need not wait. One at a time.
  void prepareSet(const std::string& name);
  /// By which frames are computed from now on; of the renderer's first one, as it was opened: empty.
  std::optional<std::string> set() const;
  /// A test chart instead of the content; none: the content, which has continued meanwhile.
  void setChart(std::optional<TestChart> chart);
  bool isFrozen() const { return clock_.isPaused(); }
  bool isBlack() const { return black_; }
  bool isCompensated() const { return request_.compensated; }
  double brightness() const { return request_.brightness; }
  /// For whom the picture is now; none: no viewer has been heard of lately.
  std::optional<FrameViewer> viewer() const;
  bool canFollowViewers() const { return !cameras_.empty(); }
  /// Where all cameras stand; empty: not known.
  const std::vector<compensation::Position>& cameras() const { return cameras_; }
  bool hasOverlay() const { return overlayed_.isActive(); }
  std::optional<TestChart> chart() const { return chart_; }

  /// Handles a key pressed at a projector's window or the operator's view: C compensation on and off, space
  /// freeze, B black, T the next test chart and after the last one the content, O overlay; where the cameras'
  /// places are known, the arrow keys and page up and down walk along the axes x, y and z, a twentieth of the
  /// widest distance of two cameras each, and Home ends it; the mouse, dragged on a projector's window, walks
  /// along x and y by that distance from edge to edge. Returns whether the key is used.
  bool handleKey(int key);

 Q_SIGNALS:
  /// A new picture was passed to the windows.
  void shown();
  /// The first frame of another set was passed to the windows.
  void setShown(const std::string& name, const std::string& shownFrom);
  /// A set cannot be had: all goes on as before.
  void setFailed(const std::string& name, const relucent::Message& sentence);
  /// Rendering or reading failed permanently; the windows are black. `sentence` is for display.
  void failed(const relucent::Message& sentence);

 private:
  struct Frame {
    std::uint64_t content = 0;
    ContentTime since{0};  // that the content stands
    RenderRequest request;
    RenderedFrame rendered;
    std::optional<std::chrono::steady_clock::time_point> arrived{};  // of a live picture
  };
  /// A frame passed to the windows.
  struct Shown {
    ContentTime when{0};  // on a clock that never pauses
    double seconds = 0.0;
    std::uint64_t content = 0;
    double viewerSeconds = 0.0;  // since the first move that it follows; 0: nobody has moved
    double liveSeconds = 0.0;    // since it arrived; 0: it is no new live picture
  };

  void next();
  void beginFrame();
  void frameReady();
  void present();
  void nextChart();
  void goOnWithSets();
  void setPrepared();
  /// By so many of the cameras' widest distances along the axes.
  bool walk(const compensation::Position& by);
  compensation::MovingViewer::Time viewerTime() const { return clock_.now().time_since_epoch(); }

  std::shared_ptr<FrameRenderer> renderer_;
  std::shared_ptr<ContentSource> content_;
  std::vector<ProjectorWindow*> windows_;
  ContentClock clock_;
  RenderRequest request_;
  bool playing_ = false, black_ = false;
  std::optional<TestChart> chart_;
  std::shared_ptr<ContentSource> chartContent_;

  QTimer pace_, overlayed_;
  QFutureWatcher<Outcome<Frame>> working_;
  QElapsedTimer begun_;
  Frame last_;
  std::deque<Shown> recent_;
  QElapsedTimer running_;
  std::uint64_t frames_ = 0, late_ = 0;
  std::vector<compensation::Position> cameras_;
  compensation::MovingViewer viewer_;
  std::optional<std::string> wantedSet_, laterSet_;  // to be shown; to be prepared only
  std::string preparingSet_;
  std::shared_ptr<PreparedSet> preparedSet_;  // and not shown yet
  QThreadPool preparers_;                     // of its own: it takes seconds, and frames need Qt's
  // Out of which it is taken: the future would keep it.
  QFutureWatcher<Outcome<std::shared_ptr<std::shared_ptr<PreparedSet>>>> preparing_;
  // When he moved first since a frame was begun, and since the one before that: what is computed follows it.
  std::optional<ContentTime> moved_, following_;
};

}  // namespace relucent::gui
