// SPDX-License-Identifier: MIT
// While one step measures: what other pages show, what they cannot change, and what does not end it.
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/frame/wizard.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

constexpr int patience = 120'000;  // ms for a small measurement on a busy machine

CalibrateSettings simulated() {
  VenueSettings venue;
  venue.name = "plain";
  venue.projector = {48, 36};
  venue.camera = {40, 30};
  venue.pathsPerPixel = 16;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = 9;
  return settings;
}

}  // namespace

class TestWhileMeasuring : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    session_ = std::make_unique<Session>(std::filesystem::path(folder_->filePath("cache").toStdString()));
  }

  /// Law: what a step measures with, no other step changes meanwhile, and nobody else is blamed for it.
  void whatIsMeasuredWithIsNotChangedMeanwhile() {
    session_->begin(folder_->filePath("venue").toStdString(), simulated());
    AcquirePage page(*session_);
    LinearizePage linearize(*session_);
    QSignalSpy failed(&linearize, &PageModel::failed), failedHere(&page, &PageModel::failed);
    const int levels = linearize.levels();
    linearize.setLevels(17);
    QVERIFY(linearize.whyLocked().isEmpty());
    page.primary()->trigger();
    QVERIFY(page.isMeasuring() && session_->isMeasuring());
    QVERIFY2(linearize.whyLocked().contains(page.name()), qPrintable(linearize.whyLocked()));
    linearize.setLevels(33);
    linearize.undoStack().undo();
    QCOMPARE(linearize.levels(), 17);
    QVERIFY(!page.whyLocked().isEmpty());
    page.setFineness(Fineness::fast);
    page.setKeptPhotographs(KeptPhotographs::results);
    QCOMPARE(page.fineness(), Fineness::usual);
    QCOMPARE(page.keptPhotographs(), KeptPhotographs::everything);
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QCOMPARE(failed.size() + failedHere.size(), 0);
    linearize.setLevels(levels);
    QCOMPARE(linearize.levels(), levels);
  }

  /// Law: a measurement that is under way is ended by an answer only.
  void anotherVenueEndsAMeasurementOnlyWhenToldTo() {
    session_->begin(folder_->filePath("other").toStdString(), simulated());
    session_->begin(folder_->filePath("venue").toStdString(), simulated());
    AcquirePage page(*session_);
    QSettings settings(folder_->filePath("settings.ini"), QSettings::IniFormat);
    VenuePage venue(*session_, RecentVenues(settings));
    QSignalSpy asked(&venue, &PageModel::failed);
    page.primary()->trigger();
    QVERIFY(page.isMeasuring());
    for (bool ends : {false, true}) {
      venue.open(folder_->filePath("other"));
      QCOMPARE(asked.size(), 1);
      const auto question = asked.takeFirst().front().value<FailureReport>();
      QVERIFY(question.isQuestion && question.resume && question.goOn);
      QVERIFY(question.failure.what.contains(page.name()) && !question.safe.isEmpty());
      QVERIFY(page.isMeasuring() && session_->name() == "venue");
      (ends ? question.goOn : question.resume)->trigger();
      QCOMPARE(session_->name(), QString(ends ? "other" : "venue"));
    }
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    venue.open(folder_->filePath("venue"));
    QVERIFY(asked.isEmpty() && session_->name() == "venue");
  }

  /// Law: measured again or stopped early, what follows is looked at with the earlier or coarser result, and
  /// says so; it is kept once the measurement has ended.
  void laterStepsUseWhatThereIs() {
    CalibrateSettings settings = simulated();
    std::get<VenueSettings>(settings.rig).projector = {96, 72};
    session_->begin(folder_->filePath("venue").toStdString(), settings);
    AcquirePage acquire(*session_);
    ThresholdPage threshold(*session_);
    Wizard wizard(*session_);
    wizard.add(acquire);
    wizard.add(threshold);
    const QMetaObject::Connection stopping =
        connect(&acquire.trace(), &AcquisitionTrace::changed, &acquire, [&acquire] {
          if (acquire.isMeasuring() && !acquire.isStopping() && !acquire.trace().growth().levels.empty())
            acquire.stopAndKeep();
        });
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    disconnect(stopping);
    QVERIFY(acquire.stoppedAt() > 1 && wizard.go(1));
    // Coarse blocks differ from the test patterns by themselves: nothing need have moved.
    QCOMPARE(acquire.findings().size(), 1);
    QVERIFY2(acquire.findings().front().contains(QString::number(acquire.stoppedAt())),
             qPrintable(acquire.findings().front()));
    session_->wantAcquisition();
    QTRY_VERIFY_WITH_TIMEOUT(threshold.kept().has_value(), patience);
    const Banner banner = threshold.banner().value();
    QVERIFY2(banner.sentence.contains(QString::number(acquire.stoppedAt())), qPrintable(banner.sentence));
    session_->decide(ThresholdResult{.energyKept = 0.98});
    QCOMPARE(threshold.status().state, StepState::coarse);
    QVERIFY(threshold.primary()->isEnabled());
    banner.command->trigger();
    QCOMPARE(wizard.current(), std::size_t{0});

    acquire.banner()->command->trigger();
    QVERIFY(acquire.isMeasuring() && wizard.go(1));
    QVERIFY(!threshold.primary()->isEnabled());
    QVERIFY2(threshold.hint().contains(acquire.name()), qPrintable(threshold.hint()));
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    QVERIFY(acquire.stoppedAt() == 0 && !acquire.banner());
    session_->wantAcquisition();
    QTRY_VERIFY_WITH_TIMEOUT(threshold.kept().has_value() && threshold.primary()->isEnabled(), patience);
    QCOMPARE(threshold.status().state, StepState::done);
    QVERIFY(!threshold.banner());
  }

  /// Law: a photograph that does not come is said before anything fails.
  void aSilentCameraIsSaid() {
    CommandRigSettings script;
    script.projector = {64, 48};
    script.camera = {48, 36};
    script.projectorCommand = "true {image}";
    script.cameraCommand = "sleep 8 # {exposure} {output}";
    CalibrateSettings settings;
    settings.rig = script;
    session_->begin(folder_->filePath("venue").toStdString(), settings);
    session_->setRoomClear(true);
    CameraPage camera(*session_);
    QSignalSpy failed(&camera, &PageModel::failed);
    camera.enter();
    QVERIFY(camera.isLooking() && !camera.banner() && !camera.status().isHeldUp);
    QTRY_VERIFY_WITH_TIMEOUT(camera.status().isHeldUp, 20'000);
    QVERIFY(camera.banner().has_value() && failed.isEmpty());
    camera.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!camera.isLooking(), patience);
    QVERIFY(!session_->isCameraSilent() && !camera.banner());
  }

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::unique_ptr<Session> session_;
};

QTEST_MAIN(TestWhileMeasuring)
#include "test_while_measuring.moc"
