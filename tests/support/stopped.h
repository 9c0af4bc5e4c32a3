// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/progress.h"

namespace relucent {

/// Hears progress and says nothing.
struct SilentSink : ProgressSink {
  void progressed(double, const Message&) override {}
};

/// A progress whose user has asked to stop already.
class Stopped {
 public:
  explicit Stopped(StopRequest::Kind kind = StopRequest::Kind::cancel) : progress_(sink_, stop_) {
    stop_.ask(kind);
  }
  operator Progress&() { return progress_; }

 private:
  SilentSink sink_;
  StopRequest stop_;
  Progress progress_;
};

}  // namespace relucent
