// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "content/canvas.h"
#include "jobs/job.h"
#include "jobs/latest.h"
#include "relucent/pipeline/perfect.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Corrects a still picture by photographs of itself, for a page: one at a time, on another thread. Knows of
/// the picture that it was told of last whether it is corrected so.
class Perfecting : public QObject {
  Q_OBJECT

 public:
  /// `step`: that the devices are used by.
  Perfecting(Session& session, const StepName& step, QObject* parent = nullptr);
  ~Perfecting() override { job_.cancel(); }

  /// The picture that the page shows, a file or resource, and the canvas that it is shown on. Looks on the
  /// disk, on another thread; changed() tells. While one is being perfected it is that one.
  void lookAt(const QString& picture, const Canvas& canvas);

  /// The same once more: another program may have perfected it.
  void lookAgain() { look(); }

  bool isRunning() const { return job_.isRunning(); }
  /// Why none can be started now, a short sentence; empty: devices and light transport are free.
  QString whyNot() const;
  QString stage() const { return job_.stage(); }
  double fraction() const { return job_.fraction(); }
  /// Photographs of the picture by now.
  int photographs() const { return photographs_; }

  /// How the picture was corrected; none: it is shown as T has it.
  const std::optional<pipeline::PerfectedPicture>& known() const { return known_.picture; }
  /// It was corrected for an earlier measurement, or placed otherwise; that is kept, and not shown now.
  bool wasBefore() const { return known_.wasBefore; }
  /// What became of the picture that was tried last; none: none was tried since the calibration was opened.
  const std::optional<pipeline::PerfectedImage>& outcome() const { return outcome_; }
  /// Which one that was, a file or resource, and whether it is the one that the page shows.
  const QString& tried() const { return tried_; }
  bool isOfShown() const { return tried_ == picture_; }
  /// The one that the page shows.
  const QString& picture() const { return picture_; }
  /// Whether pictures follow each other slowly, since the room is not said to be clear.
  bool isSlow() const { return !session_.mayMeasure(); }

  void start();
  /// What is best by now is kept.
  void stopAndKeep() { job_.stopAndKeep(); }
  void cancel() { job_.cancel(); }
  /// The picture is shown as T has it again.
  void forget();

 Q_SIGNALS:
  void changed();
  void progressed();
  /// In any way. `isOther`: the picture is shown in another way now.
  void ended(bool isOther);
  void failed(const gui::Failure& failure);

 private:
  struct Found;
  struct Known {
    std::optional<pipeline::PerfectedPicture> picture;
    bool wasBefore = false;
  };
  void look();
  void finished();

  Session& session_;
  StepName step_;
  DeviceLease lease_;
  Job job_;
  QString picture_, tried_;
  Canvas canvas_;
  Known known_;
  std::optional<pipeline::PerfectedImage> outcome_;
  int photographs_ = 0;
  std::shared_ptr<Found> found_;  // by the job
  Latest<Known> looking_;
};

}  // namespace relucent::gui
