// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

namespace relucent::gui {

/// Parses the path of a playlist item: a file or folder, or another source, written as "kind:which".
struct ContentAddress {
  enum class Kind {
    file,   // anything else: a path
    chart,  // chart:grid      a test chart
    // Under Wayland "which" is a name for what is chosen in the desktop's dialog when it plays first.
    screen,  // screen:HDMI-1   the live picture of a screen
    window,  // window:Slides   the live picture of a window, by a part of its title or its number
    camera,  // camera:USB      the live picture of a capture device, by a part of its name
    stream,  // stream:rtsp://host/path   a live picture from the network, see StreamAddress
  };
  Kind kind = Kind::file;
  QString which;  // the path itself for files
};

ContentAddress addressOf(const QString& path);

/// The path for people: as it is, but for streams without user names and passwords.
QString shownPath(const QString& path);

}  // namespace relucent::gui
