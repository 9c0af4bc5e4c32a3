// SPDX-License-Identifier: MIT
#pragma once

#include <QTimer>
#include <memory>

#include "jobs/job.h"
#include "jobs/latest.h"
#include "jobs/room_question.h"
#include "relucent/acquisition/forecast.h"
#include "relucent/base/time_left.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/linearization/linearization.h"
#include "wizard/acquire/acquisition_trace.h"
#include "wizard/acquire/alarm_question.h"
#include "wizard/acquire/photograph_rate.h"
#include "wizard/devices/device_page.h"

namespace relucent::gui {

/// How finely the light transport is measured.
enum class Fineness { fast, usual, fine };

/// Patterns whose blocks have one size: a level of the quadtree.
struct BlockLevel {
  int block = 1;                       // projector pixels along a side
  acquisition::PatternRange patterns;  // of a level that has begun they are known
  int through = 0;
  bool isKnown = false;
  bool isComplete() const { return isKnown && through >= patterns.likely; }
};

/// How far a measurement is, in patterns.
struct PatternCount {
  int taken = 0, expected = 0;
};

/// Step 4: the light transport, photograph by photograph.
class AcquirePage : public DevicePage {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"acquire", "relucent::gui::AcquirePage",
                                     QT_TRANSLATE_NOOP("relucent::gui::AcquirePage", "Acquire")};

  explicit AcquirePage(Session& session, QObject* parent = nullptr);
  ~AcquirePage() override;

  QString subtitle() const override {
    return tr("Measure how every projector pixel lights every camera pixel. Leave the room dark and still.");
  }
  StepStatus status() const override;
  QString hint() const override;
  bool hasRemedy() const override { return !isMeasuring() && needsConsentNow(); }
  PageCommand* primary() const override;
  std::vector<PageCommand*> secondary() const override;
  std::optional<double> progress() const override;
  std::optional<Banner> banner() const override;
  PageCommand* insteadOfWaiting() const override { return isMeasuring() ? keep_ : nullptr; }
  QString whyLocked() const override;
  bool wasInterrupted() const override {
    return !isMeasuring() && again_ > 0 && !(isDone() && !wasEndedEarly());
  }
  void finish() override;

  void enter() override;
  void leave() override { isLookedAt_ = false; }

  bool isMeasuring() const { return job_.isRunning(); }
  /// What was measured is what the settings want.
  bool isDone() const;
  bool isPaused() const { return isMeasuring() && session_.live().isPaused(); }
  /// The measurement waits for room on the disk.
  bool isDiskFull() const { return isMeasuring() && room_.waiting().has_value(); }
  /// By somebody, or by something that is missing.
  bool isHeldUp() const {
    return isPaused() || isDiskFull() || isAsking() || (isMeasuring() && session_.isDeviceLost());
  }
  /// It waits for an answer to an alarm.
  bool isAsking() const { return asking_ != nullptr; }
  /// Photographs that are kept are read, and computed with again, before the first new one is taken.
  bool isReading() const;
  /// Photographs are not taken at the moment, but what they say is worked out.
  bool isWorkingOut() const;
  /// Of those.
  PatternCount reading() const;
  bool isStopping() const { return isMeasuring() && job_.isStopping(); }
  QString stage() const { return job_.stage(); }
  /// Of the shown projector and camera.
  LivePictures pictures() const { return session_.live().pictures(projector(), camera()); }
  /// Photographs since it was started.
  int photographs() const;
  /// As quickly as they are taken now; none while it is held up, and before anybody can tell.
  std::optional<double> photographsAMinute() const { return rate_.perMinute(); }
  /// Patterns, those that were read from the journal included, of as many as are expected by now: more when
  /// patterns are photographed again or levels turn out to need them.
  PatternCount patterns() const;
  /// In all, references and checks included, by the levels that have begun: the one number of what is
  /// expected, whoever shows it. Done, as many as there were.
  int patternsExpected() const;
  /// Seconds that it still takes, by those patterns: it stands still while none is photographed. None before
  /// enough is known, and while the last are computed with. While kept ones are read: of that alone.
  std::optional<double> secondsLeft() const;
  const std::optional<WorkLeft>& forecast() const { return forecast_; }

