// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>

namespace relucent::gui {

/// What to ask of Qt (QT_QPA_PLATFORM) in a session: Wayland where there is one, since XWayland neither keeps
/// a window on the wanted output nor its pixels on a scaled one, and X where Qt's plugin for it is missing.
/// Qt itself takes XWayland on GNOME. `wanted`: what the user chose; `waylandDisplay`: WAYLAND_DISPLAY;
/// empty: nothing.
QByteArray platformChoice(const QByteArray& wanted, const QByteArray& waylandDisplay);

/// Asks for it. Before the application is constructed.
void choosePlatform();

}  // namespace relucent::gui
