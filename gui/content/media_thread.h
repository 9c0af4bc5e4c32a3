// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QThread>
#include <memory>
#include <type_traits>

namespace relucent::gui {

/// Selects Qt's FFmpeg media back end, unless the user chose another: it needs no further packages and is the
/// same on all releases. Call before any other use of Qt Multimedia.
inline void chooseMediaBackend() {
  if (!qEnvironmentVariableIsSet("QT_MEDIA_BACKEND")) qputenv("QT_MEDIA_BACKEND", "ffmpeg");
}

/// A thread with an event loop, for objects of Qt Multimedia that outlive the call that makes them and must
/// not depend on another thread's event loop. One Media is made, used and deleted there.
template <typename Media>
class OnMediaThread {
 public:
  template <typename Make>
  explicit OnMediaThread(Make make) {
    thread_.start();
    door_.moveToThread(&thread_);
    call([&] { media_ = make(); });
  }
  ~OnMediaThread() {
    call([this] { media_.reset(); });
    thread_.quit();
    thread_.wait();
  }
  OnMediaThread(const OnMediaThread&) = delete;
  OnMediaThread& operator=(const OnMediaThread&) = delete;

  /// Runs action(Media&) on that thread and waits for it. Throws nothing.
  template <typename Action>
  void with(Action action) {
    call([&] { action(*media_); });
  }

 private:
  template <typename Action>
  void call(Action action) {
    QMetaObject::invokeMethod(&door_, action, Qt::BlockingQueuedConnection);
  }

  QThread thread_;
  QObject door_;
  std::unique_ptr<Media> media_;
};

}  // namespace relucent::gui
