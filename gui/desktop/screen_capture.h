// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QRect>
#include <QString>
#include <memory>
#include <vector>

namespace relucent::gui {

/// Pictures of the desktop's screens and windows, as the X server has them at that moment, without the
/// pointer. Of a window, what others cover is missing.
class ScreenCapture {
 public:
  struct Screen {
    QString name;  // of its connector: HDMI-1
    QRect place;   // on the desktop; empty while it is off
  };
  struct Window {
    quint32 number = 0;  // as xwininfo tells it
    QString title;
    bool isOwn = false;  // of this program
  };

  ScreenCapture();
  ~ScreenCapture();

  /// False: there is no X server, hence no screens and no windows.
  bool isConnected() const;
  std::vector<Screen> screens() const;
  /// All windows with a title that are there to be seen, the ones in front first.
  std::vector<Window> windows() const;

  /// Null if there is no such one, or it cannot be read now.
  QImage ofScreen(const QString& name) const;
  QImage ofWindow(quint32 number) const;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace relucent::gui
