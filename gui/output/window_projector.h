// SPDX-License-Identifier: MIT
#pragma once

#include <QScreen>
#include <QString>
#include <chrono>
#include <functional>
#include <memory>

#include "output/screen_identity.h"
#include "relucent/devices/screen_rig.h"
#include "relucent/pipeline/rig_settings.h"

namespace relucent::gui {

ScreenIdentity identityOf(const pipeline::ScreenRigSettings::Display& display);
pipeline::ScreenRigSettings::Display displayOf(const QScreen& screen);

/// Why a screen cannot show pictures pixel for pixel; empty: it can.
QString unusableReason(const QScreen& screen);

/// A screen of the desktop as a projector for measuring. Used from a worker thread; its window lives on the
/// interface's thread. show() returns once the picture has been swapped onto the screen and the display
/// server has it, waits while the screen is unplugged, wakes sleeping displays and waits until they are lit,
/// and throws Cancelled when the thread is asked to end (QThread::requestInterruption), which avoids a
/// deadlock. Black before the first picture, hidden after rest().
class WindowProjector : public devices::ScreenProjector {
 public:
  /// Time from the return of the signal until a projector shows it.
  static constexpr std::chrono::milliseconds usualWaking{8000};

  /// `waiting`: told on the interface's thread that the screen is gone (true) or back (false).
  /// `waking`: how long displays that were woken are waited for.
  WindowProjector(ScreenIdentity display, Size size, std::function<void(bool)> waiting = {},
                  std::chrono::milliseconds waking = usualWaking);
  ~WindowProjector() override;
  WindowProjector(const WindowProjector&) = delete;
  WindowProjector& operator=(const WindowProjector&) = delete;

  std::string name() const override { return name_; }
  Size size() const override { return size_; }
  int bits() const override { return 8; }
  /// Throws: Error{device} if the screen's size differs from the projector's, or it does not wake; Cancelled.
  void show(const image::Image& encodedDrive) override;
  bool stayedVisible() override;
  void rest() override;

 private:
  struct Shared;
  template <typename Done>
  void waitFor(Done done);

  std::string name_;
  Size size_;
  std::chrono::milliseconds waking_;
  std::shared_ptr<Shared> shared_;
  class Stage;
  Stage* stage_;  // on the interface's thread; deletes itself there
};

}  // namespace relucent::gui
