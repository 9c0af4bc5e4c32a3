// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <QObject>
#include <QThread>
#include <functional>
#include <memory>
#include <optional>

#include "base/progress.h"
#include "jobs/failure.h"

namespace relucent {

/// Long work of core on a thread of its own, and core's Progress as Qt's signals. Signals come on the thread
/// that this object lives on, and only as often as that thread can take them: of many reports the last
/// counts.
class Job : public QObject {
  Q_OBJECT

 public:
  using Work = std::function<void(Progress&)>;
  enum class State { idle, running, done, cancelled, failed };

  explicit Job(QObject* parent = nullptr);
  /// Cancels and waits.
  ~Job() override;

  /// Contract: no work is running.
  void start(Work work);
  /// The work ends early with a valid, coarser result.
  void stopAndKeep();
  /// The work ends without a result; what it saved stays.
  void cancel();
  /// Waits for the end; signals come later, from the event loop.
  void wait();

  State state() const { return state_; }
  bool isRunning() const { return state_ == State::running; }
  bool isStopping() const { return stop_ != nullptr && stop_->asked() != StopRequest::Kind::none; }
  double fraction() const { return fraction_; }
  /// In the user's language.
  QString stage() const { return stage_; }
  /// Of the last work that failed.
  const Failure& failure() const { return failure_; }

 Q_SIGNALS:
  void progressed(double fraction, const QString& stage);
  void expected(const relucent::WorkLeft& left);
  /// In any way, see state().
  void ended();

 private:
  class Sink;
  void takeReports();
  void finish(State state, Failure failure);

  struct Reports {
    QMutex guard;
    bool posted = false;
    double fraction = 0.0;
    std::string stage;
    std::optional<WorkLeft> left;
  };
  std::shared_ptr<Reports> reports_;
  std::unique_ptr<StopRequest> stop_;
  std::unique_ptr<QThread> thread_;
  State state_ = State::idle;
  double fraction_ = 0.0;
  QString stage_;
  Failure failure_;
};

}  // namespace relucent

Q_DECLARE_METATYPE(relucent::WorkLeft)
