// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>

#include "jobs/job.h"
#include "relucent/pipeline/tidy.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Frees the disk of what one venue does not need: looks what that is, whatever is kept, asks, and does it.
/// Nothing is removed before free(). Without widgets.
class VenueTidy : public QObject {
  Q_OBJECT

 public:
  enum class State { looking, choosing, asking, freeing, done, stopped, failed };

  /// Begins to look. `step`: which the devices are leased for; `folder`: of a venue, open or not; `session`
  /// outlives this.
  VenueTidy(Session& session, const StepName& step, const QString& folder, QObject* parent = nullptr);

  QString name() const;
  State state() const { return state_; }
  /// Of looking or freeing, 0 to 1.
  double fraction() const { return job_.fraction(); }

  /// Why nothing may be removed now, a sentence; empty: it may. What is at work may need it.
  static QString problem(const Session& session);

  /// After looking: what would be freed.
  const pipeline::TidiedCalibration& freedBy(pipeline::KeptPhotographs kept) const {
    return survey_->freed.at(kept);
  }
  /// Measured to the end; else all photographs stay, whatever is chosen.
  bool isComplete() const { return freedBy(pipeline::KeptPhotographs::results).isComplete; }
  /// At first what the venue was begun with.
  pipeline::KeptPhotographs kept() const { return kept_; }
  void choose(pipeline::KeptPhotographs kept);
  /// Contract: something would be freed.
  void ask();
  void goBack();
  void free();
  /// Looking or freeing ends soon.
  void cancel() { job_.cancel(); }

  /// What was freed, once it is done.
  const pipeline::TidiedCalibration& freed() const { return *freed_; }
  const Failure& failure() const { return failure_; }

 Q_SIGNALS:
  void changed();

 private:
  struct Survey {
    std::map<pipeline::KeptPhotographs, pipeline::TidiedCalibration> freed;  // by what is kept
    pipeline::KeptPhotographs asked = pipeline::KeptPhotographs::everything;
  };
  void look();
  void conclude();
  void fail(const Failure& failure);
  bool isOpenVenue() const { return session_.isOpen() && session_.path() == folder_; }
  void turn(State state);

  Session& session_;
  StepName step_;
  std::filesystem::path folder_;
  State state_ = State::looking;
  pipeline::KeptPhotographs kept_ = pipeline::KeptPhotographs::everything;
  std::shared_ptr<Survey> survey_ = std::make_shared<Survey>();  // the job writes it, then this reads it
  std::shared_ptr<pipeline::TidiedCalibration> freed_ = std::make_shared<pipeline::TidiedCalibration>();
  Failure failure_;
  DeviceLease lease_;  // of the open venue while its photographs go
  Job job_;            // last: ends before what it writes
};

}  // namespace relucent::gui
