// SPDX-License-Identifier: MIT
#pragma once

#include <QTimer>
#include <memory>

#include "jobs/job.h"
#include "jobs/time_left.h"
#include "linearization/linearization.h"
#include "wizard/acquisition_trace.h"
#include "wizard/asking.h"
#include "wizard/device_page.h"

namespace relucent {

/// How finely the light transport is measured.
enum class Fineness { fast, usual, fine };

/// Step 4: the light transport, photograph by photograph.
class AcquirePage : public DevicePage {
  Q_OBJECT

 public:
  explicit AcquirePage(Session& session, QObject* parent = nullptr);
  ~AcquirePage() override;

  QString name() const override { return tr("Acquire"); }
  QString subtitle() const override {
    return tr("Measure how every projector pixel lights every camera pixel. Leave the room dark and still.");
  }
  StepStatus status() const override;
  QString hint() const override;
  QString cause() const override { return session_.mayMeasure() ? QString() : "room-is-clear"; }
  Command primary() const override;
  std::vector<Command> secondary() const override;
  std::optional<double> progress() const override;
  std::optional<Banner> banner() const override;
  void finish() override;

  bool isMeasuring() const { return job_.isRunning(); }
  bool isPaused() const { return isMeasuring() && session_.live().isPaused(); }
  bool isStopping() const { return job_.isStopping(); }
  QString stage() const { return job_.stage(); }
  /// Of the shown projector and camera.
  LivePictures pictures() const { return session_.live().pictures(projector(), camera()); }
  /// Photographs of earlier runs that are in the journal, and all that there are by now.
  int keptBefore() const { return kept_; }
  int photographs() const;
  /// Seconds that it still takes; none before enough is known.
  std::optional<double> secondsLeft() const;
  const std::optional<WorkLeft>& forecast() const { return forecast_; }
  /// Photographs a second, over the last ones.
  double rate() const { return rate_; }

  Fineness fineness() const;
  void setFineness(Fineness fineness);
  bool isWhite() const { return session_.settings().acquisition.colours == LitColours::white; }
  void setWhite(bool white);
  /// What the checks of this measurement said, or of the last one.
  const AcquisitionTrace& trace() const { return trace_; }
  /// How often light and view are compared, and what follows.
  QString watching() const;
  /// What it cost, as far as the folder tells: "patterns", "seconds", ...
  std::optional<double> figure(const char* name) const;
  /// Error of patterns that were only predicted, relative; none before it was measured.
  std::optional<double> verificationError() const;
  /// What is worth knowing of the measurement, in sentences.
  QStringList findings() const;
  /// What measuring with these settings will about take, by what the response took; none before that.
  std::optional<WorkLeft> expected() const;

  void pause();
  void resume();
  void stopAndKeep();

 Q_SIGNALS:
  /// It has ended, in any way.
  void measured();

 private:
  void start();
  void change(const QString& what, const AcquisitionSettings& settings);
  void keep(const AcquisitionSettings& settings);
  void askAbout(const Alarm& alarm);
  void answer(Answer answer);
  void ended();
  void tick();
  void lookAtResponse();

  std::shared_ptr<Asking> asking_;
  AcquisitionTrace trace_;
  TimeLeft left_;
  std::optional<WorkLeft> forecast_;
  std::optional<Linearization> response_;
  std::string responseStored_;  // when that was
  int kept_ = 0;
  QTimer second_;
  double rate_ = 0.0;
  int lastCount_ = 0;
  Job job_;  // the last: it ends before what its work uses
};

}  // namespace relucent
