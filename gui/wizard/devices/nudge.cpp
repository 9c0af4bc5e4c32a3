// SPDX-License-Identifier: MIT
#include "wizard/devices/nudge.h"

#include <QElapsedTimer>
#include <QThread>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "relucent/calibration/results.h"
#include "relucent/linearization/test_light.h"
#include "relucent/pipeline/reductions.h"

namespace relucent::gui {
namespace {

// Above this a camera's signal is no measure of the light.
constexpr float saturation = 0.97f;
constexpr qint64 betweenLooks = 500;  // milliseconds: the screen's own light falls into the room
constexpr unsigned long restMilliseconds = 20;
constexpr double usualExposure = 0.1;  // seconds, where nobody knows

/// The one in which full light does not saturate.
double exposureOf(const Session& session) {
  const auto& checked = session.figures<calibration::Stage::camera>();
  if (checked && !checked->exposures.empty()) return checked->exposures.back();
  const auto& stored = session.result(calibration::Stage::linearization);
  if (!stored) return usualExposure;
  const std::vector<double> exposures = calibration::loadLinearization(*stored).exposures;
  return exposures.empty() ? usualExposure : exposures.back();
}

/// The projectors are dark again however it ends.
class FullLight {
 public:
  explicit FullLight(rig::Rig& rig) : rig_(rig) { linearization::showEven(rig_, {1, 1, 1}); }
  ~FullLight() {
    try {
      linearization::showEven(rig_, {0, 0, 0});
    } catch (const std::exception&) {
      // A device that is gone gives no light.
    }
  }
  FullLight(const FullLight&) = delete;
  FullLight& operator=(const FullLight&) = delete;

 private:
  rig::Rig& rig_;
};

}  // namespace

double NudgeSight::distance() const {
  return std::hypot(offset.movement.x, offset.movement.y);
}

double NudgeSight::tilt() const {
  return std::abs(offset.movement.degrees) * std::numbers::pi / 180.0 * 0.5 *
         std::max(seen.width(), seen.height());
}

/// What the looking thread tells the interface.
struct Nudge::Shared {
  QMutex guard;
  std::optional<NudgeSight> sight;
  bool posted = false;
};

Nudge::Nudge(Session& session, const StepName& step, QObject* parent)
    : QObject(parent), session_(session), step_(step) {
  connect(&job_, &Job::progressed, this, &Nudge::changed);
  connect(&job_, &Job::ended, this, &Nudge::jobEnded);
  connect(&session_, &Session::devicesChanged, this, &Nudge::heedDevices);
  connect(&session_, &Session::acquisitionChanged, this, [this] {
    if (session_.acquisitionFailure()) failure_ = session_.acquisitionFailure();
    look();
    Q_EMIT changed();
  });
}

Nudge::Nudge(Session& session, image::Image expected, QObject* parent)
    : QObject(parent), session_(session), expected_(std::move(expected)) {
  connect(&job_, &Job::progressed, this, &Nudge::changed);
  connect(&job_, &Job::ended, this, &Nudge::jobEnded);
  connect(&session_, &Session::devicesChanged, this, &Nudge::heedDevices);
}

Nudge::~Nudge() {
  job_.cancel();
}

void Nudge::start() {
  wanted_ = true;
  if (step_) session_.wantAcquisition();
  look();
}

void Nudge::stop() {
  wanted_ = false;
  if (job_.isRunning())
    job_.cancel();
  else
    Q_EMIT ended();
}

void Nudge::look() {
  if (!wanted_ || job_.isRunning() || (step_ && !session_.areDevicesFree())) return;
  if (step_) {
    if (!session_.acquisition()) return;
    const transport::Acquisition& acquisition = *session_.acquisition();
    expected_ = image::imageFromStack(acquisition.flood, acquisition.transport.cameras(), 0);
    lease_ = session_.leaseDevices(*step_, DeviceWork::light);
  }
  failure_.reset();
  shared_ = std::make_shared<Shared>();
  job_.start([this, shared = shared_, work = workOf(session_), expected = expected_,
              exposure = exposureOf(session_), isReduced = step_.has_value()](Progress& progress) {
    Progress opening = progress.part(1.0, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& whole = work.devices->open(opening);
    rig::Rig reduced;
    if (isReduced)
      reduced = pipeline::reducedRig(
          calibration::CalibrationFolder::open(work.path, calibration::CalibrationFolder::Access::read),
          whole);
    rig::Rig& rig = isReduced ? reduced : whole;
    FullLight light(rig);
    for (int number = 0;; ++number) {
      progress.checkpoint();
      QElapsedTimer since;
      since.start();
      NudgeSight sight;
      sight.seen = rig.cameras.front()->capture({{"nudge", number}, 0, exposure}).signal;
      sight.offset = pipeline::aimOffset(expected, sight.seen, saturation);
      {
        QMutexLocker lock(&shared->guard);
        shared->sight = std::move(sight);
        if (!std::exchange(shared->posted, true))
          QMetaObject::invokeMethod(this, [this] { takeSight(); }, Qt::QueuedConnection);
      }
      while (since.elapsed() < betweenLooks) {
        progress.checkpoint();
        QThread::msleep(restMilliseconds);
      }
    }
  });
  Q_EMIT changed();
}

/// An arrow that no longer follows would be followed.
void Nudge::heedDevices() {
  if (session_.isDeviceLost()) sight_.reset();
  Q_EMIT changed();
}

void Nudge::takeSight() {
  if (!shared_) return;
  {
    QMutexLocker lock(&shared_->guard);
    shared_->posted = false;
    sight_ = shared_->sight;
  }
  wasElsewhere_ = wasElsewhere_ || (sight_ && sight_->isElsewhere());
  Q_EMIT changed();
}

void Nudge::jobEnded() {
  takeSight();
  lease_.release();
  if (job_.state() == Job::State::failed) {
    failure_ = job_.failure();
    sight_.reset();
  }
  Q_EMIT changed();
  Q_EMIT ended();
}

}  // namespace relucent::gui
