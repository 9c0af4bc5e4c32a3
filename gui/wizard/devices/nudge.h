// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <QObject>
#include <memory>
#include <optional>

#include "jobs/job.h"
#include "relucent/pipeline/aim.h"
#include "wizard/frame/lost_device.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// What somebody sees who pushes a camera back.
struct NudgeSight {
  image::Image seen;  // signal
  pipeline::AimOffset offset;

  static constexpr double nearEnough = 0.3;  // pixels: what a measurement's checks let pass
  double distance() const;
  /// How far the rim is shifted by the tilt, pixels.
  double tilt() const;
  bool isAtItsPlace() const {
    return offset.isRecognised && distance() <= nearEnough && tilt() <= 2.0 * nearEnough;
  }
  /// So far that it matters: twice what is near enough.
  bool isElsewhere() const { return offset.isRecognised && distance() > 2.0 * nearEnough; }
};

/// Looks through the first camera, projectors in full light, and compares with the picture of the surface in
/// full light that is stored: to push a camera back that was bumped. Nothing is measured or changed. No page
/// knows it but by showing it: nudge_dialog.h.
class Nudge : public QObject {
  Q_OBJECT

 public:
  /// The stored picture of the venue; the devices are leased for `step`.
  Nudge(Session& session, const StepName& step, QObject* parent = nullptr);
  /// While the measurement that has the devices waits for an answer: with the picture that it began with.
  Nudge(Session& session, image::Image expected, QObject* parent = nullptr);
  ~Nudge() override;

  void start();
  /// ended() tells when the devices are free.
  void stop();
  bool isLooking() const { return job_.isRunning(); }
  /// What it does before the first look.
  QString stage() const { return job_.stage(); }
  /// The surface in full light, as it was measured; empty until it is read.
  const image::Image& expected() const { return expected_; }
  /// What was seen last; none before the first look, while a device is lost, and once one has failed.
  const std::optional<NudgeSight>& sight() const { return sight_; }
  /// The camera was seen to look elsewhere, before that perhaps.
  bool wasElsewhere() const { return wasElsewhere_; }
  /// The device that it waits for; none: it waits for none.
  std::optional<Banner> waiting() const { return lostDeviceBanner(session_, nullptr); }
  /// Nobody can push a simulated camera.
  bool isRehearsal() const { return session_.isSimulated(); }
  /// Why it ended by itself.
  const std::optional<Failure>& failure() const { return failure_; }

 Q_SIGNALS:
  void changed();
  void ended();

 private:
  struct Shared;
  void look();
  void heedDevices();
  void takeSight();
  void jobEnded();

  Session& session_;
  std::optional<StepName> step_;  // none: somebody else has the devices and waits
  DeviceLease lease_;
  Job job_;
  image::Image expected_;
  std::shared_ptr<Shared> shared_;
  std::optional<NudgeSight> sight_;
  bool wasElsewhere_ = false;
  std::optional<Failure> failure_;
  bool wanted_ = false;
};

}  // namespace relucent::gui
