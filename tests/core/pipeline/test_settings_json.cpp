// SPDX-License-Identifier: MIT
#include "relucent/pipeline/settings_json.h"

#include <QTemporaryDir>
#include <QTest>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/surprises_file.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

/// Through the manifest's text and back.
CalibrateSettings comeBack(const CalibrateSettings& settings) {
  CalibrateSettings read;
  read.rig = rigFromJson(Json::parse(rigToJson(settings.rig).dump()));
  stagesFromJson(Json::parse(stagesToJson(settings).dump()), read);
  return read;
}

}  // namespace

/// What a calibration's manifest says that it was asked for.
class TestSettingsJson : public QObject {
  Q_OBJECT

 private slots:
  void settingsComeBackNumberForNumber() {
    CalibrateSettings venue;
    VenueSettings corner;
    corner.name = "dome";
    corner.projector = {100, 50};
    corner.camera = {31, 17};
    corner.seed = 0xffffffffffffffffULL;
    corner.pathsPerPixel = 77;
    corner.devices = {10, 16, 999.5, 2.4, 0.1, 1.0 / 3.0, 5.5, 0.01, 0.02, 0.03, true, 1.8};
    venue.rig = corner;
    venue.linearization = {17, 1.5, 2, 0.05, 12};
    venue.acquisition.relativeThreshold = 0.0123456789012345678;
    venue.acquisition.seed = 13;
    venue.windows = {8, 32, 0.3};
    venue.chooseRidge = false;
    CalibrateSettings commands;
    commands.rig =
        CommandRigSettings{"show {image}", "shoot \"{output}\" {exposure}", {64, 48}, Size{32, 24}, 0.1, 2.0};
    CalibrateSettings withoutCamera;
    withoutCamera.rig = CommandRigSettings{"a", "b", {64, 48}, std::nullopt, 0.1, 2.0};
    CalibrateSettings addressed = withoutCamera, replayed;
    std::get<CommandRigSettings>(addressed.rig).cameraAddress = "genicam:40012345";
    std::get<CommandRigSettings>(addressed.rig).record = "/tape";
    std::get<CommandRigSettings>(addressed.rig).latency = 0.05;
    std::get<CommandRigSettings>(addressed.rig).frameRate = 59.94;
    replayed.rig = ReplayRigSettings{"/tape"};
    CalibrateSettings screen;
    screen.rig = ScreenRigSettings{
        {"HDMI-1", "ACME", "Beam", "7"}, {800, 600}, 59.94, "genicam:7", Size{32, 24}, 1e-4, 3.0, 0.07};
    // Versions that know none of them must not take them for commands.
    auto kindOf = [](const CalibrateSettings& settings) {
      return rigToJson(settings.rig).at("kind").get<std::string>();
    };
    QCOMPARE(kindOf(addressed), std::string("devices"));
    QCOMPARE(kindOf(replayed), std::string("replay"));
    QCOMPARE(kindOf(screen), std::string("screen"));
    QCOMPARE(kindOf(withoutCamera), std::string("commands"));
    QVERIFY(std::get<ScreenRigSettings>(comeBack(screen).rig).display ==
            std::get<ScreenRigSettings>(screen.rig).display);
    for (const CalibrateSettings& settings :
         {CalibrateSettings{}, venue, commands, withoutCamera, addressed, replayed, screen}) {
      CalibrateSettings read = comeBack(settings);
      QCOMPARE(rigToJson(read.rig).dump(), rigToJson(settings.rig).dump());
      QCOMPARE(stagesToJson(read).dump(), stagesToJson(settings).dump());
    }
    auto read = std::get<VenueSettings>(comeBack(venue).rig);
    QCOMPARE(read.seed, corner.seed);
    QCOMPARE(read.devices.fullWell, corner.devices.fullWell);
    QVERIFY(read.devices.whiteSegment);
    QCOMPARE(comeBack(venue).acquisition.relativeThreshold, venue.acquisition.relativeThreshold);
    QVERIFY(!comeBack(venue).chooseRidge);
    QVERIFY(!std::get<CommandRigSettings>(comeBack(withoutCamera).rig).camera);
  }

