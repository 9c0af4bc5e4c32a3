// SPDX-License-Identifier: MIT
// Steps and pages without any widget.
#include "wizard/frame/wizard.h"

#include <QDir>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "wizard/acquire/acquire_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

class ScriptedPage : public PageModel {
 public:
  ScriptedPage() : PageModel({"page", "", "page"}) {}
  QString subtitle() const override { return {}; }
  StepStatus status() const override { return {state, {}, hasResult}; }
  PageCommand* primary() const override { return nullptr; }
  void enter() override { ++entered; }
  void leave() override { ++left; }
  void updateCommands() override { ++updated; }
  StepState state = StepState::open;
  bool hasResult = false;
  int entered = 0, left = 0, updated = 0;
};

}  // namespace

class TestWizard : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<QSettings> settings_;
  std::unique_ptr<Session> session_;

 private slots:
  void init() {
    settings_ = std::make_unique<QSettings>(folder_.filePath("settings.ini"), QSettings::IniFormat);
    settings_->clear();
    session_ = std::make_unique<Session>(std::filesystem::path(folder_.filePath("cache").toStdString()));
  }

  /// Law: whoever is told that a venue is open may write to it at once, begun or opened again.
  void aVenueThatIsOpenMayBeWrittenTo() {
    const std::filesystem::path path(folder_.filePath("written").toStdString());
    int written = 0;
    connect(session_.get(), &Session::opened, this, [&] {
      CalibrationFolder::open(path, CalibrationFolder::Access::write);
      ++written;
    });
    session_->begin(path, CalibrateSettings());
    session_->open(path);
    QCOMPARE(written, 2);
  }

  /// Law: while another venue is set up, its step says so; the rest of the rail is of the one that is open.
  void theRailTellsAVenueFromTheOneThatIsSetUp() {
    VenuePage page(*session_, RecentVenues(*settings_));
    page.setMode(VenuePage::Mode::devices);
    QCOMPARE(page.status().result, QString("Setting up"));
    session_->begin(folder_.filePath("open").toStdString(), CalibrateSettings());
    const QString open = page.status().result;
    page.setMode(VenuePage::Mode::rehearse);
    QVERIFY(page.status().state == StepState::done && page.status().result == "Setting up another");
    QVERIFY(page.goBack());
    QCOMPARE(page.status().result, open);
  }

  void aStepOpensWhenAllBeforeItHaveAResult() {
    Wizard wizard(*session_);
    std::array<ScriptedPage, 4> pages;
    for (ScriptedPage& page : pages) wizard.add(page);
    QVERIFY(!wizard.isLocked(0) && wizard.isLocked(1) && wizard.isLocked(3));
    QVERIFY(!wizard.go(1));
    QCOMPARE(wizard.current(), std::size_t{0});
    pages[0].state = StepState::done;
    pages[1].state = StepState::outOfDate;
    QCOMPARE(wizard.standing(), std::size_t{2});
    QVERIFY(wizard.go(2));
    QCOMPARE(pages[0].left, 1);
    QCOMPARE(pages[2].entered, 1);
    QVERIFY(pages[2].updated > 0);  // what no signal told meanwhile
    QCOMPARE(pages[1].updated, 0);
    // From the start it goes on where it stands.
    QVERIFY(wizard.go(0));
    Q_EMIT pages[0].standingWanted();
    QCOMPARE(wizard.current(), std::size_t{2});
    // While it is measured again, what it came to before is used.
    pages[1].state = StepState::busy;
    QVERIFY(wizard.isLocked(2));
    pages[1].hasResult = true;
    QVERIFY(!wizard.isLocked(2));
    pages[1].state = StepState::coarse;
    QVERIFY(!wizard.isLocked(2));
    pages[1].state = StepState::failed;
    QVERIFY(wizard.isLocked(2));
    wizard.back();
    QCOMPARE(wizard.current(), std::size_t{1});
    QVERIFY(!wizard.go(9));
  }

  void aNewVenueSaysWhatIsWrongAndBeginsNothing_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("possible");
    QTest::newRow("plain") << "Chapel" << true;
    QTest::newRow("empty") << " " << false;
    QTest::newRow("a path") << "a/b" << false;
    QTest::newRow("taken") << "taken" << false;
  }
  void aNewVenueSaysWhatIsWrongAndBeginsNothing() {
    QFETCH(QString, name);
    QFETCH(bool, possible);
    QDir(folder_.path()).mkpath("venues/taken");
    VenuePage page(*session_, RecentVenues(*settings_));
    page.setFolder(folder_.filePath("venues"));
    page.setMode(VenuePage::Mode::rehearse);
    page.setVenueName(name);
    QCOMPARE(page.problem().isEmpty(), possible);
    QCOMPARE(page.primary()->isEnabled(), possible);
    page.primary()->trigger();
    QCOMPARE(session_->isOpen(), possible);
    if (!possible) return;
    QVERIFY(page.status().state == StepState::done);
    QCOMPARE(page.recent().size(), 1);
    QCOMPARE(page.recent().front().name, name);
    QVERIFY(!page.recent().front().isInterrupted && page.recent().front().picture.isNull());
    const QString shots = page.recent().front().folder + "/shots";
    QDir().mkpath(shots);
    QFile shot(shots + "/acquisition-000000-ae9467f0.shot");
    QVERIFY(shot.open(QIODevice::WriteOnly));
    QVERIFY(page.recent().front().isInterrupted);
  }

  void aScriptMustNameItsPlaceholders() {
    VenuePage page(*session_, RecentVenues(*settings_));
    page.setFolder(folder_.filePath("scripts"));
    page.setMode(VenuePage::Mode::script);
    QVERIFY(!page.primary()->isEnabled());
    CommandRigSettings script = page.script();
    script.projector = {64, 48};  // its photographs fit on any disk
    script.camera = {48, 36};
    page.setScript(script);
    QCOMPARE(page.problem(), VenuePage::tr("Choose the projector's screen, or type the command that shows."));
    script.projectorCommand = "show";
    script.cameraCommand = "photograph {exposure} {output}";
    page.setScript(script);
    QVERIFY2(page.problem().contains("{image}"), qPrintable(page.problem()));
    script.projectorCommand = "show {image}";
    page.setScript(script);
    // Real devices may flash: somebody must say that the room is clear.
    QCOMPARE(page.problem(), VenuePage::tr("Confirm that the room is clear."));
    page.setRoomClear(true);
    QVERIFY2(page.primary()->isEnabled(), qPrintable(page.problem()));
  }

  void whatCannotBeOpenedIsToldAndChangesNothing() {
    VenuePage page(*session_, RecentVenues(*settings_));
    QSignalSpy failed(&page, &PageModel::failed);
    page.open(folder_.filePath("nowhere"));
    QCOMPARE(failed.size(), 1);
    auto report = failed.front().front().value<FailureReport>();
    QVERIFY(!report.failure.what.isEmpty() && !report.failure.advice.isEmpty() && !report.safe.isEmpty());
    QVERIFY(!session_->isOpen());
  }

  void aFolderThatIsNoVenueSaysWhatItHolds_data() {
    QTest::addColumn<int>("venues");
    QTest::newRow("nothing") << 0;
    QTest::newRow("the folder of venues") << 2;
  }
  void aFolderThatIsNoVenueSaysWhatItHolds() {
    QFETCH(int, venues);
    const QString parent = folder_.filePath("with%1").arg(venues);
    QDir(parent).mkpath("pictures");
    for (int i = 0; i < venues; ++i)
      session_->begin(QString("%1/venue %2").arg(parent).arg(i).toStdString(), CalibrateSettings());
    Session other{std::filesystem::path()};
    VenuePage page(other, RecentVenues(*settings_));
    QSignalSpy failed(&page, &PageModel::failed);
    page.open(parent);
    QCOMPARE(failed.size(), 1);
    const auto report = failed.front().front().value<FailureReport>();
    QVERIFY(!report.failure.heading.isEmpty());
    QVERIFY2(report.failure.what.contains(parent), qPrintable(report.failure.what));
    QCOMPARE(report.failure.advice.contains(QString::number(venues)), venues > 0);
    QVERIFY(!other.isOpen());
  }

  void whatAProjectorTakesIsNotGuessedBeforeOneIsChosen() {
    VenuePage page(*session_, RecentVenues(*settings_));
    page.setMode(VenuePage::Mode::devices);
    QVERIFY(!page.isExpectedKnown());
    QCOMPARE(page.remedy(), VenuePage::Remedy::screen);
    page.chooseScreen({{"HDMI-1", "", "", ""}, {64, 48}, 60.0, "Screen 1", {}});
    QVERIFY(page.isExpectedKnown());
    auto [fast, slow] = page.expectedSeconds();
    QVERIFY(fast > 0.0 && slow > 10.0 * fast);
    QCOMPARE(page.remedy(), VenuePage::Remedy::consent);
    page.setRoomClear(true);
    QVERIFY(!page.hasRemedy());
    page.setVenueName("");
    QCOMPARE(page.remedy(), VenuePage::Remedy::name);
  }

  void theVenueThatIsOpenIsMarked() {
    VenuePage page(*session_, RecentVenues(*settings_));
    for (const char* name : {"marked 1", "marked 2"})
      session_->begin(folder_.filePath(name).toStdString(), CalibrateSettings());
    QCOMPARE(page.recent().size(), 2);
    QVERIFY(page.isOpenNow(page.recent()[0]) && !page.isOpenNow(page.recent()[1]));
    session_->close();
    QVERIFY(!page.isOpenNow(page.recent()[0]));
  }

  void aCutIsFoundAgainAsItWasLeft() {
    session_->begin(folder_.filePath("two ways").toStdString(), CalibrateSettings());
    ThresholdPage page(*session_);
    page.setAbsolute(1e-3);
    page.setShareOfPixel(true);
    QCOMPARE(page.cut().absolute, 0.0f);
    page.setShare(0.02);
    page.setShareOfPixel(false);
    QCOMPARE(page.cut().absolute, 1e-3f);
    QCOMPARE(page.cut().shareOfRowMax, 0.0f);
    page.setShareOfPixel(true);
    QCOMPARE(page.cut().shareOfRowMax, 0.02f);
  }

  /// Law: what was chosen is taken back step by step, and done again.
  void aCutIsUndone() {
    session_->begin(folder_.filePath("undone").toStdString(), CalibrateSettings());
    ThresholdPage page(*session_);
    page.setAbsolute(1e-3);
    page.setShareOfPixel(true);
    page.undoStack().undo();
    QVERIFY(!page.isShareOfPixel());
    QCOMPARE(page.cut().absolute, 1e-3f);
    page.undoStack().undo();
    QCOMPARE(page.cut().absolute, 0.0f);
    page.undoStack().redo();
    QCOMPARE(page.cut().absolute, 1e-3f);
  }

  /// As the desktop opens it, and from the command line.
  void aCalibrationOpensByItsFolderOrItsFile() {
    std::filesystem::path folder(folder_.filePath("opened").toStdString());
    session_->begin(folder, CalibrateSettings());
    session_->close();
    for (const std::filesystem::path& path : {folder, folder / "calibration.relucent"}) {
      Session again{std::filesystem::path()};
      VenuePage page(again, RecentVenues(*settings_));
      page.open(QString::fromStdString(path.string()));
      QVERIFY(again.isOpen());
      QCOMPARE(again.path(), folder);
    }
  }

  void acquireSaysHowOftenItChecks_data() {
    QTest::addColumn<int>("interval");
    QTest::newRow("as it is delivered") << 40;
    QTest::newRow("more often") << 15;
  }
  void acquireSaysHowOftenItChecks() {
    QFETCH(int, interval);
    AcquirePage page(*session_);
    CalibrateSettings settings;
    settings.acquisition.checkInterval = interval;
    session_->begin(std::filesystem::path(folder_.filePath("every%1").arg(interval).toStdString()), settings);
    QVERIFY2(page.watching().contains(QString::number(interval)), qPrintable(page.watching()));
  }

  void decisionsSurviveAndSettingsMakeThemStale() {
    CalibrateSettings settings;
    session_->begin(std::filesystem::path(folder_.filePath("kept").toStdString()), settings);
    session_->decide(CameraCheckResult{{1.0}, std::nullopt, {}});
    session_->decide(ThresholdResult{.energyKept = 0.98});
    settings = session_->settings();
    settings.threshold.absolute = 0.1f;
    session_->changeSettings(settings);
    QVERIFY(session_->progress(Stage::camera) == StageProgress::done);
    QVERIFY(session_->progress(Stage::threshold) == StageProgress::stale);
    ThresholdPage page(*session_);
    QVERIFY(page.status().state == StepState::outOfDate);
    const std::filesystem::path kept = session_->path();
    session_->close();
    Session again{std::filesystem::path()};
    again.open(kept);
    QVERIFY(again.progress(Stage::threshold) == StageProgress::stale);
    QCOMPARE(again.name(), QString("kept"));
  }
};

QTEST_MAIN(TestWizard)
#include "test_wizard.moc"
