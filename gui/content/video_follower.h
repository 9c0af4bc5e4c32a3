// SPDX-License-Identifier: MIT
#pragma once

#include <QAudioDevice>
#include <QAudioOutput>
#include <QMediaDevices>
#include <QMediaPlayer>
#include <QMutex>
#include <QTimer>
#include <QVideoSink>
#include <chrono>
#include <optional>

#include "content/content_source.h"
#include "content/frame_slot.h"

namespace relucent {

/// What a film's source and its player share, over threads.
class VideoTime {
 public:
  using Clock = std::chrono::steady_clock;
  struct Asked {
    ContentTime time{0};
    Clock::time_point when{};  // the default: never yet
  };
  void ask(ContentTime time, Clock::time_point now = Clock::now());
  Asked asked() const;

 private:
  mutable QMutex guard_;
  Asked asked_;
};

/// What the player is to do, so that it follows the time that is asked for.
struct VideoStep {
  bool play = false;
  std::optional<ContentTime> seek;
};

/// Decides it. Told every few milliseconds where things stand; no clock, no player of its own.
class VideoPursuit {
 public:
  using Clock = VideoTime::Clock;
  explicit VideoPursuit(ContentTime length) : length_(length) {}
  /// `position`: where the player says that it is. `shown`: of the newest picture, where that is known; while
  /// the time stands it is what counts.
  VideoStep next(const VideoTime::Asked& asked, ContentTime position, std::optional<ContentTime> shown,
                 Clock::time_point now);

 private:
  ContentTime length_;
  ContentTime last_{-1};
  Clock::time_point moved_{}, sought_{};  // when the time asked for last moved on; when the last jump was
  int again_ = 0;                         // jumps that were told once more
};

/// Qt's player, following. Lives on a thread with an event loop.
class VideoFollower : public QObject {
  Q_OBJECT

 public:
  /// `frames` and `time` must outlive it. Failures end up in `frames`.
  VideoFollower(const QString& file, FrameSlot& frames, VideoTime& time);
  ContentTime length() const { return std::chrono::milliseconds(player_.duration()); }

 private:
  void statusChanged(QMediaPlayer::MediaStatus status);
  void follow();
  void chooseSound();

  FrameSlot& frames_;
  VideoTime& time_;
  std::optional<VideoPursuit> pursuit_;
  QMediaDevices devices_;
  QVideoSink sink_;
  QAudioOutput sound_;
  QMediaPlayer player_;
  QTimer tick_;
};

}  // namespace relucent
