// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QImage>
#include <algorithm>
#include <functional>
#include <vector>

#include "content/canvas.h"
#include "jobs/job.h"
#include "relucent/pipeline/drift_record.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/repair.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// One camera's part of a verification photograph.
struct ProofView {
  QImage wanted, photograph;  // as somebody sees them who is used to the content's white
  image::Image deltaE;        // CIEDE2000 of every pixel; NaN outside the content
};

/// What a verification photograph came to.
struct Proof {
  pipeline::ProveResult figures;
  std::vector<ProofView> views;  // of all cameras; of versions that proved one, of that
  const ProofView& view(std::size_t camera) const { return views[std::min(camera, views.size() - 1)]; }
  pipeline::ProvedView figuresOf(std::size_t camera) const {
    return pipeline::viewOf(figures, std::min(camera, figures.others.size()));
  }
  QDateTime taken;
  /// What it was taken of: with other content, another measurement, threshold or clusters it proves nothing.
  pipeline::ContentSettings content;
  std::string measured;
  std::string shownFrom;  // see Session::shownFrom(); empty: nobody kept it
  QString picture;        // as the playlist has it; empty: nobody kept it

  bool isAsPredicted() const { return pipeline::isAsPredicted(figures); }
};

/// What can be proved of a venue: by a photograph of the content, by photographs of the test patterns, and on
/// paper; and what is done where it no longer is as it was measured. One at a time, on another thread.
class OutputProof : public QObject {
  Q_OBJECT

 public:
  enum class Work { none, photograph, drift, repair, report };

  /// `step`: that the devices are used by.
  OutputProof(Session& session, const StepName& step, QObject* parent = nullptr);
  ~OutputProof() override { job_.cancel(); }

  Work work() const { return job_.isRunning() ? work_ : Work::none; }
  QString stage() const { return job_.stage(); }
  double fraction() const { return job_.fraction(); }
  /// Why nothing is proved now, a short sentence; empty: devices and light transport are free.
  QString whyNot() const;
  bool isPossible() const { return whyNot().isEmpty(); }
  /// A dozen patterns one after the other: people must know.
  bool mayFlash() const { return session_.mayMeasure(); }

  /// The last photograph, perhaps out of date.
  const std::shared_ptr<const Proof>& proof() const { return proof_; }
  /// There is one, of something else than is shown now.
  bool isOutOfDate() const { return proof_ && !holds(*proof_); }
  const std::optional<pipeline::DriftRecord>& drift() const { return drift_; }
  /// The same where no photograph was taken later, which says more; else none.
  const pipeline::DriftRecord* newestDrift() const;
  /// The test patterns fitted shortly before the last photograph, which was not as predicted all the same:
  /// few patterns miss small parts.
  bool isCheckContradicted() const;
  /// The last photograph was not as predicted, and nothing was found since that says why.
  bool isUnsettled() const;
  /// What the last repair here came to; none: there was none since the calibration was opened or changed.
  const std::optional<pipeline::RepairResult>& repair() const { return repair_; }
  /// It was tried in vain, and nothing else was found since.
  bool isBeyondRepair() const { return repair_ && repair_->end == pipeline::RepairEnd::notBetter; }
  /// What is used was repaired: of what, and what that gained. None: it was measured so.
  std::optional<calibration::RepairNote> repairNote() const;
  /// When that was, ISO 8601, UTC.
  std::string repairedAt() const;
  /// What is to be done next to prove the venue, or about what was found.
  enum class Next { photograph, install, pushBack, checkDrift, repair, measureAgain, aimAgain };
  Next next() const;
  /// Where it looked elsewhere before, as somebody saw or the last photograph showed, the camera was pushed
  /// back: what was found before that holds no more.
  void cameraAtItsPlace(bool wasSeenElsewhere);
  /// It was pushed back, since the last photograph.
  bool wasPushedBack() const { return pushedBack_; }
  /// It was seen to look so many pixels elsewhere, and left there.
  void cameraLeft(double pixels);
  /// By so much, pixels; none: nobody has seen that since the last photograph.
  std::optional<double> leftElsewhere() const;

  /// `picture`, a file or resource, as a show has it on that canvas: perfected, if it is.
  void photograph(const QString& picture, const Canvas& canvas);
  void checkDrift();
  /// Makes the calibration fit what the venue has become; `picture`, a file or resource, proves it.
  void startRepair(const QString& picture);
  /// The measurement from before the repair is used again.
  void undoRepair();
  /// Written into the calibration's folder as report.html and report.pdf, and support.zip for whoever helps;
  /// reported() names the first.
  void report(const QString& picture);
  void cancel() { job_.cancel(); }
  bool isStopping() const { return job_.isStopping(); }
  /// That flashed was ended, since the room was no longer said to be clear; until something is begun again.
  Work endedUnclear() const { return endedUnclear_ && !job_.isRunning() ? work_ : Work::none; }

 Q_SIGNALS:
  /// What is proved, or whether it is being proved.
  void changed();
  void progressed();
  /// In any way, before failed() or reported().
  void ended(gui::OutputProof::Work work);
  void failed(const gui::Failure& failure);
  void reported(const QString& file);

 private:
  void start(Work work, Job::Work job);
  void finished();
  void recall();
  void recallDrift();
  bool holds(const Proof& proof) const;
  const Proof* current() const { return proof_ && holds(*proof_) ? proof_.get() : nullptr; }
  void look();
  /// The photograph shows that the camera was bumped which can be pushed back, the first.
  static bool showsItMoved(const Proof& proof);

  Session& session_;
  StepName step_;
  DeviceLease lease_;
  Job job_;
  Work work_ = Work::none;
  std::shared_ptr<const Proof> proof_;
  std::optional<pipeline::DriftRecord> drift_;
  std::string driftOf_;  // the measurement that it was looked for of
  std::optional<pipeline::RepairResult> repair_;
  std::string repairOf_;  // the measurement that `repair_` left
  QDateTime repairTried_;
  bool wasOutOfDate_ = false;
  bool pushedBack_ = false;  // since the last photograph
  std::optional<double> leftElsewhere_;
  std::string leftBy_;  // the measurement by which that is elsewhere
  bool endedUnclear_ = false;
  struct Found;
  std::shared_ptr<Found> found_;  // by the job
};

}  // namespace relucent::gui
