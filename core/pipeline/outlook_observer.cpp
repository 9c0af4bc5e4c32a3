// SPDX-License-Identifier: MIT
#include "relucent/pipeline/outlook_observer.h"

#include <utility>

namespace relucent::pipeline {

OutlookObserver::OutlookObserver(sentinels::AcquisitionObserver& other, Tell tell)
    : other_(other),
      tell_(std::move(tell)),
      arena_(tbb::task_arena::automatic, 1, tbb::task_arena::priority::low) {}

OutlookObserver::~OutlookObserver() noexcept {
  try {
    last();
  } catch (...) {  // NOLINT(bugprone-empty-catch): whoever did not ask for the last has another failure
  }
}

void OutlookObserver::grew(const std::vector<int>& levels, int through) {
  levels_ = levels;
  other_.grew(levels, through);
}

void OutlookObserver::drafted(const transport::Draft& draft) {
  other_.drafted(draft);
  {
    std::lock_guard lock(guard_);
    waiting_ = draft;
    if (std::exchange(isWorking_, true)) return;
  }
  arena_.execute([this] { group_.run([this] { workOut(); }); });
}

std::optional<Outlook> OutlookObserver::last() {
  arena_.execute([this] { group_.wait(); });
  std::lock_guard lock(guard_);
  return last_;
}

void OutlookObserver::workOut() {
  while (true) {
    std::optional<transport::Draft> draft;
    {
      std::lock_guard lock(guard_);
      draft = std::exchange(waiting_, std::nullopt);
      if (!draft) {
        isWorking_ = false;
        return;
      }
    }
    Progress quiet;
    std::optional<Outlook> outlook = outlookOf(*draft, quiet);
    if (outlook && tell_) tell_(*outlook);
    std::lock_guard lock(guard_);
    last_ = std::move(outlook);
  }
}

}  // namespace relucent::pipeline
