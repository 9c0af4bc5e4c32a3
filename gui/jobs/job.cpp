// SPDX-License-Identifier: MIT
#include "jobs/job.h"

#include <utility>

#include "text/message_text.h"

namespace relucent::gui {

/// Called on the worker's thread: keeps the latest report and wakes the job once.
class Job::Sink : public ProgressSink {
 public:
  explicit Sink(Job& job) : job_(job), reports_(job.reports_) {}

  void progressed(double fraction, const Message& stage) override {
    QMutexLocker lock(&reports_->guard);
    reports_->fraction = fraction;
    reports_->stage = stage;
    post();
  }
  void expected(const WorkLeft& left) override {
    QMutexLocker lock(&reports_->guard);
    reports_->left = left;
    post();
  }

 private:
  void post() {
    if (std::exchange(reports_->posted, true)) return;
    QMetaObject::invokeMethod(&job_, [&job = job_] { job.takeReports(); }, Qt::QueuedConnection);
  }

  Job& job_;
  std::shared_ptr<Reports> reports_;
};

Job::Job(QObject* parent) : QObject(parent) {}

Job::~Job() {
  cancel();
  wait();
}

void Job::start(Work work) {
  require(!isRunning(), "a job does one thing at a time");
  wait();
  reports_ = std::make_shared<Reports>();
  stop_ = std::make_unique<StopRequest>();
  state_ = State::running;
  fraction_ = 0.0;
  stage_ = {};
  failure_ = {};
  thread_.reset(QThread::create([this, work = std::move(work)] {
    Sink sink(*this);
    Progress progress(sink, *stop_);
    State end = State::done;
    Failure failure;
    try {
      work(progress);
    } catch (const Cancelled&) {
      end = State::cancelled;
    } catch (...) {
      end = State::failed;
      failure = failureOf(std::current_exception());
    }
    QMetaObject::invokeMethod(this, [this, end, failure] { finish(end, failure); }, Qt::QueuedConnection);
  }));
  thread_->start();
}

void Job::stopAndKeep() {
  if (stop_ != nullptr) stop_->ask(StopRequest::Kind::keep);
}

void Job::cancel() {
  if (stop_ != nullptr) stop_->ask(StopRequest::Kind::cancel);
  // Devices that wait for something else than time know the thread, not the progress.
  if (isRunning() && thread_ != nullptr) thread_->requestInterruption();
}

void Job::wait() {
  if (thread_ != nullptr) thread_->wait();
}

QString Job::stage() const {
  QString stage = text(stage_);
  if (!stage.isEmpty()) stage[0] = stage[0].toUpper();  // some go on where a program's name stands before
  return stage;
}

void Job::takeReports() {
  std::optional<WorkLeft> left;
  {
    QMutexLocker lock(&reports_->guard);
    reports_->posted = false;
    fraction_ = reports_->fraction;
    stage_ = reports_->stage;
    left = std::exchange(reports_->left, std::nullopt);
  }
  if (left) Q_EMIT expected(*left);
  Q_EMIT progressed(fraction_, stage());
}

void Job::finish(State state, Failure failure) {
  takeReports();
  wait();
  state_ = state;
  failure_ = std::move(failure);
  Q_EMIT ended();
}

}  // namespace relucent::gui
