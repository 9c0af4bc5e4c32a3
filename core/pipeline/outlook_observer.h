// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "relucent/base/tbb.h"
#include "relucent/pipeline/outlook.h"
#include "relucent/sentinels/observer.h"

namespace relucent::pipeline {

/// Looks on for another, and works out what may be expected while the measurement goes on: on other cores,
/// after all that the measurement has for them. Of drafts that come faster the last counts.
class OutlookObserver : public sentinels::AcquisitionObserver {
 public:
  using Tell = std::function<void(const Outlook&)>;

  /// `tell` is called from any thread, one call at a time; empty: nobody. `other` outlives this.
  OutlookObserver(sentinels::AcquisitionObserver& other, Tell tell);
  ~OutlookObserver() noexcept override;

  void checked(const sentinels::Reading& reading) override { other_.checked(reading); }
  void takenAgain(const sentinels::Retake& retake) override { other_.takenAgain(retake); }
  void grew(const std::vector<int>& levels, int through) override;
  bool wantsDrafts() const override { return true; }
  void drafted(const transport::Draft& draft) override;

  /// Waits until the last draft is worked out.  Throws: as outlookOf().
  std::optional<Outlook> last();
  /// As told by grew(), on the thread that measures.
  const std::vector<int>& levels() const { return levels_; }

 private:
  void workOut();

  sentinels::AcquisitionObserver& other_;
  Tell tell_;
  std::vector<int> levels_;
  std::mutex guard_;  // of the next three
  std::optional<transport::Draft> waiting_;
  std::optional<Outlook> last_;
  bool isWorking_ = false;
  tbb::task_arena arena_;
  tbb::task_group group_;
};

}  // namespace relucent::pipeline
