// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QString>
#include <chrono>
#include <memory>

#include "desktop/screen_cast_wish.h"

namespace relucent::gui {

/// The picture of a screen or window under Wayland, where the desktop gives it, and not the application takes
/// it: what is shown is chosen in the desktop's dialog or by the token of an earlier choice, the pictures
/// come from PipeWire by memory, sRGB, without the pointer. All calls block, and belong to one thread.
/// Source: XDG Desktop Portal, org.freedesktop.portal.ScreenCast, version 4 (before: without tokens).
class ScreenCast {
 public:
  /// Throws: NotChosen if it was refused, or not answered in time; Error{device} without portal, windows to
  /// choose from, or PipeWire, and if one of them fails; Cancelled once it is unwanted.
  ScreenCast(const ScreenCastWish& wish, const ScreenCastVisitor& visitor);
  ~ScreenCast();
  ScreenCast(const ScreenCast&) = delete;
  ScreenCast& operator=(const ScreenCast&) = delete;

  /// For the next time; empty: this desktop remembers nothing.
  const QString& token() const;

  struct Picture {
    QImage image;  // Format_RGBX8888, opaque
    std::chrono::steady_clock::time_point arrived{};
  };
  /// The newest picture, as soon as there is another one. A desktop that stands sends none.
  /// Throws: Error{device} if it ends, or nothing brings any; Error{format} if what comes is no picture that
  /// can be shown; Cancelled.
  Picture next();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether screens and windows are the desktop's to give: a session with Wayland, XWayland in it or not.
bool isGivenByPortal();

}  // namespace relucent::gui
