// SPDX-License-Identifier: MIT
// Stages one by one, and what somebody decides between them.
#include "relucent/pipeline/measuring.h"

#include <QTemporaryDir>
#include <QTest>
#include <set>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/repair.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/settings_json.h"
#include "relucent/pipeline/stored_settings.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::clustering;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::inverse;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::transport;
using namespace relucent::venue;
namespace fs = std::filesystem;

namespace {

CalibrateSettings tiny() {
  VenueSettings venue;
  venue.name = "plain";
  venue.projector = {24, 18};
  venue.camera = {20, 16};
  venue.pathsPerPixel = 16;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = 5;
  return settings;
}

void decideEverything(CalibrationFolder& folder) {
  storeDecision(folder, CameraCheckResult());
  storeDecision(folder, ThresholdResult());
  storeDecision(folder, ClusteringResult{31, 256, 0.12});
  storeDecision(folder, ContentResult());
  storeInverse(folder, InverseResult());
}

}  // namespace

class TestSteps : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path path(const char* name) const { return fs::path(folder_.path().toStdString()) / name; }

 private slots:
  /// The law that makes the wizard and the command line the same program.
  void oneByOneIsTheSameAsAllAtOnce() {
    Progress quiet;
    calibrate(path("at once"), tiny(), path("cache"), quiet);
    CalibrationFolder atOnce = CalibrationFolder::open(path("at once"), CalibrationFolder::Access::read);

    CalibrationFolder folder = beginCalibration(path("one by one"), tiny());
    OpenedRig devices = openRig(settingsOf(folder).rig, path("cache"), quiet);
    for (Stage step : allValues<Stage>()) QVERIFY(progressOf(folder, step) == StageProgress::open);
    Linearization linearization = measureLinearization(folder, devices.rig, quiet);
    QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::done);
    const Acquisition acquisition = measureAcquisition(folder, devices.rig, linearization, {}, quiet);
    MeasuredVenue venue = measuredVenueOf(acquisition, settingsOf(folder).threshold);
    measureInverse(folder, venue, quiet);

    const Acquisition expected = loadAcquisition(*atOnce.latest(Stage::acquisition));
    QVERIFY(acquisition.transport == expected.transport);
    QCOMPARE(resultFrom<Stage::inverse>(*folder.latest(Stage::inverse)).ridge.value(),
             resultFrom<Stage::inverse>(*atOnce.latest(Stage::inverse)).ridge.value());
    QVERIFY(measuredVenueOf(expected, {}).transport == venue.transport);
  }

  void devicesAreExchangedAsLongAsNothingIsMeasured() {
    CalibrateSettings settings = tiny();
    ScreenRigSettings screen{{"HDMI-1", "", "", ""}, {24, 18}};
    settings.rig = screen;
    CalibrationFolder folder = beginCalibration(path("exchanged"), settings);
    storeDecision(folder, CameraCheckResult());
    screen.cameraAddress = "telescope:7";
    QVERIFY_THROWS_EXCEPTION(Error, changeRig(folder, screen));
    screen.cameraAddress = "genicam:7";
    changeRig(folder, screen);
    QCOMPARE(std::get<ScreenRigSettings>(settingsOf(folder).rig).cameraAddress, std::string("genicam:7"));
    // What was decided with other devices is no longer current.
    QVERIFY(progressOf(folder, Stage::camera) == StageProgress::stale);
    // Core has no windows.
    Progress quiet;
    QVERIFY_THROWS_EXCEPTION(Error, openRig(settingsOf(folder).rig, {}, quiet));
    folder.store(Stage::linearization, fingerprintOf(folder, Stage::linearization), Json::object());
    QVERIFY_THROWS_EXCEPTION(Error, changeRig(folder, screen));
  }

  void aScreenIsPluggedInElsewhereAndNothingIsStale() {
    CalibrateSettings settings = tiny();
    ScreenRigSettings screen{{"HDMI-1", "Maker", "Model", "1"}, {24, 18}};
    settings.rig = screen;
    CalibrationFolder folder = beginCalibration(path("replugged"), settings);
    folder.store(Stage::linearization, fingerprintOf(folder, Stage::linearization), Json::object());
    folder.store(Stage::acquisition, fingerprintOf(folder, Stage::acquisition), Json::object());
    decideEverything(folder);
    const auto now = [&] { return std::get<ScreenRigSettings>(settingsOf(folder).rig); };

    ScreenRigSettings elsewhere = now();
    elsewhere.display = {"DP-2", "", "", ""};
    elsewhere.frameRate = 50.0;
    elsewhere.cameraAddress = "not taken";
    changeScreen(folder, elsewhere);
    QVERIFY(now().display == elsewhere.display);
    QCOMPARE(now().frameRate, 50.0);
    QVERIFY(now().cameraAddress.empty());
    for (Stage step : allValues<Stage>())
      QVERIFY2(progressOf(folder, step) == StageProgress::done, nameOf(step).data());
    // What was measured stays on record, and a changed setting leaves the screen where it is.
    QVERIFY(std::get<ScreenRigSettings>(rigFromJson(folder.rig())).display == screen.display);
    CalibrateSettings changed = settingsOf(folder);
    changed.clustering.patchRadius = 5.0;
    changeSettings(folder, changed);
    QVERIFY(now().display == elsewhere.display);

    elsewhere.projector = {25, 18};
    QVERIFY_THROWS_EXCEPTION(Error, changeScreen(folder, elsewhere));
    CalibrationFolder simulated = beginCalibration(path("no-screen"), tiny());
    QVERIFY_THROWS_EXCEPTION(Error, changeScreen(simulated, screen));
  }

  /// Law: of several projectors the one whose cable hangs elsewhere moves, the others stay.
  void eachOfSeveralScreensIsPluggedInElsewhere() {
    CalibrateSettings settings = tiny();
    ScreenRigSettings screen{{"HDMI-1", "", "", ""}, {24, 18}};
    screen.moreScreens = {{{"HDMI-2", "", "", ""}, {32, 18}, 50.0, "Right"}};
    settings.rig = screen;
    CalibrationFolder folder = beginCalibration(path("replugged-second"), settings);
    folder.store(Stage::linearization, fingerprintOf(folder, Stage::linearization), Json::object());
    const auto now = [&] { return screensOf(std::get<ScreenRigSettings>(settingsOf(folder).rig)); };
    const ScreenRigSettings elsewhere{{"DP-2", "", "", ""}, {32, 18}, 60.0};
    changeScreen(folder, elsewhere, 1);
    QCOMPARE(now()[0].display.connector, std::string("HDMI-1"));
    QCOMPARE(now()[1].display.connector, std::string("DP-2"));
    QCOMPARE(now()[1].frameRate, 60.0);
    QCOMPARE(now()[1].name, std::string("Right"));
    QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::done);
    QVERIFY_THROWS_EXCEPTION(Error, changeScreen(folder, elsewhere, 0));
  }

  void devicesThatAreExchangedForgetWhereAScreenHung() {
    CalibrateSettings settings = tiny();
    ScreenRigSettings screen{{"HDMI-1", "", "", ""}, {24, 18}};
    settings.rig = screen;
    CalibrationFolder folder = beginCalibration(path("anew"), settings);
    ScreenRigSettings elsewhere = screen;
    elsewhere.display.connector = "DP-2";
    changeScreen(folder, elsewhere);
    screen.display.connector = "VGA-1";
    changeRig(folder, screen);
    QVERIFY(std::get<ScreenRigSettings>(settingsOf(folder).rig).display == screen.display);
  }

  /// Law: other commands reach the same devices. Nothing is stale, and what was measured stays on record.
  void otherCommandsReachTheSameDevices() {
    CalibrateSettings settings = tiny();
    CommandRigSettings script;
    script.projectorCommand = "show {image}";
    script.cameraCommand = "shoot {exposure} {output}";
    script.projector = {24, 18};
    script.moreCameras.push_back({.command = {}, .address = "command:second {exposure} {output}"});
    settings.rig = script;
    CalibrationFolder folder = beginCalibration(path("commands"), settings);
    folder.store(Stage::linearization, fingerprintOf(folder, Stage::linearization), Json::object());
    folder.store(Stage::acquisition, fingerprintOf(folder, Stage::acquisition), Json::object());
    decideEverything(folder);
    const std::vector<std::string> before = commandsOf(settings.rig);
    std::vector<std::string> typed = before;
    typed[1] = "shoot --raw {exposure} {output}";
    typed[2] = "third {exposure} {output}";
    changeCommands(folder, typed);
    QCOMPARE(commandsOf(settingsOf(folder).rig), typed);
    QCOMPARE(commandsOf(measuredRigOf(folder)), before);
    for (Stage step : allValues<Stage>())
      QVERIFY2(progressOf(folder, step) == StageProgress::done, nameOf(step).data());
    CalibrateSettings changed = settingsOf(folder);
    changed.clustering.patchRadius = 5.0;
    changeSettings(folder, changed);
    QCOMPARE(commandsOf(settingsOf(folder).rig), typed);
    QVERIFY(rigToJson(withCommands(settings.rig, before)) == rigToJson(settings.rig));

    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"show {image}"}, {"show", typed[1], typed[2]}, {typed[0], "", typed[2]}})
      QVERIFY_THROWS_EXCEPTION(Error, changeCommands(folder, wrong));
    CalibrationFolder simulated = beginCalibration(path("no-commands"), tiny());
    QVERIFY_THROWS_EXCEPTION(Error, changeCommands(simulated, typed));
    // Somebody's by hand.
    Json broken = folder.settings();
    broken["commands"] = 7;
    folder.setSettings(broken);
    QVERIFY_THROWS_EXCEPTION(Error, settingsOf(folder));
  }

  /// Law: what is made of the photographs is part of the one progress, under names of its own.
  void theResultIsWorkedOutWithinTheProgress() {
    struct Sink : ProgressSink {
      std::vector<std::pair<std::string, double>> reports;
      void progressed(double fraction, const Message& stage) override {
        reports.emplace_back(stage.id(), fraction);
      }
    } sink;
    Progress quiet;
    CalibrationFolder folder = beginCalibration(path("worked out"), tiny());
    OpenedRig devices = openRig(settingsOf(folder).rig, path("cache"), quiet);
    const Linearization linearization = measureLinearization(folder, devices.rig, quiet);
    StopRequest nobody;
    Progress progress(sink, nobody);
    measureAcquisition(folder, devices.rig, linearization, {}, progress);
    std::set<std::string> after, before;
    for (const auto& [stage, fraction] : sink.reports)
      (fraction >= photographedShare && isWorkingOut(stage) ? after : before).insert(stage);
    QVERIFY(after.contains("stage.concluding-measurement") &&
            after.contains("stage.storing-light-transport"));
    QVERIFY(before.contains("stage.working-out-finest-blocks") && before.contains("stage.test-patterns"));
    QVERIFY(!isWorkingOut("stage.test-patterns") && !isWorkingOut("stage.dense-patterns"));
    QCOMPARE(sink.reports.back().first, std::string("stage.storing-light-transport"));
  }

  void aChangedSettingMakesWhatFollowsStaleAndSettingItBackMakesItCurrent() {
    CalibrationFolder folder = beginCalibration(path("stale"), tiny());
    decideEverything(folder);
    CalibrateSettings before = settingsOf(folder), changed = before;
    changed.threshold.absolute = 0.5f;
    changeSettings(folder, changed);
    QVERIFY(progressOf(folder, Stage::camera) == StageProgress::done);
    for (Stage step : {Stage::threshold, Stage::clustering, Stage::content})
      QVERIFY(progressOf(folder, step) == StageProgress::stale);
    QCOMPARE(resultFrom<Stage::clustering>(*resultOf(folder, Stage::clustering)).clusters, 31U);

    changed = before;
    changed.clustering.patchRadius = 5.0;
    changeSettings(folder, changed);
    QVERIFY(progressOf(folder, Stage::threshold) == StageProgress::done);
    QVERIFY(progressOf(folder, Stage::clustering) == StageProgress::stale);
    QVERIFY(progressOf(folder, Stage::content) == StageProgress::done);

    changeSettings(folder, before);
    for (Stage step : {Stage::threshold, Stage::clustering, Stage::content})
      QVERIFY(progressOf(folder, step) == StageProgress::done);
    QVERIFY(!resultOf(folder, Stage::linearization));
  }

  void theContentsPlaceIsKept() {
    CalibrationFolder folder = beginCalibration(path("placed"), tiny());
    QVERIFY(!settingsOf(folder).content.corners);
    CalibrateSettings changed = settingsOf(folder);
    changed.content.corners = uprightCorners(1.5, 2.0, 8.0, 6.0);
    changeSettings(folder, changed);
    QVERIFY(settingsOf(folder).content == changed.content);
    QVERIFY(targetOf(changed.content).corners == changed.content.corners);
    changed.content.corners.reset();
    changeSettings(folder, changed);
    QVERIFY(!settingsOf(folder).content.corners);
    changed.content.corners = uprightCorners(1.5, 2.0, -8.0, 6.0);  // mirrored
    QVERIFY(!problems(changed.content).empty());
  }

  void whatViewsAskForIsKept() {
    CalibrationFolder folder = beginCalibration(path("views"), tiny());
    const std::string before = folder.settings().dump();
    CalibrateSettings changed = settingsOf(folder);
    changed.content.views = {{0.25, ViewPlacement::surface, {}},
                             {1.0, ViewPlacement::own, {}, Position{1.0, -2.0, 0.5}},
                             {2.0, ViewPlacement::own, uprightCorners(1.5, 2.0, 8.0, 6.0)}};
    changeSettings(folder, changed);
    QVERIFY(settingsOf(folder).content == changed.content);
    QVERIFY(targetOf(changed.content).views == changed.content.views);
    changed.content.views.clear();
    changeSettings(folder, changed);
    QCOMPARE(folder.settings().dump(), before);  // and so is its fingerprint
    changed.content.views = {{-1.0, ViewPlacement::surface, {}}};
    QVERIFY(!problems(changed.content).empty());
  }

  void settingsOfOtherVersionsStay() {
    CalibrationFolder folder = beginCalibration(path("foreign"), tiny());
    Json settings = folder.settings();
    settings["later"] = 7;
    folder.setSettings(settings);
    CalibrateSettings changed = settingsOf(folder);
    changed.content.method = Method::windows;
    changeSettings(folder, changed);
    QCOMPARE(folder.settings()["later"].get<int>(), 7);
    QVERIFY(settingsOf(folder).content.method == Method::windows);
  }

  void shotsThatAreSetAsideAreTakenAnew() {
    Progress quiet;
    CalibrationFolder folder = beginCalibration(path("aside"), tiny());
    OpenedRig devices = openRig(settingsOf(folder).rig, path("cache"), quiet);
    measureLinearization(folder, devices.rig, quiet);
    setShotsAside(folder, Stage::acquisition);  // there are none
    setShotsAside(folder, Stage::linearization);
    QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::done);
    int left = 0;
    for (const auto& entry : fs::directory_iterator(folder.shotFolder())) left += entry.is_regular_file();
    QCOMPARE(left, 0);
    QVERIFY(!fs::is_empty(folder.shotFolder() / "earlier-1"));
    QVERIFY(!fs::exists(folder.shotFolder() / "earlier-2"));
  }

  /// Law: measuring again and back is as if nothing had been: results, settings and photographs.
  void measuringAgainIsTakenBack() {
    Progress quiet;
    CalibrationFolder folder = beginCalibration(path("again"), tiny());
    OpenedRig devices = openRig(settingsOf(folder).rig, path("cache"), quiet);
    const auto shots = [&folder] {
      std::set<std::string> names;
      for (const auto& entry : fs::directory_iterator(folder.shotFolder()))
        if (entry.is_regular_file()) names.insert(entry.path().filename().string());
      return names;
    };
    measureLinearization(folder, devices.rig, quiet);
    const std::set<std::string> first = shots();
    const std::string settings = folder.settings().dump();
    QVERIFY(!first.empty() && !mayReturnToEarlier(folder, Stage::linearization));
    for (int times : {1, 2}) {
      for (int again = 0; again < times; ++again) measureAgain(folder, Stage::linearization);
      QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::stale && shots().empty());
      writeFileAtomically(folder.shotFolder() / "linearization-000000-ff.shot", "new");
      QVERIFY(mayReturnToEarlier(folder, Stage::linearization));
      returnToEarlier(folder, Stage::linearization);
      QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::done);
      QVERIFY(shots() == first);
      QCOMPARE(folder.settings().dump(), settings);
      QVERIFY(!mayReturnToEarlier(folder, Stage::linearization));
    }
    // With its own result it is no longer under way; but what it replaced can be gone back to.
    const std::string result = currentResultOf(folder, Stage::linearization)->folder.string();
    QVERIFY(!hasEarlier(folder, Stage::linearization));
    measureAgain(folder, Stage::linearization);
    measureLinearization(folder, devices.rig, quiet);
    QVERIFY(!mayReturnToEarlier(folder, Stage::linearization));
    QVERIFY(hasEarlier(folder, Stage::linearization));
    returnToEarlier(folder, Stage::linearization);
    QVERIFY(shots() == first);
    QCOMPARE(currentResultOf(folder, Stage::linearization)->folder.string(), result);
    // And measured again that is not what was gone back from.
    measureAgain(folder, Stage::linearization);
    QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::stale);
  }

  /// Law: while a measurement is made again, what followed from the one that is used stands as it stood, and
  /// what did not follow from it does not.
  void whatFollowsFromTheEarlierStandsMeanwhile() {
    Progress quiet;
    CalibrationFolder folder = beginCalibration(path("meanwhile"), tiny());
    OpenedRig devices = openRig(settingsOf(folder).rig, path("cache"), quiet);
    measureLinearization(folder, devices.rig, quiet);
    decideEverything(folder);
    const auto inUse = [&folder](Stage stage) { return progressInUse(folder, stage, Stage::linearization); };
    const auto decided = {Stage::threshold, Stage::clustering, Stage::content};
    for (Stage stage : decided) QVERIFY(inUse(stage) == StageProgress::done);
    measureAgain(folder, Stage::linearization);
    for (Stage stage : decided) {
      QVERIFY(progressOf(folder, stage) == StageProgress::stale);
      QVERIFY(inUse(stage) == StageProgress::done);
    }
    // Other clusters than were decided on are others than are used.
    CalibrateSettings changed = settingsOf(folder);
    changed.clustering.patchRadius += 1.0;
    changeSettings(folder, changed);
    QVERIFY(inUse(Stage::threshold) == StageProgress::done);
    QVERIFY(inUse(Stage::clustering) == StageProgress::stale);
  }

  /// Law: what is in use stays in use until there is something new: also what was gone back to after it had
  /// been measured again, and then a third measurement begins and has no result yet.
  void whatWasGoneBackToStaysInUse_data() {
    QTest::addColumn<bool>("again");
    QTest::newRow("measured again") << true;
    QTest::newRow("other settings") << false;
  }
  void whatWasGoneBackToStaysInUse() {
    QFETCH(bool, again);
    Progress quiet;
    CalibrationFolder folder = beginCalibration(path(again ? "back" : "changed"), tiny());
    OpenedRig devices = openRig(settingsOf(folder).rig, path("cache"), quiet);
    measureLinearization(folder, devices.rig, quiet);
    const std::string first = resultOf(folder, Stage::linearization)->inputs;
    measureAgain(folder, Stage::linearization);
    measureLinearization(folder, devices.rig, quiet);
    const std::string second = resultOf(folder, Stage::linearization)->inputs;
    QVERIFY(first != second);
    returnToEarlier(folder, Stage::linearization);
    QCOMPARE(resultOf(folder, Stage::linearization)->inputs, first);
    if (again) {
      measureAgain(folder, Stage::linearization);
    } else {
      CalibrateSettings settings = settingsOf(folder);
      settings.linearization.levels += 2;
      changeSettings(folder, settings);
    }
    QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::stale);
    QCOMPARE(resultOf(folder, Stage::linearization)->inputs, first);
    QCOMPARE(folder.inputsOf(Stage::linearization), (std::vector<std::string>{first, second}));
    if (again) {
      returnToEarlier(folder, Stage::linearization);
      QCOMPARE(resultOf(folder, Stage::linearization)->inputs, first);
      QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::done);
    }
  }

  /// Law: whoever plays a calibration has the earlier measurement until the new one is there, whether it is
  /// made again or with other settings.
  void theEarlierMeasurementPlaysMeanwhile_data() { whatWasGoneBackToStaysInUse_data(); }
  void theEarlierMeasurementPlaysMeanwhile() {
    QFETCH(bool, again);
    Progress quiet;
    CalibrateSettings settings = tiny();
    const fs::path place = path(again ? "plays" : "plays-changed");
    calibrate(place, settings, path("cache"), quiet);
    CalibrationFolder folder = CalibrationFolder::open(place, CalibrationFolder::Access::write);
    const MeasuredCalibration before = loadCalibration(folder, quiet);
    if (again) {
      measureAgain(folder, Stage::acquisition);
    } else {
      settings = settingsOf(folder);
      settings.acquisition.relativeThreshold *= 2.0;
      changeSettings(folder, settings);
    }
    QVERIFY(progressOf(folder, Stage::acquisition) == StageProgress::stale);
    const MeasuredCalibration now = loadCalibration(folder, quiet);
    QVERIFY(now.venue.transport == before.venue.transport && now.venue.flood == before.venue.flood);
    QVERIFY(now.ridge == before.ridge);
    QVERIFY_THROWS_EXCEPTION(Error, repairCalibration(place, {}, path("cache"), quiet));
  }

  void wrongSettingsBeginNothing() {
    CalibrateSettings settings = tiny();
    settings.content.reachablePercentile = -1.0;
    QVERIFY_EXCEPTION_THROWN((void)beginCalibration(path("wrong"), settings), Error);
    QVERIFY(!fs::exists(path("wrong")));
  }
};

QTEST_GUILESS_MAIN(TestSteps)
#include "test_steps.moc"
