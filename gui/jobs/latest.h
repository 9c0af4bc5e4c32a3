// SPDX-License-Identifier: MIT
#pragma once

#include <QFutureWatcher>
#include <QtConcurrent>
#include <functional>
#include <memory>
#include <optional>

#include "jobs/failure.h"

namespace relucent::gui {

/// Work for sliders: while one request is computed on another thread, only the newest of further requests is
/// kept. `Result` is copied or moved to the thread of this object.
template <typename Result>
class Latest {
 public:
  using Work = std::function<Result()>;
  using Done = std::function<void(Result)>;
  using Failed = std::function<void(const Failure&)>;

  Latest(Done done, Failed failed) : done_(std::move(done)), failed_(std::move(failed)) {
    QObject::connect(&watcher_, &QFutureWatcherBase::finished, &watcher_, [this] { finished(); });
  }
  /// Waits for the current request; its result is dropped.
  ~Latest() {
    watcher_.disconnect();
    watcher_.waitForFinished();
  }

  void ask(Work work) {
    waiting_ = std::move(work);
    if (!busy_) begin();
  }
  bool isBusy() const { return busy_; }

 private:
  struct Answer {
    std::optional<Result> result;
    std::optional<Failure> failure;
  };

  void begin() {
    busy_ = true;
    watcher_.setFuture(QtConcurrent::run([work = std::exchange(waiting_, nullptr)] {
      auto answer = std::make_shared<Answer>();
      try {
        answer->result.emplace(work());
      } catch (...) {
        answer->failure = failureOf(std::current_exception());
      }
      return answer;
    }));
  }
  void finished() {
    std::shared_ptr<Answer> answer = watcher_.result();
    busy_ = false;
    if (waiting_) begin();
    if (answer->result)
      done_(std::move(*answer->result));
    else
      failed_(*answer->failure);
  }

  Done done_;
  Failed failed_;
  Work waiting_;
  bool busy_ = false;
  QFutureWatcher<std::shared_ptr<Answer>> watcher_;
};

}  // namespace relucent::gui
