// SPDX-License-Identifier: MIT
#pragma once

#include <QFutureWatcher>
#include <QtConcurrent>
#include <functional>
#include <memory>
#include <optional>

#include "jobs/failure.h"
#include "relucent/base/progress.h"

namespace relucent::gui {

/// Work for sliders that answers twice or more: soon, then exactly. Only the newest request is answered
/// exactly; it cancels the current one, but never two in a row without any answer: otherwise a slider that
/// keeps moving would get none. `Result` is copied or moved to the thread of this object.
template <typename Result>
class Refining {
 public:
  using Report = std::function<void(Result)>;
  /// Reports preliminary answers any number of times, and returns the exact one. Called on another thread,
  /// one at a time; ends with Cancelled when its progress throws it.
  using Work = std::function<Result(Progress& progress, const Report& reportSoon)>;
  using Failed = std::function<void(const Failure&)>;

  Refining(Report report, Failed failed) : report_(std::move(report)), failed_(std::move(failed)) {
    QObject::connect(&watcher_, &QFutureWatcherBase::finished, &watcher_, [this] { finished(); });
  }
  /// Cancels the current request and waits for its end.
  ~Refining() {
    watcher_.disconnect();
    drop();
    watcher_.waitForFinished();
  }

  void ask(Work work) {
    waiting_ = std::move(work);
    if (!round_)
      begin();
    else if (round_->answered || !starved_)
      round_->cancel();
  }
  /// Discards all pending requests.
  void drop() {
    waiting_ = nullptr;
    if (!round_) return;
    round_->cancel();
    round_->dropped = true;
  }
  bool isBusy() const { return waiting_ || (round_ && !round_->dropped); }

 private:
  struct IgnoredProgress : ProgressSink {
    void progressed(double, const Message&) override {}
  };
  /// A request being computed.
  struct Round {
    IgnoredProgress sink;
    StopRequest stop;
    std::optional<Result> result;
    std::optional<Failure> failure;
    bool answered = false, cancelled = false, dropped = false;  // used by this object's thread only
    void cancel() {
      cancelled = true;
      stop.ask(StopRequest::Kind::cancel);
    }
  };

  void begin() {
    round_ = std::make_shared<Round>();
    watcher_.setFuture(QtConcurrent::run([this, round = round_, work = std::exchange(waiting_, nullptr)] {
      try {
        Progress progress(round->sink, round->stop);
        round->result.emplace(work(progress, [this, round](Result soon) {
          auto told = [this, round, soon = std::move(soon)] { answeredSoon(*round, soon); };
          QMetaObject::invokeMethod(&watcher_, std::move(told), Qt::QueuedConnection);
        }));
      } catch (const Cancelled&) {  // NOLINT(bugprone-empty-catch): a newer request replaces it
      } catch (...) {
        round->failure = failureOf(std::current_exception());
      }
    }));
  }
  void answeredSoon(Round& round, const Result& soon) {
    if (round.dropped) return;
    round.answered = true;
    if (waiting_) round.cancel();
    report_(soon);
  }
  void finished() {
    std::shared_ptr<Round> round = std::exchange(round_, nullptr);
    starved_ = round->cancelled && !round->answered && !round->result;
    if (waiting_) begin();
    if (round->dropped) return;
    if (round->result) report_(std::move(*round->result));
    if (round->failure) failed_(*round->failure);
  }

  Report report_;
  Failed failed_;
  Work waiting_;
  std::shared_ptr<Round> round_;
  bool starved_ = false;  // the last request was cancelled before it had answered
  QFutureWatcher<void> watcher_;
};

}  // namespace relucent::gui
