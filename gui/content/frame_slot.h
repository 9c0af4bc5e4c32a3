// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <QVideoFrame>
#include <QWaitCondition>
#include <chrono>

#include "content/content_source.h"

namespace relucent::gui {

/// Passes the newest frame from a decoder or camera to its consumer, on any threads, without waiting for each
/// other. Frames that are not taken are not converted.
class FrameSlot {
 public:
  void put(const QVideoFrame& frame);
  /// Frames are JPEG pictures, see pictureOf().
  void markAsJpeg();
  /// The reason why no frame will arrive.
  void fail(const QString& reason);
  /// Waits for a first frame or a failure. Returns whether there is a frame.
  bool waitForFirst(int milliseconds);
  QString failure() const;

  struct Newest {
    QVideoFrame frame;
    std::uint64_t number = 0;  // 0: none yet
    bool jpeg = false;
    std::chrono::steady_clock::time_point arrived{};  // when it was put here
  };
  Newest newest() const;

 private:
  mutable QMutex guard_;
  QWaitCondition came_;
  Newest newest_;
  QString failure_;
};

}  // namespace relucent::gui
