// SPDX-License-Identifier: MIT
#include "jobs/patient_camera.h"

#include <QDeadlineTimer>
#include <QThread>
#include <algorithm>
#include <exception>
#include <utility>

#include "relucent/base/message.h"
#include "relucent/base/progress.h"
#include "relucent/rig/device_given_up.h"

namespace relucent::gui {
namespace {

constexpr std::chrono::milliseconds look{50};  // for whoever wants to be free

}  // namespace

bool CameraPatience::isGivenUp() const {
  QMutexLocker lock(&guard_);
  return givenUp_;
}

void CameraPatience::setGivenUp(bool givenUp) {
  QMutexLocker lock(&guard_);
  givenUp_ = givenUp;
}

std::optional<Failure> CameraPatience::failure() const {
  QMutexLocker lock(&guard_);
  return failure_;
}

void CameraPatience::tell(std::optional<Failure> failure) {
  QMutexLocker lock(&guard_);
  failure_ = std::move(failure);
}

/// Takes each photograph on a thread of its own.
class PatientCamera::Driver {
 public:
  explicit Driver(std::unique_ptr<rig::Camera> camera) : camera_(std::move(camera)) {}
  ~Driver() {
    if (!thread_) return;
    thread_->requestInterruption();
    thread_->wait();
  }

  rig::Camera& camera() const { return *camera_; }
  /// `checkpoint` is called while the photograph is waited for. If that throws, so does this, and the next
  /// one waits for the end of this one.
  template <typename Checkpoint>
  rig::RawFrame take(const rig::CaptureRequest& request, const Checkpoint& checkpoint) {
    if (thread_) wait(checkpoint);
    checkpoint();
    frame_.reset();
    failure_ = nullptr;
    thread_.reset(QThread::create([this, request] {
      try {
        frame_ = camera_->capture(request);
      } catch (...) {
        failure_ = std::current_exception();
      }
    }));
    thread_->start();
    wait(checkpoint);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return *std::exchange(frame_, std::nullopt);
  }

 private:
  template <typename Checkpoint>
  void wait(const Checkpoint& checkpoint) {
    try {
      while (!thread_->wait(QDeadlineTimer(look))) checkpoint();
    } catch (...) {
      thread_->requestInterruption();  // where it waits for a screen
      throw;
    }
  }

  std::unique_ptr<rig::Camera> camera_;
  std::optional<rig::RawFrame> frame_;  // of the thread until that has ended
  std::exception_ptr failure_;
  std::unique_ptr<QThread> thread_;  // the last: it uses the others
};

PatientCamera::PatientCamera(std::unique_ptr<rig::Camera> camera, std::shared_ptr<CameraPatience> patience,
                             std::chrono::milliseconds pause)
    : patience_(std::move(patience)), pause_(pause), driver_(std::make_unique<Driver>(std::move(camera))) {}

PatientCamera::~PatientCamera() = default;

std::string PatientCamera::name() const {
  return driver_->camera().name();
}

Size PatientCamera::size() const {
  return driver_->camera().size();
}

rig::ExposureRange PatientCamera::exposures() const {
  return driver_->camera().exposures();
}

void PatientCamera::checkpoint() const {
  if (QThread::currentThread()->isInterruptionRequested()) throw Cancelled();
  if (patience_->isGivenUp())
    throw rig::DeviceGivenUp(
        ErrorKind::device, RELUCENT_MESSAGE("device.camera-given-up", "the camera does not answer"),
        RELUCENT_MESSAGE("device.camera-given-up-advice",
                         "push in its cable at both ends and switch it on, then go on: every photograph so "
                         "far is kept"),
        name());
}

void PatientCamera::rest() const {
  const QDeadlineTimer until(pause_);
  while (!until.hasExpired()) {
    checkpoint();
    QThread::msleep(static_cast<unsigned long>(std::min<qint64>(look.count(), until.remainingTime())));
  }
}

rig::RawFrame PatientCamera::capture(const rig::CaptureRequest& request) {
  while (true) {
    try {
      rig::RawFrame frame = driver_->take(request, [this] { checkpoint(); });
      hasWorked_ = true;
      patience_->tell(std::nullopt);
      return frame;
    } catch (const rig::DeviceGivenUp&) {
      throw;
    } catch (const Error&) {
      if (!hasWorked_) throw;
      patience_->tell(failureOf(std::current_exception()));
    }
    rest();
  }
}

}  // namespace relucent::gui
