// SPDX-License-Identifier: MIT
#pragma once

#include <gio/gio.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>

#include "relucent/base/progress.h"

/// GIO's objects as owned ones, and waiting that can be cancelled. For this folder alone.
namespace relucent::pjlink {

struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <typename Object>
using Owned = std::unique_ptr<Object, Unref>;

/// The reason of a failed call.
class Failure {
 public:
  ~Failure() { g_clear_error(&error_); }
  Failure() = default;
  Failure(const Failure&) = delete;
  Failure& operator=(const Failure&) = delete;

  /// For the call that may fail; forgets the one before.
  GError** fresh() {
    g_clear_error(&error_);
    return &error_;
  }
  bool is(GIOErrorEnum code) const {
    return error_ != nullptr && g_error_matches(error_, G_IO_ERROR, static_cast<gint>(code)) != 0;
  }
  std::string text() const { return error_ != nullptr ? error_->message : ""; }

 private:
  GError* error_ = nullptr;
};

using Deadline = std::chrono::steady_clock::time_point;
inline constexpr std::chrono::milliseconds betweenLooks{100};  // for a request to stop

/// Until the socket is ready; false: it is not at the deadline. Throws: Cancelled.
inline bool waitFor(GSocket* socket, GIOCondition condition, Deadline deadline, const Progress& progress) {
  Failure failure;
  for (;;) {
    progress.checkpoint();
    const auto left =
        std::chrono::duration_cast<std::chrono::microseconds>(deadline - std::chrono::steady_clock::now());
    const auto slice =
        std::clamp<std::chrono::microseconds>(left, std::chrono::microseconds(1), betweenLooks);
    if (g_socket_condition_timed_wait(socket, condition, slice.count(), nullptr, failure.fresh()) != 0)
      return true;
    // What else went wrong, the call that follows tells better.
    if (!failure.is(G_IO_ERROR_TIMED_OUT)) return true;
    if (std::chrono::steady_clock::now() >= deadline) return false;
  }
}

}  // namespace relucent::pjlink
