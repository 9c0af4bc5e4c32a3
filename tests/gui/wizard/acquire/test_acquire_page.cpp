// SPDX-License-Identifier: MIT
// The page of acquisition before and while it measures: plan, time to leave, tries by itself.
#include "wizard/acquire/acquire_page.h"

#include <QElapsedTimer>
#include <QLabel>
#include <QSettings>
#include <QSignalSpy>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "jobs/room_question.h"
#include "relucent/pipeline/kept_photographs.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/venue/venue.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "wizard/acquire/acquire_view.h"
#include "wizard/acquire/block_sizes_view.h"
#include "wizard/acquire/outlook_view.h"
#include "wizard/acquire/retrying_observer.h"
#include "wizard/devices/device_selector.h"
#include "wizard/devices/on_measurement.h"
#include "wizard/venue/recent_venues.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::sentinels;
using namespace relucent::venue;

namespace {

CalibrateSettings scripted() {
  return scriptedVenue("show {image}", "photograph {exposure} {output}");
}

}  // namespace

Q_DECLARE_METATYPE(AlarmKind)

class TestAcquirePage : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    own_ = std::make_unique<SimulatedSession>();
    session_ = &own_->session;
  }

  void devicesWithLightWaitUntilTheRoomIsLeft() {
    own_->begin(scripted());
    session_->setRoomClear(true);
    AcquirePage page(*session_);
    page.setSecondsToLeave(60);
    page.primary()->trigger();
    QVERIFY(page.isCountingDown() && !page.isMeasuring());
    QVERIFY(session_->devicesUser() == AcquirePage::stepName);
    QVERIFY(page.status().state == StepState::busy && page.hint().contains("60"));
    // Not now: as if nothing had been pressed.
    QCOMPARE(page.secondary().size(), std::size_t{1});
    page.secondary().front()->trigger();
    QVERIFY(!page.isCountingDown() && !page.isMeasuring() && session_->areDevicesFree());
    // And again, not waiting for the rest of it. The scripts do not exist: it fails, but it has begun.
    page.primary()->trigger();
    QVERIFY(page.isCountingDown());
    QSignalSpy measured(&page, &AcquirePage::measured);
    page.primary()->trigger();
    QVERIFY(!page.isCountingDown());
    QTRY_COMPARE_WITH_TIMEOUT(measured.size(), 1, patience);
    // Whoever comes in meanwhile calls it off, and so does going elsewhere.
    page.primary()->trigger();
    QVERIFY(page.isCountingDown());
    session_->setRoomClear(false);
    QVERIFY(!page.isCountingDown() && session_->areDevicesFree());
    session_->setRoomClear(true);
    page.primary()->trigger();
    QVERIFY(page.isCountingDown());
    session_->close();
    QVERIFY(!page.isCountingDown() && session_->areDevicesFree());
  }

  /// Law: while another program works on the calibration, measuring says so and nothing else happens: what is
  /// shown stays, and it goes once that has ended.
  void anotherProgramIsWaitedFor() {
    own_->begin();
    AcquirePage page(*session_);
    std::vector<FailureReport> told;
    connect(&page, &AcquirePage::failed, &page, [&](const FailureReport& report) { told.push_back(report); });
    {
      const CalibrationFolder theirs =
          CalibrationFolder::open(session_->path(), CalibrationFolder::Access::write);
      page.primary()->trigger();
      QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring() && !told.empty(), patience);
      QCOMPARE(told.size(), std::size_t{1});
      QVERIFY2(told.front().failure.what.contains("Another program"), qPrintable(told.front().failure.what));
      QVERIFY(session_->isOpen() && session_->areDevicesFree() && !page.isDone());
      QVERIFY_EXCEPTION_THROWN(session_->keepPhotographs(pipeline::KeptPhotographs::results), Error);
      QVERIFY(session_->readAgain().has_value());
    }
    QVERIFY(!session_->readAgain());
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(page.isDone());
  }

  /// Law: each level has four times the blocks of the one before; patterns are planned, then known, then
  /// through; a rehearsal waits for nobody.
  void thePlanBecomesWhatWasMeasured() {
    own_->begin();
    AcquirePage page(*session_);
    page.setSecondsToLeave(60);
    QVERIFY(!page.expected(Fineness::usual) && page.floodlightNumber() == 0);
    std::vector<BlockLevel> plan = page.levels();
    QCOMPARE(plan.size(), std::size_t{4});  // from 24 blocks on
    for (std::size_t i = 0; i < plan.size(); ++i) {
      QCOMPARE(plan[i].block, 8 >> i);
      QVERIFY(!plan[i].isKnown && plan[i].patterns.likely > 0.0);
    }
    page.primary()->trigger();
    QVERIFY(page.isMeasuring());
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(page.isDone());
    std::vector<BlockLevel> levels = page.levels();
    QVERIFY(!levels.empty() && levels.size() <= plan.size());
    double patterns = 0.0;
    for (const BlockLevel& level : levels) {
      QVERIFY(level.isComplete());
      patterns += level.through;
    }
    // References, checks and test patterns belong to no level.
    QVERIFY(patterns > 0.0 && patterns < page.cost().value().patterns);
    QVERIFY(page.floodlightNumber() > 0);
    QCOMPARE(page.floodlight().size(), (Size{40, 30}));
  }

  /// Law: beside the choice of one of several devices, titles are read whole, and so is the choice.
  void titlesHaveRoomBesideDevices() {
    CalibrateSettings dome = smallVenue({24, 18}, {20, 16}, 5);
    std::get<VenueSettings>(dome.rig).name = "dome4";
    own_->begin(dome);
    AcquirePage page(*session_);
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    stage->resize(758, 580);  // of a window of 1366 x 768
    stage->show();
    page.primary()->trigger();
    QVERIFY(page.isMeasuring());
    auto* row = stage->findChild<QWidget*>("pattern-view")->parentWidget()->parentWidget();
    QTRY_VERIFY(row->isVisible());
    QCoreApplication::processEvents();
    for (const DeviceSelector* selector : row->findChildren<DeviceSelector*>()) {
      QVERIFY(selector->isVisible());
      QVERIFY2(selector->width() >= selector->sizeHint().width(), qPrintable(selector->currentText()));
      const auto* title = selector->parentWidget()->findChild<QLabel*>();
      QVERIFY2(title->wordWrap() || title->width() >= title->sizeHint().width(), qPrintable(title->text()));
      QVERIFY2(title->height() >= title->heightForWidth(title->width()), qPrintable(title->text()));
    }
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
  }

  /// Law: one count of patterns says how far it is: it never says that all is done while it measures, falls
  /// where more patterns are needed than was expected, and stands still while it is paused, as the time does.
  void progressIsOfThePatternsThatAreExpected() {
    CalibrateSettings settings = smallVenue();
    std::get<VenueSettings>(settings.rig).projector = {96, 72};
    own_->begin(settings);
    AcquirePage page(*session_);
    QVERIFY(!page.progress() && !page.secondsLeft());
    bool isHonest = true;
    double most = 0.0;
    connect(&page, &AcquirePage::progressChanged, this, [&] {
      const std::optional<double> progress = page.progress();
      const PatternCount count = page.patterns();
      if (!progress) return;
      most = std::max(most, *progress);
      // Photographs go on being taken meanwhile.
      const QString said = page.status().result;
      const bool isSaid = said.contains(percentText(*progress)) ||
                          said.contains(percentText(page.progress().value_or(*progress)));
      isHonest = isHonest && *progress < 1.0 && count.taken <= count.expected && isSaid;
      // What is made of the photographs is not told by their number.
      if (page.isWorkingOut()) isHonest = isHonest && !page.secondsLeft();
    });
    page.primary()->trigger();
    session_->live().setLeastInterval(20);
    QTRY_VERIFY_WITH_TIMEOUT(page.secondsLeft() && !page.trace().growth().levels.empty(), patience);
    page.pause();
    QVERIFY(page.isHeldUp());
    // What was shown last is still photographed.
    QTest::qWait(500);
    const double share = page.progress().value(), seconds = page.secondsLeft().value();
    const PatternCount count = page.patterns();
    QVERIFY(share > 0.0 && seconds > 0.0 && count.taken > 0);
    QTest::qWait(1200);
    QCOMPARE(page.progress().value(), share);
    QCOMPARE(page.secondsLeft().value(), seconds);
    // A level turns out to need more.
    AcquisitionTrace::Growth growth = page.trace().growth();
    growth.levels.back() += 400;
    const_cast<AcquisitionTrace&>(page.trace()).grew(growth.levels, growth.through);
    QVERIFY(page.patterns().expected > count.expected + 300 && page.progress().value() < share);
    QVERIFY(page.secondsLeft().value() > seconds);
    session_->live().setLeastInterval(0);
    page.resume();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(isHonest && page.isDone() && !page.progress());
    QVERIFY2(most > 0.8, qPrintable(QString::number(most)));
  }

  /// Law: bars are of the measurement that the page is about; another's come back with its settings.
  void barsAreOfThisMeasurement() {
    own_->begin();
    AcquirePage page(*session_);
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring() && page.isDone(), patience);
    const auto known = [&page] {
      const std::vector<BlockLevel> levels = page.levels();
      return std::ranges::count_if(levels, [](const BlockLevel& level) { return level.isKnown; });
    };
    const auto measured = known();
    QVERIFY(measured > 0 && page.isTraceCurrent());
    page.setFineness(Fineness::fine);
    QVERIFY(known() == 0 && !page.levels().empty() && !page.isTraceCurrent());
    page.undoStack().undo();
    QVERIFY(known() == measured && page.isTraceCurrent());
  }

  /// A picture grows sharper while it measures, and says so to those who cannot see it.
  void whatIsExpectedIsShownWhileItMeasures() {
    CalibrateSettings settings = smallVenue();
    std::get<VenueSettings>(settings.rig).projector = {96, 72};
    own_->begin(settings);
    AcquirePage page(*session_);
    std::vector<int> blocks;
    connect(&page.trace(), &AcquisitionTrace::changed, &page, [&] {
      const AcquisitionTrace::SharedOutlook& outlook = page.trace().outlook();
      if (!outlook || (!blocks.empty() && blocks.back() == outlook->blocks)) return;
      blocks.push_back(outlook->blocks);
      QCOMPARE(outlook->picture.size(), (Size{40, 30}));
    });
    const std::unique_ptr<QWidget> card(outlookCard(page));
    auto* picture = card->findChild<ImageView*>("outlook-view");
    QVERIFY(picture && picture->picture().isNull() && !picture->accessibleName().isEmpty());
    page.primary()->trigger();
    QVERIFY(!page.trace().outlook());
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(!blocks.empty() && std::is_sorted(blocks.rbegin(), blocks.rend()));
    QTRY_COMPARE(page.trace().outlook()->blocks, 1);
    QTRY_COMPARE(picture->picture().size(), QSize(40, 30));
    QVERIFY(picture->accessibleDescription().contains(qualityText(page.trace().outlook()->now)));
    QCOMPARE(page.expectedQuality().value().now, page.trace().outlook()->now);
  }

  /// What was stopped and kept is no plain tick, and is gone on with, also where going on did not end.
  void whatWasStoppedIsGoneOnWith() {
    CalibrateSettings settings = smallVenue();
    std::get<VenueSettings>(settings.rig).projector = {96, 72};
    own_->begin(settings);
    AcquirePage page(*session_);
    const QMetaObject::Connection stopping =
        connect(&page.trace(), &AcquisitionTrace::changed, &page, [&page] {
          if (page.isMeasuring() && !page.isStopping() && !page.trace().growth().levels.empty())
            page.stopAndKeep();
        });
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(page.isDone());
    QVERIFY2(page.stoppedAt() > 1, qPrintable(QString::number(page.stoppedAt())));
    QCOMPARE(page.status().state, StepState::coarse);
    QVERIFY(page.status().result.contains(QString::number(page.stoppedAt())));
    QTemporaryDir folder;
    QSettings file(folder.filePath("settings.ini"), QSettings::IniFormat);
    RecentVenues recent(file);
    recent.add(QString::fromStdString(session_->path().string()), QDateTime::currentDateTime());
    const QString stopped = recent.list().front().state;
    QVERIFY2(stopped.contains(QString::number(page.stoppedAt())), qPrintable(stopped));
    QVERIFY(!page.findings().isEmpty());
    const std::optional<transport::ExpectedQuality> quality = page.expectedQuality();
    QVERIFY(quality && quality->whole >= quality->now && quality->photographs > 0 && quality->seconds > 0.0);
    const std::optional<Banner> banner = page.banner();
    QVERIFY(banner && banner->command && banner->command->isEnabled());
    QVERIFY(banner->command != page.primary());
    for (const QString& figure : {decimalText(quality->now, 0), decimalText(quality->whole, 0),
                                  QString::number(quality->photographs)})
      QVERIFY2(banner->more.contains(figure), qPrintable(banner->more));
    const int before = page.cost().value().patterns;
    const double took = page.cost().value().seconds;
    // All of it a minute ago.
    const auto aMinute = std::chrono::minutes(1);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(session_->path()))
      std::filesystem::last_write_time(entry, std::filesystem::last_write_time(entry) - aMinute);
    disconnect(stopping);
    QElapsedTimer since;
    since.start();
    session_->live().setLeastInterval(50);  // not to be at its end before it is interrupted
    banner->command->trigger();
    QVERIFY(page.isMeasuring());
    QTRY_VERIFY_WITH_TIMEOUT(session_->photographsSince(Stage::acquisition) > 3, patience);
    session_->live().setLeastInterval(0);
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    const std::optional<Banner> interrupted = page.banner();
    QVERIFY(interrupted && interrupted->kind == Banner::Kind::amber);
    QCOMPARE(interrupted->sentence, AcquirePage::tr("Going on has not ended"));
    QVERIFY2(interrupted->more.contains(QString::number(page.photographsOfNew())),
             qPrintable(interrupted->more));
    QCOMPARE(page.status().state, StepState::coarse);
    // At the start too: still stopped, with what was photographed since.
    const QString goingOn = recent.list().front().state;
    QVERIFY2(goingOn != stopped && goingOn.contains(QString::number(page.stoppedAt())) &&
                 goingOn.contains(QString::number(page.photographsOfNew())),
             qPrintable(goingOn));
    QVERIFY(interrupted->command && interrupted->command->isEnabled());
    interrupted->command->trigger();
    QVERIFY(page.isMeasuring());
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QCOMPARE(page.stoppedAt(), 0);
    QCOMPARE(page.status().state, StepState::done);
    QVERIFY(!page.banner());
    QVERIFY(page.cost().value().patterns > before);
    // Both sessions, and not what lay between them.
    const double whole = page.cost().value().seconds;
    QVERIFY2(whole >= took && whole <= took + since.elapsed() / 1000.0 + 1.0,
             qPrintable(QString("%1 s, then %2 s").arg(took).arg(whole)));
  }

  /// Law: what is gone on with is not expected to be coarser than it was, while it is read again.
  void whatIsGoneOnWithIsNoCoarserThanItWas() {
    CalibrateSettings settings = smallVenue();
    std::get<VenueSettings>(settings.rig).projector = {96, 72};
    own_->begin(settings);
    AcquirePage page(*session_);
    const QMetaObject::Connection stopping =
        connect(&page.trace(), &AcquisitionTrace::changed, &page, [&page] {
          if (page.isMeasuring() && !page.isStopping() && page.trace().growth().levels.size() > 3)
            page.stopAndKeep();
        });
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    disconnect(stopping);
    const int known = page.stoppedAt();
    QVERIFY2(known > 1, qPrintable(QString::number(known)));
    int coarsestRead = 0, coarsestShown = 0;
    connect(&page.trace(), &AcquisitionTrace::changed, &page, [&] {
      if (!page.isMeasuring()) return;
      if (const auto& read = page.trace().outlook()) coarsestRead = std::max(coarsestRead, read->blocks);
      if (const auto shown = page.outlook()) coarsestShown = std::max(coarsestShown, shown->blocks);
    });
    page.banner()->command->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY2(coarsestShown <= known, qPrintable(QString::number(coarsestShown)));
    if (coarsestRead <= known)
      QSKIP("what was read was not looked at before it was finer: the computer is busy");
  }

  /// Law: an earlier measurement is used until the new one is ready, and how far that has come is said. There
  /// is one way on, in the action bar.
  void measuredAgainTheEarlierIsUsedMeanwhile() {
    own_->begin();
    AcquirePage page(*session_);
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring() && page.isDone(), patience);
    const std::string stored = session_->result(Stage::acquisition)->stored;
    QCOMPARE(page.secondary().size(), std::size_t{1});
    QTest::qWait(1100);  // results are dated to the second
    page.secondary().front()->trigger();
    QVERIFY(page.isMeasuring() && page.status().hasResult);
    QTRY_VERIFY_WITH_TIMEOUT(session_->photographsSince(Stage::acquisition) > 3, patience);
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QCOMPARE(session_->result(Stage::acquisition)->stored, stored);
    QVERIFY(page.status().state == StepState::outOfDate && page.photographsOfNew() > 3);
    const Banner banner = page.banner().value();
    QVERIFY2(banner.more.contains(QString::number(page.photographsOfNew())), qPrintable(banner.more));
    QVERIFY(banner.command == nullptr && page.primary()->isEnabled());
    // The pages that follow from it say the same.
    const auto elsewhere = [&] { return onMeasurement(*session_, nullptr).value_or(Banner()).sentence; };
    QCOMPARE(elsewhere(), banner.sentence);
    QCOMPARE(page.primary()->text(), AcquirePage::tr("Resume"));
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(page.isDone() && !page.banner() && page.photographsOfNew() == 0);
    // Other settings: nothing of theirs is there yet.
    page.setFineness(Fineness::fast);
    QCOMPARE(page.primary()->text(), AcquirePage::tr("Measure with these settings"));
    QVERIFY(page.banner() && page.banner()->command == nullptr);
    QVERIFY2(elsewhere().contains("earlier settings"), qPrintable(elsewhere()));
  }

  /// Law: from a measurement that was stopped and kept in place of a whole one, that is gone back to.
  void whatReplacedMoreIsGoneBackFrom() {
    CalibrateSettings settings = smallVenue();
    std::get<VenueSettings>(settings.rig).projector = {96, 72};
    own_->begin(settings);
    AcquirePage page(*session_);
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring() && page.isDone(), patience);
    const std::filesystem::path whole = session_->result(Stage::acquisition)->folder;
    connect(&page.trace(), &AcquisitionTrace::changed, &page, [&page] {
      if (page.isMeasuring() && !page.isStopping() && !page.trace().growth().levels.empty())
        page.stopAndKeep();
    });
    page.secondary().front()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(page.stoppedAt() > 1 && session_->result(Stage::acquisition)->folder != whole);
    QCOMPARE(page.primary()->text(), AcquirePage::tr("Use the earlier one"));
    // There is no way back to the new one: it is asked first.
    const std::filesystem::path newer = session_->result(Stage::acquisition)->folder;
    QSignalSpy asked(&page, &PageModel::failed);
    page.primary()->trigger();
    QCOMPARE(asked.size(), 1);
    const auto question = asked.front().front().value<FailureReport>();
    QVERIFY(question.isQuestion && session_->result(Stage::acquisition)->folder == newer);
    question.goOn->trigger();
    QVERIFY(session_->result(Stage::acquisition)->folder == whole);
    QVERIFY(page.stoppedAt() == 0 && page.isDone() && !page.banner());
    QCOMPARE(page.secondary().size(), std::size_t{1});
  }

  /// Law: how many patterns are expected is one number, wherever it is said; done, it is how many there were.
  void expectedPatternsAreOneNumber() {
    own_->begin();
    AcquirePage page(*session_);
    measureResponse();
    const std::unique_ptr<QWidget> card(blockSizesCard(page));
    card->resize(900, 200);
    card->show();
    page.refresh();
    const auto said = [&card] {
      QStringList texts;
      for (const QLabel* label : card->findChildren<QLabel*>()) texts << label->text();
      return texts.join(' ');
    };
    const int expected = page.patternsExpected();
    QCOMPARE(page.expected()->shots, expected);
    QVERIFY2(page.hint().contains(QString::number(expected)), qPrintable(page.hint()));
    QVERIFY2(said().contains(QString::number(expected)), qPrintable(said()));
    page.primary()->trigger();
    QVERIFY(page.isMeasuring());
    QCOMPARE(page.patterns().expected, std::max(page.patterns().taken, page.patternsExpected()));
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QCOMPARE(page.patternsExpected(), page.cost()->patterns);
  }

  /// Law: finer takes longer and is better; what is said of each differs.
  void eachFinenessHasItsQuality() {
    own_->begin();
    AcquirePage page(*session_);
    const double fast = page.expectedDeviation(Fineness::fast),
                 usual = page.expectedDeviation(Fineness::usual),
                 fine = page.expectedDeviation(Fineness::fine);
    QVERIFY(fast > usual && usual > fine);
    QVERIFY(percentText(fast) != percentText(usual) && percentText(usual) != percentText(fine));
  }

  /// Law: who may not start is told why beside the button, and led there.
  void whatStandsAgainstMeasuringIsSaid() {
    own_->begin(scripted());
    AcquirePage page(*session_);
    page.refresh();
    QVERIFY(!page.primary()->isEnabled() && page.hasRemedy());
    QCOMPARE(page.primary()->toolTip(), page.hint());
    QCOMPARE(page.hint(), AcquirePage::tr("Confirm that the room is clear: the patterns flash."));
    session_->setRoomClear(true);
    QVERIFY(page.primary()->isEnabled() && !page.hasRemedy());
  }

  /// Law: whoever waits for room is told of above the page, with what is needed, until it goes on.
  void aFullDiskIsSaidAndGoneOnWith() {
    own_->begin();
    AcquirePage page(*session_);
    auto* room = page.findChild<RoomQuestion*>();
    QVERIFY(room != nullptr);
    page.primary()->trigger();
    QVERIFY(page.isMeasuring() && !page.isDiskFull() && !page.banner());
    QSignalSpy status(&page, &AcquirePage::statusChanged), asks(&page, &AcquirePage::asks);
    QCOMPARE(room->wait({session_->path(), 12'000'000, 96'000'000}), RoomWaiter::Answer::look);
    QVERIFY(page.isDiskFull() && !status.isEmpty());
    QVERIFY(page.status().state == StepState::busy && page.status().result.startsWith("Paused"));
    const Banner banner = page.banner().value();
    for (std::uint64_t bytes : {12'000'000ULL, 96'000'000ULL})
      QVERIFY2(banner.more.contains(bytesText(bytes)), qPrintable(banner.more));
    QVERIFY(banner.command->isEnabled());
    banner.command->trigger();
    QCOMPARE(room->wait({session_->path(), 12'000'000, 96'000'000}), RoomWaiter::Answer::goOn);
    QCOMPARE(asks.size(), 1);
    room->over();
    QVERIFY(page.isMeasuring() && !page.isDiskFull() && !page.banner());
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
  }

  void whatIsKeptCanBeChosenAndTakenBack() {
    own_->begin();
    AcquirePage page(*session_);
    QCOMPARE(page.keptPhotographs(), KeptPhotographs::everything);
    page.setKeptPhotographs(KeptPhotographs::results);
    QCOMPARE(page.keptPhotographs(), KeptPhotographs::results);
    QCOMPARE(
        pipeline::keptPhotographs(CalibrationFolder::open(session_->path(), CalibrationFolder::Access::read)),
        KeptPhotographs::results);
    page.undoStack().undo();
    QCOMPARE(page.keptPhotographs(), KeptPhotographs::everything);
  }

  /// Law: finer takes longer.
  void everyFinenessHasItsTime() {
    own_->begin();
    AcquirePage page(*session_);
    measureResponse();
    for (bool fineChosen : {false, true}) {
      if (fineChosen) page.setFineness(Fineness::fine);
      auto fast = page.expected(Fineness::fast), usual = page.expected(Fineness::usual),
           fine = page.expected(Fineness::fine);
      QVERIFY(fast && usual && fine);
      QVERIFY2(fast->seconds < usual->seconds && usual->seconds < fine->seconds,
               qPrintable(QString("%1 %2 %3").arg(fast->seconds).arg(usual->seconds).arg(fine->seconds)));
      QCOMPARE(page.expected()->seconds, (fineChosen ? fine : usual)->seconds);
    }
  }

  void whatMayPassIsTriedThreeTimes_data() {
    QTest::addColumn<AlarmKind>("kind");
    QTest::addColumn<int>("tries");
    QTest::newRow("a door stood open") << AlarmKind::ambientChanged << 3;
    QTest::newRow("somebody in the light") << AlarmKind::localChange << 3;
    QTest::newRow("a lamp flickers") << AlarmKind::flicker << 0;
    QTest::newRow("the tripod was pushed") << AlarmKind::moved << 0;
    QTest::newRow("the lens is covered") << AlarmKind::coveredLens << 0;
  }
  void whatMayPassIsTriedThreeTimes() {
    QFETCH(AlarmKind, kind);
    QFETCH(int, tries);
    AcquisitionObserver nobody;
    auto question = std::make_shared<AlarmQuestion>();
    RetryingObserver retrying(nobody, question, std::chrono::milliseconds(1));
    Reading wrong;
    wrong.alarm = kind;
    auto tried = [&] {
      retrying.checked(wrong);
      return retrying.triesAgain(kind);
    };
    auto count = [&] {
      int times = 0;
      while (times < 10 && tried()) ++times;
      return times;
    };
    QCOMPARE(count(), tries);
    // Somebody was asked and wants it tried again.
    QCOMPARE(count(), tries);
    // Two tries, then it is well: the next time it has three again.
    for (int i = 0; i < std::min(2, tries); ++i) QVERIFY(tried());
    retrying.checked(Reading());
    QCOMPARE(count(), tries);
    // An alarm out of a log, of which nothing was told, is for somebody to decide.
    retrying.checked(Reading());
    QVERIFY(!retrying.triesAgain(kind));
    question->setClosed(true);
    QVERIFY(!tried());
  }

 private:
  void measureResponse() {
    Progress progress;
    SimulatedVenue venue(std::get<VenueSettings>(session_->settings().rig), {}, progress);
    Rig rig = venue.rig();
    {
      CalibrationFolder folder = CalibrationFolder::open(session_->path(), CalibrationFolder::Access::write);
      measureLinearization(folder, rig, progress);
    }
    session_->reload();
  }

  std::unique_ptr<SimulatedSession> own_;
  Session* session_ = nullptr;
};

QTEST_MAIN(TestAcquirePage)
#include "test_acquire_page.moc"
