// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <QObject>
#include <QWaitCondition>
#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include "relucent/calibration/room_on_disk.h"

namespace relucent::gui {

/// Tells the interface that a measurement waits because the disk is full, and the measurement that it is to
/// go on. Called on both threads.
class RoomQuestion : public QObject, public calibration::RoomWaiter {
  Q_OBJECT

 public:
  explicit RoomQuestion(QObject* parent = nullptr) : QObject(parent) {}

  Answer wait(const calibration::FullDisk& disk) override;
  void over() override;
  std::chrono::steady_clock::duration otherPauses() const override { return pauses_ ? pauses_() : Pauses(); }
  /// Who knows of them. Before a measurement begins, on its thread.
  void countPauses(std::function<std::chrono::steady_clock::duration()> pauses) {
    pauses_ = std::move(pauses);
  }

  /// The disk that is waited for; none: nobody waits.
  std::optional<calibration::FullDisk> waiting() const;
  /// With what is free. Nothing, if nobody waits.
  void goOn();

 Q_SIGNALS:
  void changed();

 private:
  using Pauses = std::chrono::steady_clock::duration;
  std::function<Pauses()> pauses_;
  mutable QMutex guard_;
  QWaitCondition told_;
  std::optional<calibration::FullDisk> waiting_;
  bool goesOn_ = false;
};

}  // namespace relucent::gui
