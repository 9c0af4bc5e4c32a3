// SPDX-License-Identifier: MIT
#pragma once

#include <QFuture>
#include <QThreadPool>
#include <QtConcurrentRun>
#include <new>
#include <utility>
#include <variant>

#include "relucent/base/error.h"

namespace relucent::gui {

/// The result of work on another thread: a value or a failure. A QFuture would wrap any exception in its own
/// type and throw it in whatever waits, including destructors.
template <typename Value>
using Outcome = std::variant<Value, Error>;

/// Starts work() on a thread of a pool: Qt's, whose threads are as many as there are cores, if none is given.
template <typename Work>
auto startedInBackground(Work work, QThreadPool* pool = QThreadPool::globalInstance()) {
  using Value = decltype(work());
  return QtConcurrent::run(pool, [work = std::move(work)]() -> Outcome<Value> {
    try {
      return work();
    } catch (const Error& error) {
      return error;
    } catch (const std::bad_alloc&) {
      return Error(ErrorKind::memory,
                   RELUCENT_ENGLISH_MESSAGE("content.not-enough-memory", "not enough memory to open this"),
                   RELUCENT_ENGLISH_MESSAGE("content.free-memory-or-shrink-pictures",
                                            "close other programs or play smaller pictures"));
    }
  });
}

/// Waits if necessary. Throws: the Error of the work.
template <typename Value>
Value resultOf(const QFuture<Outcome<Value>>& future) {
  Outcome<Value> outcome = future.result();
  if (Error* error = std::get_if<Error>(&outcome)) throw *error;
  return std::get<Value>(std::move(outcome));
}

}  // namespace relucent::gui
