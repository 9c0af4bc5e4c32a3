// SPDX-License-Identifier: MIT
// While one step measures: what other pages show, what they cannot change, and what does not end it.
#include <QSignalSpy>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "output/default_picture.h"
#include "relucent/calibration/results.h"
#include "views/number_text.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/cluster/cluster_page.h"
#include "wizard/frame/step_rail.h"
#include "wizard/frame/wizard.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/output/output_proof.h"
#include "wizard/preview/preview_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;

class TestWhileMeasuring : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    own_ = std::make_unique<SimulatedSession>();
    session_ = &own_->session;
  }

  /// Law: what a step measures with, no other step changes meanwhile, and nobody else is blamed for it.
  void whatIsMeasuredWithIsNotChangedMeanwhile() {
    own_->begin();
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
    own_->begin(smallVenue(), "other");
    own_->begin();
    AcquirePage page(*session_);
    VenuePage venue(*session_, RecentVenues(own_->settings));
    QSignalSpy asked(&venue, &PageModel::failed);
    page.primary()->trigger();
    QVERIFY(page.isMeasuring());
    for (bool ends : {false, true}) {
      venue.open(own_->folder.filePath("other"));
      QCOMPARE(asked.size(), 1);
      const auto question = asked.takeFirst().front().value<FailureReport>();
      QVERIFY(question.isQuestion && question.resume && question.goOn);
      QVERIFY(question.failure.what.contains(page.name()) && !question.safe.isEmpty());
      QVERIFY(page.isMeasuring() && session_->name() == "venue");
      (ends ? question.goOn : question.resume)->trigger();
      QCOMPARE(session_->name(), QString(ends ? "other" : "venue"));
    }
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    venue.open(own_->folder.filePath("venue"));
    QVERIFY(asked.isEmpty() && session_->name() == "venue");
  }

  /// Law: measured again or stopped early, what follows is looked at with the earlier or coarser result, and
  /// says so; it is kept once the measurement has ended.
  void laterStepsUseWhatThereIs() {
    own_->begin(smallVenue({96, 72}));
    AcquirePage acquire(*session_);
    ThresholdPage threshold(*session_);
    Wizard wizard(*session_);
    wizard.add(acquire);
    wizard.add(threshold);
    measureUntilStopped(acquire);
    QVERIFY(wizard.go(1));
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
    // It was chosen by coarser light.
    QCOMPARE(threshold.status().state, StepState::outOfDate);
    QVERIFY(threshold.banner().has_value());
    threshold.primary()->trigger();
    QCOMPARE(threshold.status().state, StepState::done);
    QVERIFY(!threshold.banner());
  }

  /// Law: stopped early is a state of its own on every page and in the rail, with the way to go on; what
  /// followed from it is out of date once it has gone on, and shows nothing of the coarse measurement.
  void stoppedEarlyIsAStateOfItsOwnEverywhere() {
    own_->begin(smallVenue({96, 72}));
    AcquirePage acquire(*session_);
    ThresholdPage threshold(*session_);
    ClusterPage cluster(*session_);
    PreviewPage preview(*session_);
    Wizard wizard(*session_);
    const std::vector<PageModel*> pages{&acquire, &threshold, &cluster, &preview};
    for (PageModel* page : pages) wizard.add(*page);
    StepRail rail(wizard, *session_);
    const auto inRail = [&rail](int step) {
      return rail.findChild<QAbstractButton*>(QString("step-%1").arg(step))->accessibleName();
    };
    measureUntilStopped(acquire);
    session_->decide(ThresholdResult{.energyKept = 0.98});
    session_->decide(ClusteringResult{.clusters = 12});
    session_->decide(ContentResult{.reachable = 0.5});
    for (int i = 0; i < 4; ++i) {
      QCOMPARE(pages[static_cast<std::size_t>(i)]->status().state, StepState::coarse);
      QVERIFY2(inRail(i + 1).contains(StepRail::tr("stopped early")), qPrintable(inRail(i + 1)));
      const std::optional<Banner> banner = pages[static_cast<std::size_t>(i)]->banner();
      QVERIFY(banner && banner->kind == Banner::Kind::amber && banner->command);
      QVERIFY2(banner->sentence.contains(QString::number(acquire.stoppedAt())), qPrintable(banner->sentence));
      // Elsewhere it leads to the page where it begins, and says so.
      const bool isHere = pages[static_cast<std::size_t>(i)] == &acquire;
      QCOMPARE(banner->command->text(), QString(isHere ? "Go on measuring" : "Go on at Acquire"));
    }
    QVERIFY(wizard.go(1));
    QTRY_VERIFY_WITH_TIMEOUT(threshold.kept().has_value(), patience);
    QVERIFY(wizard.go(2));
    QTRY_VERIFY_WITH_TIMEOUT(cluster.result() && !cluster.isComputing(), patience);
    const std::shared_ptr<const ClusterResult> coarse = cluster.result();
    const std::uint64_t leaves = threshold.kept()->leaves;

    // Gone on with while Cluster is looked at. What was read is let go of before what is new has been read.
    bool wasLetGoOf = false;
    connect(session_, &Session::acquisitionChanged, this, [&] {
      if (!session_->acquisition()) wasLetGoOf = !cluster.result() && !threshold.kept() && !threshold.whole();
    });
    acquire.banner()->command->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    QCOMPARE(acquire.status().state, StepState::done);
    for (std::size_t i = 1; i < 4; ++i) QCOMPARE(pages[i]->status().state, StepState::outOfDate);
    QVERIFY(wasLetGoOf);
    QTRY_VERIFY_WITH_TIMEOUT(cluster.result() && !cluster.isComputing(), patience);
    QVERIFY(cluster.result() != coarse);
    QTRY_VERIFY_WITH_TIMEOUT(threshold.kept().has_value(), patience);
    QVERIFY(threshold.kept()->leaves > leaves);
    QVERIFY(wizard.go(1));
    threshold.primary()->trigger();
    QCOMPARE(threshold.status().state, StepState::done);
  }

  void whatNobodyShouldBeContentWithIsDoubtfulEverywhere_data() {
    QTest::addColumn<double>("expected");     // dB
    QTest::addColumn<double>("leftOut");      // share of the camera pixels
    QTest::addColumn<double>("overexposed");  // likewise
    QTest::addColumn<QString>("figure");
    QTest::addColumn<QString>("step");
    QTest::newRow("fits nothing") << -10.0 << 0.0 << 0.0 << decimalText(-10.0, 0) + " dB" << "dB expected";
    QTest::newRow("too bright") << 30.0 << 0.5 << 0.5 << percentText(0.5) << "too bright";
    QTest::newRow("does not fit in places") << 30.0 << 0.5 << 0.0 << percentText(0.5) << "left out";
  }
  /// Law: a measurement by which pictures would be no better than uncorrected, or that leaves much of the
  /// view out, has no tick anywhere: it is amber in the rail and above every page, with its figure, and
  /// measuring again is the primary way on; the other stays open.
  void whatNobodyShouldBeContentWithIsDoubtfulEverywhere() {
    QFETCH(double, expected);
    QFETCH(double, leftOut);
    QFETCH(double, overexposed);
    QFETCH(QString, figure);
    QFETCH(QString, step);
    own_->begin();
    AcquirePage acquire(*session_);
    ThresholdPage threshold(*session_);
    ClusterPage cluster(*session_);
    PreviewPage preview(*session_);
    Wizard wizard(*session_);
    const std::vector<PageModel*> pages{&acquire, &threshold, &cluster, &preview};
    for (PageModel* page : pages) wizard.add(*page);
    StepRail rail(wizard, *session_);
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    QCOMPARE(acquire.status().state, StepState::done);
    QVERIFY(!acquire.banner() && acquire.primary()->text() == "Show threshold");
    {
      CalibrationFolder folder = CalibrationFolder::open(session_->path(), CalibrationFolder::Access::write);
      const StageResult stored = *folder.latest(Stage::acquisition);
      transport::Acquisition measured = loadAcquisition(stored);
      measured.expected = transport::ExpectedQuality{expected, expected};
      const auto flagged =
          static_cast<std::ptrdiff_t>(leftOut * static_cast<double>(measured.flagged.size()));
      std::fill(measured.flagged.begin(), measured.flagged.begin() + flagged, std::uint8_t{1});
      std::fill(measured.flagged.begin() + flagged, measured.flagged.end(), std::uint8_t{0});
      measured.overexposed = overexposed;
      storeAcquisition(folder, stored.inputs, measured, resultFrom<Stage::acquisition>(stored).cost.value());
    }
    session_->reload();
    session_->decide(ThresholdResult{.energyKept = 0.98});
    session_->decide(ClusteringResult{.clusters = 12});
    session_->decide(ContentResult{.reachable = 0.5});
    for (std::size_t i = 0; i < pages.size(); ++i) {
      QCOMPARE(pages[i]->status().state, StepState::doubtful);
      const auto* button = rail.findChild<QAbstractButton*>(QString("step-%1").arg(i + 1));
      QVERIFY2(button->accessibleName().contains(StepRail::tr("doubtful")),
               qPrintable(button->accessibleName()));
      const std::optional<Banner> banner = pages[i]->banner();
      QVERIFY(banner && banner->kind == Banner::Kind::amber);
      const QString said = banner->sentence + ' ' + banner->more;
      QVERIFY2(said.contains(figure), qPrintable(said));
      QCOMPARE(banner->command == nullptr, pages[i] == &acquire);
    }
    QVERIFY2(acquire.status().result.contains(step), qPrintable(acquire.status().result));
    // Nothing is promised of what test patterns contradict.
    QCOMPARE(acquire.expectedQuality().has_value(), leftOut == overexposed);
    QCOMPARE(acquire.primary()->text(), QString("Measure again"));
    QCOMPARE(acquire.secondary().size(), std::size_t{1});
    QVERIFY(wizard.go(1));
    threshold.banner()->command->trigger();
    QCOMPARE(wizard.current(), std::size_t{0});
    acquire.primary()->trigger();
    QVERIFY(acquire.isMeasuring());
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    QCOMPARE(acquire.status().state, StepState::done);
    QVERIFY(!acquire.banner());
  }

  /// Law: while it is measured again, what the earlier measurement came to is looked at on every page that
  /// follows, also where that was not prepared before.
  void earlierResultsAreLookedAtMeanwhile() {
    own_->begin();
    AcquirePage acquire(*session_);
    ThresholdPage threshold(*session_);
    ClusterPage cluster(*session_);
    PreviewPage preview(*session_);
    Wizard wizard(*session_);
    for (PageModel* page : std::initializer_list<PageModel*>{&acquire, &threshold, &cluster, &preview})
      wizard.add(*page);
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    session_->decide(ThresholdResult{.energyKept = 0.98});
    session_->decide(ClusteringResult{.clusters = 12});
    QSignalSpy failed(&preview, &PageModel::failed);
    session_->live().setLeastInterval(500);
    acquire.secondary().front()->trigger();
    QVERIFY(acquire.isMeasuring());
    QVERIFY(wizard.go(1));
    QTRY_VERIFY_WITH_TIMEOUT(threshold.kept().has_value(), patience);
    QVERIFY(wizard.go(2));
    QTRY_VERIFY_WITH_TIMEOUT(cluster.result() && !cluster.isComputing(), patience);
    QVERIFY(wizard.go(3));
    QTRY_VERIFY_WITH_TIMEOUT(preview.preview() || !failed.isEmpty(), patience);
    QVERIFY2(failed.isEmpty(),
             qPrintable(failed.isEmpty() ? QString()
                                         : failed.front().front().value<FailureReport>().failure.details));
    QVERIFY(acquire.isMeasuring() && session_->devicesUser() == AcquirePage::stepName);
    for (const PageModel* page : std::initializer_list<const PageModel*>{&threshold, &cluster, &preview}) {
      QVERIFY(!page->primary()->isEnabled());
      QVERIFY2(page->hint().contains(acquire.name()), qPrintable(page->hint()));
    }
    session_->live().setLeastInterval(0);
    acquire.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    // And where measuring again has not ended, by a page that knows nothing yet.
    QCOMPARE(acquire.status().state, StepState::outOfDate);
    PreviewPage another(*session_);
    QSignalSpy failedThere(&another, &PageModel::failed);
    session_->open(session_->path());
    another.enter();
    QTRY_VERIFY_WITH_TIMEOUT(another.preview() || !failedThere.isEmpty(), patience);
    QVERIFY(failedThere.isEmpty());
    QVERIFY(another.banner().has_value());
    acquire.returnToEarlier();
    QCOMPARE(acquire.status().state, StepState::done);
    session_->wantAcquisition();
    QTRY_VERIFY_WITH_TIMEOUT(session_->acquisition() || session_->acquisitionFailure(), patience);
    QVERIFY(session_->acquisition() != nullptr);
  }

  /// Law: settings of another measurement than the one there is make what follows out of date; it is looked
  /// at meanwhile, and no page fails.
  void otherSettingsMakeWhatFollowsOutOfDate() {
    own_->begin();
    AcquirePage acquire(*session_);
    PreviewPage preview(*session_);
    Wizard wizard(*session_);
    wizard.add(acquire);
    wizard.add(preview);
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    session_->decide(ThresholdResult{.energyKept = 0.98});
    session_->decide(ContentResult{.reachable = 0.5});
    QSignalSpy failed(&preview, &PageModel::failed);
    acquire.setFineness(Fineness::fine);
    QCOMPARE(acquire.status().state, StepState::outOfDate);
    QCOMPARE(preview.status().state, StepState::outOfDate);
    QVERIFY(wizard.go(1));
    QTRY_VERIFY_WITH_TIMEOUT(preview.preview() || !failed.isEmpty(), patience);
    QVERIFY2(failed.isEmpty(),
             qPrintable(failed.isEmpty() ? QString()
                                         : failed.front().front().value<FailureReport>().failure.details));
    const std::optional<Banner> banner = preview.banner();
    QVERIFY(banner && banner->kind == Banner::Kind::amber && banner->sentence.contains("out of date"));
  }

  /// Law: measuring again is taken back as a whole, once somebody has said so who knows that the new
  /// photographs are lost by it: the earlier result stands, and what followed from it.
  void measuringAgainIsTakenBack() {
    own_->begin();
    AcquirePage acquire(*session_);
    ThresholdPage threshold(*session_);
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    session_->decide(ThresholdResult{.energyKept = 0.98});
    const StepState decided = threshold.status().state;
    QVERIFY(decided != StepState::open && decided != StepState::outOfDate);
    const std::string measured = session_->measurement();
    const auto commandNamed = [&acquire](const QString& text) -> PageCommand* {
      for (PageCommand* command : acquire.secondary())
        if (command->text() == text) return command;
      return nullptr;
    };
    const QString back = AcquirePage::tr("Keep the earlier one");
    for (bool isMeasuring : {true, false}) {
      QVERIFY(!commandNamed(back));
      commandNamed(AcquirePage::tr("Measure again"))->trigger();
      QVERIFY(acquire.isMeasuring() && commandNamed(back)->isEnabled());
      QTRY_VERIFY_WITH_TIMEOUT(acquire.photographs() > 3, patience);
      if (!isMeasuring) {
        acquire.finish();
        QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
        QCOMPARE(acquire.status().state, StepState::outOfDate);
        QCOMPARE(threshold.status().state, decided);  // it is of what is used meanwhile
      }
      QSignalSpy asked(&acquire, &PageModel::failed);
      commandNamed(back)->trigger();
      QCOMPARE(asked.size(), 1);
      const auto question = asked.front().front().value<FailureReport>();
      QVERIFY(question.isQuestion && question.reason);
      QVERIFY(isMeasuring ? acquire.isMeasuring() : acquire.status().state == StepState::outOfDate);
      QCOMPARE(question.failure.heading, AcquirePage::tr("Keep the earlier measurement?"));
      question.resume->trigger();
      QVERIFY(!question.reason && commandNamed(back)->isEnabled());
      commandNamed(back)->trigger();
      asked.back().front().value<FailureReport>().goOn->trigger();
      QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
      QCOMPARE(acquire.status().state, StepState::done);
      QCOMPARE(threshold.status().state, StepState::done);
      QCOMPARE(session_->measurement(), measured);
      QVERIFY(session_->areDevicesFree() && !acquire.banner());
    }
  }

  /// Law: also the camera's checks light the room only when it is clear; said to be, they begin by
  /// themselves.
  void checksWaitUntilTheRoomIsClear() {
    own_->begin(scriptedVenue("true {image}", "sleep 8 # {exposure} {output}"));
    CameraPage camera(*session_);
    camera.enter();
    QVERIFY(!camera.isLooking() && camera.hasRemedy());
    // As they begin with the consent, that is said first, and said once.
    QCOMPARE(camera.hint(), QString("Confirm that the room is clear: the checks begin with that."));
    QCOMPARE(camera.secondary().front()->whyNot(), camera.hint());
    session_->setRoomClear(true);
    QVERIFY(camera.isLooking() && !camera.hasRemedy());
    camera.leave();
    QTRY_VERIFY_WITH_TIMEOUT(!camera.isLooking(), 2'000);
    // Stopped is stopped: the consent that is still there begins nothing.
    session_->setRoomClear(true);
    QVERIFY(!camera.isLooking());
  }

  /// Law: who takes the consent back ends the checks; they wait for it again.
  void checksEndWithTheConsent() {
    own_->begin(scriptedVenue("true {image}", "sleep 8 # {exposure} {output}"));
    session_->setRoomClear(true);
    CameraPage camera(*session_);
    camera.enter();
    QVERIFY(camera.isChecking());
    session_->setRoomClear(false);
    QTRY_VERIFY_WITH_TIMEOUT(!camera.isLooking() && session_->areDevicesFree(), 2'000);
    QVERIFY(camera.hasRemedy() && !camera.hint().isEmpty());
    QCOMPARE(camera.secondary().front()->whyNot(), camera.hint());
    session_->setRoomClear(true);
    QVERIFY(camera.isChecking());
    camera.leave();
  }

  /// Law: whatever flashes ends when the room is no longer clear, at whichever page; what needs a few
  /// pictures that stand does not.
  void lightEndsWithTheConsent_data() {
    QTest::addColumn<OutputProof::Work>("work");
    QTest::addColumn<bool>("ends");
    QTest::newRow("check for drift") << OutputProof::Work::drift << true;
    QTest::newRow("repair") << OutputProof::Work::repair << true;
    QTest::newRow("photograph") << OutputProof::Work::photograph << false;
  }
  void lightEndsWithTheConsent() {
    QFETCH(OutputProof::Work, work);
    QFETCH(bool, ends);
    own_->begin(scriptedVenue("true {image}", "sleep 8 # {exposure} {output}"));
    session_->setRoomClear(true);
    OutputProof proof(*session_, CameraPage::stepName);
    if (work == OutputProof::Work::drift) proof.checkDrift();
    if (work == OutputProof::Work::repair) proof.startRepair(defaultPicture());
    if (work == OutputProof::Work::photograph) proof.photograph(defaultPicture(), {});
    QCOMPARE(proof.work(), work);
    session_->setRoomClear(false);
    QCOMPARE(proof.isStopping(), ends);
    proof.cancel();
    QTRY_VERIFY_WITH_TIMEOUT(session_->areDevicesFree(), 2'000);
    // What ended without a result is said until something is begun again.
    QCOMPARE(proof.endedUnclear(), ends ? work : OutputProof::Work::none);
    session_->setRoomClear(true);
    proof.photograph(defaultPicture(), {});
    QCOMPARE(proof.endedUnclear(), OutputProof::Work::none);
    proof.cancel();
    QTRY_VERIFY_WITH_TIMEOUT(session_->areDevicesFree(), 2'000);
  }

  /// Law: a measurement that ends shows patterns, too: it pauses, and goes on to its end with the consent.
  void whatEndsWaitsForTheConsentToo() {
    own_->begin(scriptedVenue("true {image}", "sleep 8 # {exposure} {output}"));
    session_->setRoomClear(true);
    AcquirePage page(*session_);
    page.setSecondsToLeave(0);
    page.primary()->trigger();
    QVERIFY(page.isMeasuring() && !page.isPaused());
    page.stopAndKeep();
    QVERIFY(page.isStopping() && !page.isPaused());
    session_->setRoomClear(false);
    QVERIFY(page.isPaused());
    page.stopAndKeep();  // once more is no consent
    QVERIFY(page.isPaused());
    const auto resume = [&page] {
      for (PageCommand* command : page.secondary())
        if (command->text() == AcquirePage::tr("Resume")) return command;
      return static_cast<PageCommand*>(nullptr);
    };
    QVERIFY(resume() && !resume()->isEnabled());
    session_->setRoomClear(true);
    QVERIFY(page.isPaused() && resume() && resume()->isEnabled());
    resume()->trigger();
    QVERIFY(!page.isPaused());
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), 2'000);
  }

  /// Law: a photograph that does not come is said before anything fails.
  void aSilentCameraIsSaid() {
    own_->begin(scriptedVenue("true {image}", "sleep 8 # {exposure} {output}"));
    session_->setRoomClear(true);
    CameraPage camera(*session_);
    Wizard wizard(*session_);
    wizard.add(camera);
    QSignalSpy failed(&camera, &PageModel::failed);
    camera.enter();
    QVERIFY(camera.isLooking() && !wizard.banner() && !wizard.statusOf(0).isHeldUp);
    QTRY_VERIFY_WITH_TIMEOUT(wizard.statusOf(0).isHeldUp, 20'000);
    QVERIFY(wizard.banner().has_value() && failed.isEmpty());
    QVERIFY(wizard.banner()->kind == Banner::Kind::amber);
    // Nobody waits for its driver: the script sleeps on.
    camera.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!camera.isLooking(), 2'000);
    QVERIFY(!session_->isCameraSilent() && !wizard.banner());
  }

 private:
  static void measureUntilStopped(AcquirePage& acquire) {
    const QMetaObject::Connection stopping =
        connect(&acquire.trace(), &AcquisitionTrace::changed, &acquire, [&acquire] {
          if (acquire.isMeasuring() && !acquire.isStopping() && !acquire.trace().growth().levels.empty())
            acquire.stopAndKeep();
        });
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    disconnect(stopping);
    QVERIFY(acquire.stoppedAt() > 1);
  }

  std::unique_ptr<SimulatedSession> own_;
  Session* session_ = nullptr;
};

QTEST_MAIN(TestWhileMeasuring)
#include "test_while_measuring.moc"