  /// Law: rigs of one screen and one camera without names are written as versions did that knew no others, so
  /// that their fingerprints stay; those of several come back.
  void severalScreensAndCamerasComeBack() {
    CalibrateSettings one, several;
    ScreenRigSettings rig{{"HDMI-1", "", "", ""}, {800, 600}};
    rig.cameraAddress = "genicam:7";
    one.rig = rig;
    for (const char* later : {"name", "camera_name", "more_screens", "more_cameras"})
      QVERIFY(!rigToJson(one.rig).at("screen").contains(later));
    rig.name = "Left";
    rig.cameraName = "Door";
    rig.moreScreens = {{{"DP-1", "ACME", "Beam", "8"}, {1024, 768}, 50.0, "Right"},
                       {{"DP-2", "", "", ""}, {640, 480}}};
    rig.moreCameras = {{"genicam:8", Size{640, 480}, "Window"}, {"v4l2:/dev/video0"}};
    several.rig = rig;
    const auto read = std::get<ScreenRigSettings>(comeBack(several).rig);
    QVERIFY(screensOf(read) == screensOf(rig));
    QVERIFY(camerasOf(read) == camerasOf(rig));
    QCOMPARE(rigToJson(read).dump(), rigToJson(several.rig).dump());
    QVERIFY(problems(several).empty());
    // As lists, and back.
    QCOMPARE(rigToJson(withScreens(rig, screensOf(rig))).dump(), rigToJson(several.rig).dump());
    QCOMPARE(rigToJson(withCameras(rig, camerasOf(rig))).dump(), rigToJson(several.rig).dump());
    QVERIFY(screensOf(ScreenRigSettings{}).empty() && camerasOf(ScreenRigSettings{}).empty());
    QCOMPARE(screensOf(withScreenAlone(rig, 1)).size(), std::size_t{1});
    QCOMPARE(withScreenAlone(rig, 1).display.connector, std::string("DP-1"));
  }

  /// The same for external programs; versions that knew one of each must not take several for that.
  void severalProgramsComeBack() {
    CommandRigSettings rig{"show {image}", "shoot {exposure} {output}", {64, 48}, Size{32, 24}, 0.1, 2.0};
    CalibrateSettings one, several;
    one.rig = rig;
    for (const char* later : {"more_projectors", "more_cameras"})
      QVERIFY(!rigToJson(one.rig).at("commands").contains(later));
    rig.moreProjectors = {{"show2 {image}", {80, 60}}};
    rig.moreCameras = {{"", "genicam:8", std::nullopt}, {"shoot2 {exposure} {output}", "", Size{40, 30}}};
    several.rig = rig;
    QCOMPARE(rigToJson(several.rig).at("kind").get<std::string>(), std::string("several-devices"));
    const auto read = std::get<CommandRigSettings>(comeBack(several).rig);
    QVERIFY(projectorsOf(read) == projectorsOf(rig) && camerasOf(read) == camerasOf(rig));
    QVERIFY(problems(several).empty());
    QCOMPARE(rigToJson(withProjectors(rig, projectorsOf(rig))).dump(), rigToJson(several.rig).dump());
    QCOMPARE(rigToJson(withCameras(rig, camerasOf(rig))).dump(), rigToJson(several.rig).dump());
  }

  /// A camera by command is held against the same rules on a screen's venue.
  void aScreensProgramIsNamedToo() {
    ScreenRigSettings rig;
    rig.display.connector = "DP-1";
    rig.projector = {64, 48};
    rig.frameRate = 60.0;
    rig.cameraAddress = "command:shoot {exposure} {output}";
    CalibrateSettings settings;
    settings.rig = rig;
    QVERIFY(problems(settings).empty());
    rig.cameraAddress = "command:shoot {exposure}";
    settings.rig = rig;
    const std::vector<Message> found = problems(settings);
    QCOMPARE(found.size(), std::size_t{1});
    QCOMPARE(english(found.front()), std::string("the camera's command does not contain {output}"));
  }

