// SPDX-License-Identifier: MIT
#include "content/live_screen.h"

#include <QStringList>
#include <optional>
#include <utility>

#include "content/still_image.h"
#include "desktop/screen_capture.h"
#include "relucent/base/error.h"

namespace relucent::gui {

/// One screen or window, found.
class LiveScreen::Grabber {
 public:
  Grabber(What what, QString which) : which_(std::move(which)) {
    if (!desktop_.isConnected())
      throw Error(ErrorKind::device,
                  RELUCENT_MESSAGE("content.no-x-server",
                                   "the live picture of a screen needs an X server, and none answers"),
                  RELUCENT_MESSAGE("content.log-in-to-xorg", "log in to a desktop, or play files"));
    what == What::screen ? findScreen() : findWindow();
  }

  QImage grab() const { return window_ ? desktop_.ofWindow(*window_) : desktop_.ofScreen(which_); }

 private:
  void findScreen() {
    QStringList names;
    for (const ScreenCapture::Screen& screen : desktop_.screens()) {
      if (screen.name == which_) return;
      if (!screen.place.isEmpty()) names.append(screen.name);
    }
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("content.unknown-screen", "there is no screen '{}'")
                    .with(which_.toStdString()),
                RELUCENT_ENGLISH_MESSAGE("content.choose-one", "choose one of {}")
                    .with(names.join(", ").toStdString()));
  }

  void findWindow() {
    bool isNumber = false;
    const quint32 number = which_.toUInt(&isNumber, 0);
    QStringList titles;
    for (const ScreenCapture::Window& window : desktop_.windows()) {
      if (isNumber ? window.number == number : window.title.contains(which_, Qt::CaseInsensitive)) {
        window_ = window.number;
        return;
      }
      titles.append(window.title);
    }
    throw Error(
        ErrorKind::input,
        RELUCENT_MESSAGE("content.unknown-window", "there is no window '{}'").with(which_.toStdString()),
        titles.isEmpty() ? RELUCENT_MESSAGE("content.open-first", "open it first")
                         : RELUCENT_MESSAGE("content.open-first-or-choose", "open it first; there are: {}")
                               .with(titles.join(", ").toStdString()));
  }

  ScreenCapture desktop_;
  QString which_;
  std::optional<quint32> window_;
};

LiveScreen::LiveScreen(What what, const QString& which, const Canvas& canvas)
    : grabber_(std::make_unique<Grabber>(what, which)), canvas_(canvas) {}

LiveScreen::~LiveScreen() = default;

ContentPicture LiveScreen::newest() {
  const auto arrived = std::chrono::steady_clock::now();
  QImage now = grabber_->grab();
  // What has not changed need not be computed again.
  if (!now.isNull() && now != grabbed_) {
    grabbed_ = std::move(now);
    picture_ = {onCanvas(grabbed_, canvas_), nextFrameNumber()};
    picture_.arrived = arrived;
  }
  if (picture_.image.isNull()) picture_ = {blackOn(canvas_), nextFrameNumber()};
  return picture_;
}

}  // namespace relucent::gui
