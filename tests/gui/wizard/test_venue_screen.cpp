// SPDX-License-Identifier: MIT
// A calibration whose projector hangs on another output than when it was measured. Runs on two screens and
// plugs in a third, see tests/support/with-two-screens.
#include "wizard/venue/venue_screen.h"

#include <QSettings>
#include <QTemporaryDir>
#include <QtTest>

#include "gui/output/two_screens.h"
#include "output/window_projector.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/pipeline/stored_settings.h"
#include "wizard/output/output_page.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;

namespace {

constexpr Size projector{1024, 768};

void plugThird(bool on, const QString& mode = "1024x768") {
  QProcess::execute("xrandr", {"--addmode", "DUMMY2", mode});
  if (on)
    xrandr({"--output", "DUMMY2", "--mode", mode, "--right-of", "DUMMY1"});
  else
    xrandr({"--output", "DUMMY2", "--off"});
  QTRY_VERIFY((screenOn("DUMMY2") != nullptr) == on);
}

ScreenChoice choiceOf(const std::vector<ScreenChoice>& choices, const char* connector) {
  for (const ScreenChoice& choice : choices)
    if (choice.display.connector == connector) return choice;
  return {};
}

}  // namespace

Q_DECLARE_METATYPE(ScreenRigSettings::Display)

