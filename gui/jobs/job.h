// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>
#include <QObject>
#include <QThread>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "jobs/failure.h"
#include "relucent/base/progress.h"

namespace relucent::gui {

/// Runs long work of core on its own thread, and turns core's Progress into Qt signals. Signals arrive on
/// this object's thread, only as often as it can handle them: of several reports the last one counts.
class Job : public QObject {
  Q_OBJECT

 public:
  using Work = std::function<void(Progress&)>;
  enum class State { idle, running, done, cancelled, failed };

  explicit Job(QObject* parent = nullptr);
  /// Cancels and waits.
  ~Job() override;

  /// Nothing of the work, nor what it holds, stays once it has ended.  Contract: no work is running.
  void start(Work work);
  /// The work ends early with a valid, coarser result.
  void stopAndKeep();
  /// The work ends without a result; saved files remain.
  void cancel();
  /// Waits for the end; signals follow later, from the event loop.
  void wait();

  State state() const { return state_; }
  bool isRunning() const { return state_ == State::running; }
  bool isStopping() const { return stop_ != nullptr && stop_->asked() != StopRequest::Kind::none; }
  double fraction() const { return fraction_; }
  /// In the language that the user has now.
  QString stage() const;
  /// Which one it is, in no language.
  std::string stageId() const { return std::string(stage_.id()); }
  /// Of the last work that failed.
  const Failure& failure() const { return failure_; }

 Q_SIGNALS:
  void progressed(double fraction, const QString& stage);
  void expected(const relucent::WorkLeft& left);
  /// Emitted in all cases, see state().
  void ended();

 private:
  class Sink;
  void takeReports();
  void finish(State state, Failure failure);

  struct Reports {
    QMutex guard;
    bool posted = false;
    double fraction = 0.0;
    Message stage;
    std::optional<WorkLeft> left;
  };
  std::shared_ptr<Reports> reports_;
  std::unique_ptr<StopRequest> stop_;
  std::unique_ptr<QThread> thread_;
  State state_ = State::idle;
  double fraction_ = 0.0;
  Message stage_;
  Failure failure_;
};

}  // namespace relucent::gui

Q_DECLARE_METATYPE(relucent::WorkLeft)
