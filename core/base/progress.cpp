// SPDX-License-Identifier: MIT
#include "relucent/base/progress.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent {

void StopRequest::ask(Kind kind) noexcept {
  int wanted = static_cast<int>(kind);
  int current = state_.load();
  while (current < wanted && !state_.compare_exchange_weak(current, wanted)) {
  }
}

Progress::Progress() = default;

Progress::Progress(ProgressSink& sink, StopRequest& stop) : sink_(&sink), stop_(&stop) {}

Progress::Progress(ProgressSink* sink, StopRequest* stop, double begin, double end, Message stage)
    : sink_(sink), stop_(stop), begin_(begin), end_(end), stage_(std::move(stage)) {}

double Progress::place() const {
  return std::lerp(begin_, end_, done_);
}

Progress Progress::part(double share, Message stage) {
  require(share >= 0.0 && share <= 1.0, "a part is between 0 and 1 of its whole, not {}", share);
  const double begin = place();
  done_ = std::min(done_ + share, 1.0);
  Progress child(sink_, stop_, begin, place(), std::move(stage));
  child.report(0.0);
  return child;
}

void Progress::report(double fraction) {
  done_ = std::clamp(fraction, done_, 1.0);
  if (sink_ != nullptr) sink_->progressed(place(), stage_);
  checkpoint();
}

void Progress::checkpoint() const {
  if (stop_ != nullptr && stop_->asked() == StopRequest::Kind::cancel) throw Cancelled();
}

bool Progress::stopAndKeep() const {
  return stop_ != nullptr && stop_->asked() == StopRequest::Kind::keep;
}

void Progress::preview(const Preview& preview) const {
  if (sink_ != nullptr) sink_->previewed(preview);
}

void Progress::expect(const WorkLeft& work) const {
  if (sink_ != nullptr) sink_->expected(work);
}

}  // namespace relucent
