// SPDX-License-Identifier: MIT
#include "content/live_camera.h"

#include <QCamera>
#include <QCameraDevice>
#include <QMediaCaptureSession>
#include <QMediaDevices>
#include <QStringList>
#include <QVideoSink>

#include "content/frame_slot.h"
#include "content/media_thread.h"
#include "content/video_frame.h"
#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr int cameraPatience = 15'000;  // milliseconds for a first picture

}  // namespace

struct LiveCamera::Session {
  /// A device that is open. Lives on a thread with an event loop.
  class Capture {
   public:
    Capture(const QString& which, FrameSlot& frames) {
      QStringList names;
      for (const QCameraDevice& device : QMediaDevices::videoInputs()) {
        names.append(device.description());
        if (!device.description().contains(which, Qt::CaseInsensitive) && device.id() != which.toUtf8())
          continue;
        open(device, frames);
        return;
      }
      frames.fail(names.isEmpty()
                      ? QString("there is no capture device")
                      : QString("there is no capture device '%1', but %2").arg(which, names.join(", ")));
    }

   private:
    void open(const QCameraDevice& device, FrameSlot& frames) {
      camera_ = std::make_unique<QCamera>(device);
      QObject::connect(&sink_, &QVideoSink::videoFrameChanged,
                       [&frames](const QVideoFrame& frame) { frames.put(frame); });
      QObject::connect(camera_.get(), &QCamera::errorOccurred,
                       [&frames](QCamera::Error, const QString& reason) { frames.fail(reason); });
      session_.setVideoSink(&sink_);
      session_.setCamera(camera_.get());
      camera_->start();
    }

    QVideoSink sink_;
    std::unique_ptr<QCamera> camera_;
    QMediaCaptureSession session_;
  };

  explicit Session(const QString& which)
      : capture([&] { return std::make_unique<Capture>(which, frames); }) {}
  FrameSlot frames;
  OnMediaThread<Capture> capture;  // uses it, goes first
};

LiveCamera::LiveCamera(const QString& which, const Canvas& canvas) : canvas_(canvas) {
  chooseMediaBackend();
  session_ = std::make_unique<Session>(which);
  if (!session_->frames.waitForFirst(cameraPatience)) {
    QString reason = session_->frames.failure();
    throw Error(ErrorKind::device,
                reason.isEmpty()
                    ? RELUCENT_MESSAGE("content.nothing-captured", "the capture device gives no picture")
                    : Message::plain(reason.toStdString()),
                RELUCENT_MESSAGE("content.connect-capture-device",
                                 "plug it in, close other programs that use it, and try again"));
  }
  LiveCamera::newest();  // what cannot be shown is refused now
}

LiveCamera::~LiveCamera() = default;

ContentPicture LiveCamera::newest() {
  const FrameSlot::Newest frame = session_->frames.newest();
  if (frame.number != picture_.number) {
    picture_ = {onCanvas(pictureOf(frame.frame), canvas_), frame.number};
    picture_.arrived = frame.arrived;
  }
  return picture_;
}

}  // namespace relucent::gui
