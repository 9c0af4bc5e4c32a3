// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <chrono>
#include <random>

#include "gui/wizard/gige_room.h"
#include "support/small_disk.h"

namespace relucent::gui {

/// The room whose devices fail now and then: the projector's cable, the camera's, somebody who bumps the
/// camera, a disk that fills.
class FailingRoom {
 public:
  FailingRoom(const std::filesystem::path& cache, test::SmallDisk& disk);

  bool isRunning() const { return room_.isRunning(); }
  int photographs() const { return room_.photographs(); }
  /// Something fails, or what failed is put right. In words.
  QString change(std::mt19937& random);
  void putRight();

  /// What shines on the projector's screen now.
  bool isBright() const;
  bool isScreenPlugged() const { return isScreenPlugged_; }
  bool isCameraPlugged() const { return isCameraPlugged_; }
  /// Seconds since a device went or came.
  double sinceChange() const;

 private:
  QString plugScreen(bool on);
  QString plugCamera(bool on);
  QString bump(double pixels);
  QString fillDisk(bool full);

  test::SmallDisk& disk_;
  Room room_;
  test::ScreenLight screen_{"DUMMY1"};
  bool isScreenPlugged_ = true, isCameraPlugged_ = true, isBumped_ = false, isDiskFull_ = false;
  std::chrono::steady_clock::time_point changed_ = std::chrono::steady_clock::now();
};

}  // namespace relucent::gui
