// SPDX-License-Identifier: MIT
#pragma once

#include <QUndoCommand>
#include <chrono>
#include <functional>
#include <utility>

namespace relucent::gui {

/// A value before and after, and how it is set. Changes of one name in quick succession, as a slider makes
/// them, are one.
template <typename Value>
class Undoable : public QUndoCommand {
 public:
  using Apply = std::function<void(const Value&)>;
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds quick{700};

  Undoable(const QString& name, Value before, Value after, Apply apply, Clock::time_point now = Clock::now())
      : QUndoCommand(name),
        before_(std::move(before)),
        after_(std::move(after)),
        apply_(std::move(apply)),
        last_(now) {}

  void undo() override { apply_(before_); }
  void redo() override { apply_(after_); }
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override {
    auto* next = dynamic_cast<const Undoable*>(other);
    if (next == nullptr || next->text() != text() || next->last_ - last_ > quick) return false;
    after_ = next->after_;
    last_ = next->last_;
    return true;
  }

 private:
  Value before_, after_;
  Apply apply_;
  Clock::time_point last_;
};

}  // namespace relucent::gui