  void wrongProgramsAreNamed_data() {
    QTest::addColumn<QString>("projector");
    QTest::addColumn<Size>("size");
    QTest::addColumn<QString>("camera");
    QTest::addColumn<QString>("address");
    QTest::addColumn<QByteArray>("sentence");
    const QString show = "show2 {image}", shoot = "shoot2 {exposure} {output}", none;
    const Size size{64, 48};
    QTest::newRow("projector twice") << "show {image}" << size << shoot << none
                                     << QByteArray(
                                            "projector 1 and projector 2 are shown by the same command");
    QTest::newRow("camera twice") << show << size << "shoot {exposure} {output}" << none
                                  << QByteArray("camera 1 and camera 2 photograph by the same command");
    QTest::newRow("no image") << "show2" << size << shoot << none
                              << QByteArray("projector 2: the projector's command does not contain {image}");
    QTest::newRow("no output") << show << size << "shoot2 {exposure}" << none
                               << QByteArray("camera 2: the camera's command does not contain {output}");
    QTest::newRow("no address") << show << size << none << "usb:7"
                                << QByteArray("camera 2: 'usb:7' is not a camera: write genicam");
    QTest::newRow("too small") << show << Size{4, 4} << shoot << none
                               << QByteArray("projector 2: a projector of 4x4 pixels is impossible");
  }
  void wrongProgramsAreNamed() {
    QFETCH(QString, projector);
    QFETCH(Size, size);
    QFETCH(QString, camera);
    QFETCH(QString, address);
    QFETCH(QByteArray, sentence);
    CommandRigSettings rig{"show {image}", "shoot {exposure} {output}", {64, 48}, {}};
    rig.moreProjectors = {{projector.toStdString(), size}};
    rig.moreCameras = {{camera.toStdString(), address.toStdString()}};
    CalibrateSettings settings;
    settings.rig = rig;
    const std::vector<Message> found = problems(settings);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY2(QByteArray::fromStdString(english(found.front())).startsWith(sentence),
             english(found.front()).c_str());
  }

  /// Law: an even white is written as versions did that knew no other, so that nothing measured is out of
  /// date; others come back.
  void brightnessComesBack() {
    CalibrateSettings settings;
    QVERIFY(!stagesToJson(settings).at("content").contains("brightness"));
    for (compensation::Brightness brightness : allValues<compensation::Brightness>()) {
      settings.content.brightness = brightness;
      QVERIFY(comeBack(settings).content == settings.content);
      QVERIFY(targetOf(settings.content).brightness == brightness);
    }
  }

  void whatIsNamedTwiceIsAProblem_data() {
    QTest::addColumn<bool>("isScreen");
    QTest::addColumn<QByteArray>("sentence");
    QTest::newRow("screen") << true << QByteArray("screen HDMI-1 is projector 1 and projector 2");
    QTest::newRow("camera") << false << QByteArray("genicam:7 is camera 1 and camera 2");
  }
  void whatIsNamedTwiceIsAProblem() {
    QFETCH(bool, isScreen);
    QFETCH(QByteArray, sentence);
    ScreenRigSettings rig{{"HDMI-1", "", "", ""}, {800, 600}};
    rig.cameraAddress = "genicam:7";
    rig.moreScreens = {{{isScreen ? "HDMI-1" : "DP-1", "", "", ""}, {800, 600}}};
    rig.moreCameras = {{isScreen ? "genicam:8" : "genicam:7"}};
    CalibrateSettings settings;
    settings.rig = rig;
    const std::vector<Message> found = problems(settings);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY2(QByteArray::fromStdString(english(found.front())).contains(sentence),
             english(found.front()).c_str());
  }