  Fineness fineness() const;
  void setFineness(Fineness fineness);
  /// What the checks of this measurement said, or of the last one.
  const AcquisitionTrace& trace() const { return trace_; }
  /// What may be expected by now; none before there is a first look, and while what is gone on with is read
  /// and is no finer yet than what is known of it.
  AcquisitionTrace::SharedOutlook outlook() const;
  /// It is that of the measurement that the page is about: not of other settings, nor of another result.
  bool isTraceCurrent() const;
  /// How often light and view are compared, and what follows.
  QString watching() const;
  /// What it cost, as far as the folder tells.
  std::optional<calibration::StageCost> cost() const;
  /// Of the repair since; none: it is as it was measured.
  std::optional<calibration::StageCost> repairCost() const;
  /// It takes the place of an earlier measurement, which can be gone back to.
  bool isMeasuringAgain() const {
    return isMeasuring() && (anew_ || session_.mayReturnToEarlier(calibration::Stage::acquisition));
  }
  /// Error of patterns that were only predicted, relative; none before it was measured.
  std::optional<double> verificationError() const;
  /// How well pictures are expected to be shown with what was measured; none if nobody worked it out, or if
  /// test patterns have shown since that much of it is wrong.
  std::optional<transport::ExpectedQuality> expectedQuality() const;
  /// Side of the finest blocks if it was stopped and kept, projector pixels; 0: nothing is missing.
  int stoppedAt() const { return session_.stoppedAt(); }
  /// It was stopped, or something had changed: it can be gone on with.
  bool wasEndedEarly() const { return session_.wasEndedEarly(); }
  /// It was begun again since, and has not ended: photographs that are in the journal; 0: it was not.
  int photographsOfNew() const { return again_; }
  /// What is worth knowing of the measurement, in sentences.
  QStringList findings() const;
  /// What measuring with these settings will about take, by what the response took; none before that.
  std::optional<WorkLeft> expected() const { return expected(session_.settings().acquisition); }
  /// The same at another fineness.
  std::optional<WorkLeft> expected(Fineness fineness) const { return expected(settingsOf(fineness)); }
  /// By how much what is predicted is then about to be off.
  double expectedDeviation(Fineness fineness) const {
    return acquisition::expectedDeviation(settingsOf(fineness));
  }
  /// Coarsest first: as planned, as far as it is, or as it was, while that is remembered.
  std::vector<BlockLevel> levels() const;
  std::uint64_t freeBytes() const;
  /// Which photographs stay once all is measured.
  pipeline::KeptPhotographs keptPhotographs() const { return session_.keptPhotographs(); }
  void setKeptPhotographs(pipeline::KeptPhotographs kept);
  /// Linear, of the shown camera: as last photographed or as measured. Empty: not yet.
  image::Image floodlight() const;
  /// It is being read.
  bool isFloodlightComing() const { return recalling_.isBusy() && floodlightNumber() == 0; }
  /// It, or T, could not be.
  bool isUnreadable() const;
  /// Another number, another picture; 0: none.
  int floodlightNumber() const;

  /// Before real devices measure, seconds; the first pattern waits for them.
  int secondsToLeave() const { return secondsToLeave_; }
  void setSecondsToLeave(int seconds);
  bool hasSound() const { return sound_; }
  void setSound(bool sound);
  /// The time to leave the room runs.
  bool isCountingDown() const { return leaving_.isActive(); }

  void pause();
  void resume();
  void stopAndKeep();
  /// The earlier measurement is the one again; what was photographed since is set aside, and not used again.
  void returnToEarlier();
  /// The same, once somebody has said that it may be lost.
  void askToReturn();

  /// The surface in full light before the camera moved, with which an alarm waits; empty: nobody knows.
  const image::Image& viewBefore() const { return viewBefore_; }
  /// The alarm's question once more, after something was tried against it, with success or without.
  void askAgain(bool isPutRight = false);

 Q_SIGNALS:
  /// The camera is to be pushed back by viewBefore(); askAgain() is called when that is done.
  void nudgeWanted();
  /// It has ended, in any way.
  void measured();
  /// Somebody has to decide what is done about an alarm, or to make room on the disk.
  void asks();
  void secondsToLeaveChosen(int seconds);
  void soundChosen(bool sound);

 protected:
  void updateCommands() override;