class TestVenueScreen : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<QSettings> settings_;
  std::unique_ptr<Session> session_;
  int count_ = 0;

  /// Measured, as far as the folder tells, on DUMMY1.
  void begin(bool measured) {
    CalibrateSettings settings;
    ScreenRigSettings rig;
    rig.display = displayOf(*screenOn("DUMMY1"));
    rig.projector = projector;
    rig.cameraAddress = "genicam:nobody";
    settings.rig = rig;
    const std::filesystem::path path(folder_.filePath(QString::number(++count_)).toStdString());
    session_->begin(path, settings);
    if (!measured) return;
    {
      CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
      storeLinearization(folder, fingerprintOf(folder, Stage::linearization), {}, {});
    }
    session_->reload();
  }

 private slots:
  void init() {
    settings_ = std::make_unique<QSettings>(folder_.filePath("settings.ini"), QSettings::IniFormat);
    session_ = std::make_unique<Session>(std::filesystem::path(folder_.filePath("cache").toStdString()));
  }
  void cleanup() {
    session_.reset();
    plugThird(false);
    if (screenOn("DUMMY1") == nullptr) plug();
  }

  void onlyScreensOfItsPixelsTakeAMeasurementOver() {
    plugThird(true);
    begin(true);
    VenueScreen screen(*session_);
    QVERIFY(screen.isChangeable() && !screen.isMissing());
    QVERIFY(choiceOf(screen.choices(), "DUMMY2").refusal.isEmpty());
    QVERIFY(!choiceOf(screen.choices(), "DUMMY0").refusal.isEmpty());  // the operator's
    plugThird(false);
    plugThird(true, "800x600");
    QTRY_COMPARE(nativeSize(*screenOn("DUMMY2")), QSize(800, 600));
    const ScreenChoice small = choiceOf(screen.choices(), "DUMMY2");
    QVERIFY2(small.refusal.contains("1024"), qPrintable(small.refusal));
    screen.choose(small);
    QVERIFY(!screen.isDifferentScreen());
  }

  void beforeAnythingIsMeasuredAnyScreenWillDo() {
    plugThird(true, "800x600");
    begin(false);
    VenueScreen screen(*session_);
    screen.choose(choiceOf(screen.choices(), "DUMMY2"));
    QVERIFY(screen.isDifferentScreen());
    QVERIFY(screen.meaning().isEmpty());
    screen.apply();
    QCOMPARE(session_->screenRig()->projector, (Size{800, 600}));
    QCOMPARE(session_->measuredDisplay().connector, std::string("DUMMY2"));
  }

  void theVenuePageSaysThatItIsGoneAndTakesAnother() {
    plugThird(true);
    begin(true);
    VenuePage page(*session_, RecentVenues(*settings_));
    QVERIFY(!page.banner());
    QCOMPARE(page.secondary().size(), std::size_t{1});
    unplug();
    QVERIFY(page.banner().has_value());
    QVERIFY2(page.banner()->sentence.contains("DUMMY1"), qPrintable(page.banner()->sentence));
    page.banner()->command->trigger();
    QVERIFY(page.mode() == VenuePage::Mode::screen);
    QVERIFY(!page.primary()->isEnabled() && !page.hint().isEmpty());
    page.openScreen().choose(choiceOf(page.openScreen().choices(), "DUMMY2"));
    QVERIFY(page.primary()->isEnabled());
    // What is at stake, before it is done.
    QVERIFY2(page.openScreen().meaning().contains("DUMMY2"), qPrintable(page.openScreen().meaning()));
    page.primary()->trigger();
    QVERIFY(page.mode() == VenuePage::Mode::start);
    QCOMPARE(session_->screenRig()->display.connector, std::string("DUMMY2"));
    QCOMPARE(session_->measuredDisplay().connector, std::string("DUMMY1"));
    QVERIFY(session_->progress(Stage::linearization) == StageProgress::done);
    QVERIFY(!page.banner());
    const std::filesystem::path kept = session_->path();
    session_->close();
    Session again{std::filesystem::path()};
    again.open(kept);
    QCOMPARE(again.screenRig()->display.connector, std::string("DUMMY2"));
  }

  /// Law: of a new venue, too, a chosen screen that is gone is said to be; the operator's own does not become
  /// a projector by itself.
  void theOperatorsOwnIsChosenByHandOnly() {
    plugThird(false);
    VenuePage page(*session_, RecentVenues(*settings_));
    page.setMode(VenuePage::Mode::devices);
    page.chooseScreen(choiceOf(page.screensToChoose(), "DUMMY1"));
    QCOMPARE(page.projectors().size(), std::size_t{1});
    QVERIFY(page.isPluggedIn(page.projectors().front()));
    unplug();
    QTRY_VERIFY(!page.isPluggedIn(page.projectors().front()));
    QVERIFY(!page.mayAddProjector());
    page.addProjector();
    QCOMPARE(page.projectors().size(), std::size_t{1});
  }

  void nothingIsChangedWhileSomethingUsesIt() {
    begin(true);
    VenuePage page(*session_, RecentVenues(*settings_));
    DeviceLease lease = session_->leaseDevices(OutputPage::stepName);
    QVERIFY(page.secondary().empty());
    unplug();
    QVERIFY(!page.banner());
  }

  void outputShinesOnTheMeasuredScreenAndOnNoOther() {
    plugThird(true);
    OutputPage page(*session_);
    begin(true);
    QVERIFY(page.chosen().has_value());
    QCOMPARE(page.screens()[*page.chosen()].identity.connector, QString("DUMMY1"));
    QVERIFY(page.meaningOfScreen().isEmpty());
    unplug();
    QVERIFY(!page.chosen());
    QVERIFY2(page.hint().contains("DUMMY1"), qPrintable(page.hint()));
    QVERIFY(page.hasRemedy());

    for (std::size_t i = 0; i < page.screens().size(); ++i)
      if (page.screens()[i].identity.connector == "DUMMY2") page.choose(i);
    QCOMPARE(session_->screenRig()->display.connector, std::string("DUMMY2"));
    QVERIFY(session_->progress(Stage::linearization) == StageProgress::done);
    QVERIFY(page.meaningOfScreen().contains("DUMMY1"));
    plug();
    QCOMPARE(page.screens()[*page.chosen()].identity.connector, QString("DUMMY2"));
  }

  void outputFollowsWhatIsSaidAtVenue() {
    plugThird(true);
    OutputPage page(*session_);
    begin(true);
    VenueScreen screen(*session_);
    screen.choose(choiceOf(screen.choices(), "DUMMY2"));
    screen.apply();
    QCOMPARE(page.screens()[*page.chosen()].identity.connector, QString("DUMMY2"));
  }

  void whatAMoveMeans_data() {
    QTest::addColumn<ScreenRigSettings::Display>("now");
    QTest::addColumn<bool>("isSaid");
    QTest::newRow("the same") << ScreenRigSettings::Display{"HDMI-1", "Maker", "Model", "7"} << false;
    QTest::newRow("known by its number")
        << ScreenRigSettings::Display{"DP-1", "Maker", "Model", "7"} << false;
    QTest::newRow("another") << ScreenRigSettings::Display{"HDMI-1", "Maker", "Model", "8"} << true;
  }
  void whatAMoveMeans() {
    QFETCH(ScreenRigSettings::Display, now);
    QFETCH(bool, isSaid);
    QCOMPARE(!meaningOfMove({"HDMI-1", "Maker", "Model", "7"}, now).isEmpty(), isSaid);
  }
};

QTEST_MAIN(TestVenueScreen)
#include "test_venue_screen.moc"