  /// An earlier version kept the recording's folder among the commands.
  void recordingsOfEarlierVersionsAreFound() {
    const Json json = Json::parse(R"({"kind":"devices","commands":{"projector_command":"","camera_command":"",
        "projector":{"width":0,"height":0},"replay":"/tape"}})");
    QCOMPARE(std::get<ReplayRigSettings>(rigFromJson(json)).folder, std::string("/tape"));
  }

  void damagedSettingsAreAnError_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("empty") << QByteArray("{}");
    QTest::newRow("list") << QByteArray("[]");
    QTest::newRow("kind") << QByteArray(R"({"kind":"telescope"})");
    QTest::newRow("type") << QByteArray(R"({"kind":"simulated","venue":{"seed":"one"}})");
    QTest::newRow("size") << QByteArray(R"({"kind":"simulated","venue":{"projector":[1]}})");
  }
  void damagedSettingsAreAnError() {
    QFETCH(QByteArray, text);
    try {
      rigFromJson(Json::parse(text.toStdString()));
      QFAIL("was read");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::format);
    }
  }

  /// Another value in the place of a name that is not known would go unnoticed.
  void unknownNamesAreErrorsThatListTheKnownOnes_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QByteArray>("known");
    QTest::newRow("method") << QByteArray(R"({"content":{"method":"magic"}})") << QByteArray("refined");
    QTest::newRow("brightness") << QByteArray(R"({"content":{"brightness":"loud"}})") << QByteArray("region");
    QTest::newRow("objective") << QByteArray(R"({"content":{"objective":"guess"}})") << QByteArray("light");
    QTest::newRow("fit") << QByteArray(R"({"content":{"fit":"stretch"}})") << QByteArray("cover");
    QTest::newRow("scheme") << QByteArray(R"({"acquisition":{"scheme":"magic"}})") << QByteArray("adaptive");
    QTest::newRow("colours") << QByteArray(R"({"acquisition":{"colours":"blue"}})") << QByteArray("white");
    QTest::newRow("rescaling") << QByteArray(R"({"clustering":{"rescaling":"columns"}})")
                               << QByteArray("patches");
    QTest::newRow("cap") << QByteArray(R"({"clustering":{"cap":"often"}})") << QByteArray("when_percolated");
  }
  void unknownNamesAreErrorsThatListTheKnownOnes() {
    QFETCH(QByteArray, text);
    QFETCH(QByteArray, known);
    CalibrateSettings settings;
    try {
      stagesFromJson(Json::parse(text.toStdString()), settings);
      QFAIL("was read");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::format);
      QVERIFY2(QByteArray(error.what()).contains(known), error.what());
    }
  }

  /// Law: a choice that is not made leaves no trace, so that what was measured before there was one stays
  /// current; one that is made comes back.
  void exposureUnitsAreKeptOnlyWhereChosen() {
    CalibrateSettings settings;
    QVERIFY(!stagesToJson(settings).at("linearization").contains("exposureUnit"));
    settings.linearization.exposureUnit = 0.01;
    QCOMPARE(comeBack(settings).linearization.exposureUnit, 0.01);
  }

  /// Law: a rehearsal's surprises come back as far as they have come; what cannot be read is none.
  void surprisesComeBack() {
    QTemporaryDir folder;
    const std::filesystem::path path = folder.path().toStdString();
    QVERIFY(loadSurprises(path) == nullptr);
    SurpriseSettings settings{allValues<Surprise>(), 0xffffffffffffffffULL, 300, 4.5, 0.5, 0.07, 9};
    const SurprisesSoFar soFar{{Surprise::roomLight}, {Surprise::bump}, 3, 11};
    saveSurprises(Surprises(settings, soFar), path);
    const std::shared_ptr<Surprises> loaded = loadSurprises(path);
    QVERIFY(loaded != nullptr && loaded->soFar() == soFar);
    QVERIFY(loaded->settings() == settings);
    writeFileAtomically(path / surprisesName, R"({"kinds":["earthquake"]})");
    QVERIFY(loadSurprises(path) == nullptr);
    // As many photographs as no rehearsal takes, or fewer than none.
    for (const int wrong : {-1, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
      saveSurprises(Surprises(settings, {{}, {Surprise::bump}, 3, wrong}), path);
      QVERIFY(loadSurprises(path) == nullptr);
      saveSurprises(Surprises(settings, {{}, {Surprise::bump}, wrong, 3}), path);
      QVERIFY(loadSurprises(path) == nullptr);
    }
  }

  /// A manifest of the first version: keys that came later keep their defaults, those that went are ignored.
  void manifestsOfOlderVersionsOpen() {
    CalibrateSettings settings;
    stagesFromJson(Json::parse(R"({"windows":{"tile":4,"rows":32,"ridge":0.05,"smoothness":4.0}})"),
                   settings);
    QCOMPARE(settings.windows.rows, 32);
    QVERIFY(settings.chooseRidge);
    QCOMPARE(settings.linearization.levels, LinearizationSettings{}.levels);
  }
};

QTEST_APPLESS_MAIN(TestSettingsJson)
#include "test_settings_json.moc"
