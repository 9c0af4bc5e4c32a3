// SPDX-License-Identifier: MIT
#pragma once

#include <QFuture>
#include <QtConcurrentRun>
#include <new>
#include <utility>
#include <variant>

#include "base/error.h"

namespace relucent {

/// What work on another thread ended in: a value, or the failure that kept it from one. A QFuture would make
/// any exception one of its own and throw it at whoever waits, destructors too.
template <typename Value>
using Outcome = std::variant<Value, Error>;

/// Starts work() on one of the desktop library's threads.
template <typename Work>
auto startedElsewhere(Work work) {
  using Value = decltype(work());
  return QtConcurrent::run([work = std::move(work)]() -> Outcome<Value> {
    try {
      return work();
    } catch (const Error& error) {
      return error;
    } catch (const std::bad_alloc&) {
      return Error(ErrorKind::memory, "not enough memory to open this",
                   "close other programs or play smaller pictures");
    }
  });
}

/// Waits if it must. Throws: the Error that the work ended in.
template <typename Value>
Value resultOf(const QFuture<Outcome<Value>>& future) {
  Outcome<Value> outcome = future.result();
  if (Error* error = std::get_if<Error>(&outcome)) throw *error;
  return std::get<Value>(std::move(outcome));
}

}  // namespace relucent
