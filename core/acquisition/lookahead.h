// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "relucent/base/tbb.h"
#include "relucent/photography/photographer.h"
#include "relucent/sentinels/interruption.h"

namespace relucent::acquisition {

/// Takes numbered frames so that computation goes on beside the exposures:
///
///   exposing       | frame k - 1    | frame k           | frame k + 1
///   working out    | ... of k - 2   | what k - 1 showed | what k showed
///   preparing      | frame k        | frame k + 1       | frame k + 2
///
/// What is computed from what does not depend on how long anything takes.
template <typename Frame>
class Lookahead {
 public:
  /// A frame, ready to be exposed. `before`: the last one, null for the first; it stays as it is meanwhile.
  using Prepare = std::function<Frame(std::size_t number, const Frame* before)>;

  /// `frames`: how many there are; nothing is prepared beyond the last.
  Lookahead(std::size_t frames, Prepare prepare) : frames_(frames), prepare_(std::move(prepare)) {}

  /// Takes a frame, usually the one after the last; another is prepared now. expose(frame, meanwhile) does
  /// `meanwhile` and returns what the frame showed, or the interruption that is then returned; workOut(frame,
  /// shown) is done during the next exposure, or by finish().
  template <typename Expose, typename WorkOut>
  [[nodiscard]] std::optional<sentinels::Interruption> take(std::size_t number, const Expose& expose,
                                                            const WorkOut& workOut) {
    if (!ahead_ || aheadNumber_ != number) ahead_ = prepared(number);
    last_ = std::move(ahead_);
    ahead_ = nullptr;
    photography::Meanwhile meanwhile = [this, number] {
      tbb::parallel_invoke([this] { finish(); },
                           [this, number] {
                             if (number + 1 < frames_) ahead_ = prepared(number + 1);
                           });
    };
    aheadNumber_ = number + 1;
    auto shown = expose(*last_, meanwhile);
    if (!shown) return shown.interruption();
    unfinished_ = [workOut, frame = last_, shown = *std::move(shown)] { workOut(*frame, shown); };
    return std::nullopt;
  }

  /// Does what is left to be done of the last frame.
  void finish() {
    if (unfinished_) unfinished_();
    unfinished_ = {};
  }
  /// Something to be done during the next exposure. Contract: nothing else is left.
  void leave(std::function<void()> work) { unfinished_ = std::move(work); }

 private:
  std::shared_ptr<const Frame> prepared(std::size_t number) const {
    return std::make_shared<const Frame>(prepare_(number, last_.get()));
  }

  std::size_t frames_;
  Prepare prepare_;
  std::shared_ptr<const Frame> last_, ahead_;
  std::size_t aheadNumber_ = 0;
  std::function<void()> unfinished_;
};

}  // namespace relucent::acquisition
