// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <QVideoFrame>
#include <QWaitCondition>

#include "content/content_source.h"

namespace relucent {

/// Where a decoder or a camera leaves its newest frame, and whoever shows it takes it: any thread, never
/// waiting for each other. What nobody takes is never converted.
class FrameSlot {
 public:
  void put(const QVideoFrame& frame);
  /// Frames are JPEG pictures, see pictureOf().
  void tellJpeg();
  /// The reason why no frame will ever come.
  void fail(const QString& reason);
  /// Waits for a first frame, or a reason why there is none. Whether there is a frame.
  bool waitForFirst(int milliseconds);
  QString failure() const;

  struct Newest {
    QVideoFrame frame;
    std::uint64_t number = 0;  // 0: none yet
    bool jpeg = false;
  };
  Newest newest() const;

 private:
  mutable QMutex guard_;
  QWaitCondition came_;
  Newest newest_;
  QString failure_;
};

}  // namespace relucent
