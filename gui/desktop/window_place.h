// SPDX-License-Identifier: MIT
#pragma once

#include <QRect>
#include <QWindow>

namespace relucent::gui {

/// Whether a window that is seen stands on `place` of that screen, as the display server says, not as it was
/// asked: desktops have their own mind. X: the window's own place in pixels is `place`, whose lengths
/// may be a pixel off where the desktop scales. Wayland, which tells a window only the outputs that it has
/// entered: that screen. Others do as they are asked.
bool standsOn(const QWindow& window, const QScreen& screen, const QRect& place);

}  // namespace relucent::gui