 private:
  static constexpr double openingShare = 0.05;  // of the job
  void makeCommands();
  bool isStale() const;
  bool needsConsentNow() const;
  /// It is whole, and yet nothing would be corrected by it.
  bool isDoubtful() const;
  bool isUseless() const;
  bool isBestGoneBackFrom() const;

  bool hasBetterBefore() const;
  Banner staleBanner() const;
  Banner interruptedBanner() const;
  QString safeSince() const;
  void countKept();
  void start(bool anew);
  void begin();
  void stay();
  Banner stoppedBanner() const;
  Banner changedBanner(const transport::FoundChange& change) const;
  /// Done, and something had changed when it ended: what leads on.
  PageCommand* afterChange() const;
  std::optional<WorkLeft> expected(const acquisition::AcquisitionSettings& settings) const;
  acquisition::AcquisitionSettings settingsOf(Fineness fineness) const;
  /// Before it was measured about as many pixels as the projector has, where the cameras have more.
  Rasters camerasUsed() const;
  void change(const QString& what, const acquisition::AcquisitionSettings& settings);
  void keep(const acquisition::AcquisitionSettings& settings);
  void diskChanged();
  void askAboutAlarm(const sentinels::Alarm& alarm, bool isPutRight = false);
  QString whatAnswersDo(const sentinels::Alarm& alarm, bool mayGoOn) const;
  Banner alarmBanner() const;
  void answer(sentinels::Answer answer);
  PageCommand* answering(Icon icon, sentinels::Answer answer);
  void ended();
  void tick();
  void expect(const WorkLeft& left);
  void lookAtResponse();
  void recall();
  void recallTrace();

  PageCommand *start_, *startNow_, *stay_, *next_, *pause_, *resume_, *keep_, *measureAnew_, *return_;
  PageCommand *returnNow_, *stayWithNew_;                                     // of its question
  PageCommand* goOnWithDisk_;                                                 // of the banner too
  PageCommand* goOnMeasuring_;                                                // of the banner
  PageCommand* answer_;                                                       // of the banner
  PageCommand *retryAlarm_, *keepAtAlarm_, *skipAlarm_, *pushBack_, *retry_;  // of reports
  DeviceLease lease_;
  std::shared_ptr<AlarmQuestion> question_;
  /// Which measurement the trace is of, by what the page is about when that ends.
  struct Traced {
    std::string measurement;
    calibration::StageProgress progress = calibration::StageProgress::open;
    double threshold = 0.0;
    bool operator==(const Traced&) const = default;
  };
  Traced traced() const;

  AcquisitionTrace trace_;
  Traced traced_;
  /// What a measurement left behind that this session did not see.
  struct Recalled {
    std::string measurement;
    std::vector<image::Image> floodlights;  // a camera
    std::optional<pipeline::AcquisitionRecord> record;
  };
  bool isLookedAt_ = false;
  std::string wanted_;      // the measurement that is recalled, or is being read
  std::string unreadable_;  // the measurement that could not be
  Recalled recalled_;
  int recalls_ = 0;
  Latest<Recalled> recalling_;
  std::optional<WorkLeft> forecast_;
  double secondsAPattern_ = 0.0;
  PhotographRate rate_;
  TimeLeft readingTime_;
  int begunAt_ = 0;  // photographs of this session by then
  std::optional<linearization::Linearization> response_;
  std::string responseStored_;  // when that was
  int kept_ = 0, again_ = 0;    // photographs: in the journal; of them, newer than the result
  bool anew_ = false;           // nothing of the last measurement is used again
  bool isFinestDone_ = false;   // what its finest blocks say has been worked out
  bool returns_ = false;        // when it has ended
  QTimer second_;
  QTimer leaving_;  // a second each
  QTimer givingUp_;
  int secondsToLeave_ = 0, secondsLeftToLeave_ = 0;
  bool sound_ = true;
  std::optional<sentinels::Alarm> alarm_;  // the last
  std::unique_ptr<QObject> asking_;        // about it
  std::unique_ptr<QObject> returning_;     // asks whether what is new may go
  image::Image viewBefore_;
  RoomQuestion room_;
  bool diskWasFull_ = false;
  Job job_;  // the last: it ends before what its work uses
};

}  // namespace relucent::gui
