// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/projector_statuses.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/verify.h"
#include "relucent/pipeline/warm_up.h"
#include "support/fake_projector.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::pipeline;
using relucent::calibration::CalibrationFolder;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;
using relucent::test::ProjectorFault;
namespace fs = std::filesystem;

namespace {

constexpr auto toRead = CalibrationFolder::Access::read, toWrite = CalibrationFolder::Access::write;

CalibrateSettings tiny() {
  venue::VenueSettings venue;
  venue.name = "plain";
  venue.projector = {24, 18};
  venue.camera = {20, 16};
  venue.pathsPerPixel = 16;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = 5;
  return settings;
}

RigSettings twoScreens() {
  ScreenRigSettings rig;
  return withScreens(
      rig, {{{"HDMI-1", {}, {}, {}}, {64, 48}, 60.0, "left"}, {{"HDMI-2", {}, {}, {}}, {64, 48}, 60.0, ""}});
}

FakeProjectorState quick() {
  FakeProjectorState state;
  state.looksUntilWarm = 0;
  return state;
}

}  // namespace

class TestNetworkProjectors : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path path() const { return fs::path(folder_.path().toStdString()) / QTest::currentTestFunction(); }

 private slots:
  void addressesAreKeptAndPasswordsAreApart() {
    CalibrateSettings settings = tiny();
    settings.network.addresses[0] = {"192.168.1.50", 4353, "secret"};
    settings.network.warmUp = WarmUp::power;
    createCalibration(path(), settings);
    CalibrationFolder folder = CalibrationFolder::open(path(), toWrite);
    QVERIFY(networkProjectorsOf(folder) == settings.network);
    QVERIFY(settingsOf(folder).network == settings.network);

    // Nothing but its own file knows the password, and nobody but its owner that file.
    const fs::path file = path() / passwordFile;
    QVERIFY(readFile(file).find("secret") != std::string::npos);
    QCOMPARE(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path()))
      if (entry.is_regular_file() && entry.path() != file)
        QVERIFY2(readFile(entry.path()).find("secret") == std::string::npos, entry.path().c_str());

    // Written again where others could read it, it is private again.
    fs::permissions(file, fs::perms::all);
    settings.network.addresses[0].password = "another";
    keepNetworkProjectors(folder, settings.network);
    QCOMPARE(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    QVERIFY(networkProjectorsOf(folder) == settings.network);

    settings.network.addresses[0].password.clear();
    keepNetworkProjectors(folder, settings.network);
    QVERIFY(!fs::exists(file));
    keepNetworkProjectors(folder, {});
    QVERIFY(networkProjectorsOf(folder) == NetworkProjectors());
    QVERIFY(!folder.settings().contains("network_projectors"));
  }

  void otherVersionsAreReadAndNonsenseIsASentence_data() {
    QTest::addColumn<QString>("section");
    QTest::addColumn<bool>("isRead");
    QTest::newRow("a later one")
        << R"({"version":2,"warm_up":"hot","projectors":[{"projector":1,"host":"a","x":1}]})" << true;
    QTest::newRow("no list") << R"({"version":1})" << false;
    QTest::newRow("no host") << R"({"projectors":[{"projector":1}]})" << false;
    QTest::newRow("a host that is none") << R"({"projectors":[{"projector":1,"host":"a b"}]})" << false;
    QTest::newRow("a port that is none")
        << R"({"projectors":[{"projector":1,"host":"a","port":99999}]})" << false;
    QTest::newRow("something else") << "7" << false;
  }
  void otherVersionsAreReadAndNonsenseIsASentence() {
    QFETCH(QString, section);
    QFETCH(bool, isRead);
    const fs::path place = path().string() + QTest::currentDataTag();
    createCalibration(place, tiny());
    CalibrationFolder folder = CalibrationFolder::open(place, toWrite);
    calibration::Json settings = folder.settings();
    settings["network_projectors"] = calibration::Json::parse(section.toStdString());
    folder.setSettings(settings);
    if (isRead)
      QCOMPARE(networkProjectorsOf(folder).addresses.at(0).host, std::string("a"));
    else
      QVERIFY(mentions(sentenceOf([&] { networkProjectorsOf(folder); }, ErrorKind::format),
                       "give the projectors' addresses again"));
  }

  void addressesAreGivenByNumberOrName_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("projector");  // -1: Error
    QTest::newRow("name") << "left=10.0.0.1" << 0;
    QTest::newRow("number") << "2=10.0.0.1:4400" << 1;
    QTest::newRow("number of a named one") << "1=10.0.0.1" << 0;
    QTest::newRow("which?") << "10.0.0.1" << -1;
    QTest::newRow("none such") << "3=10.0.0.1" << -1;
    QTest::newRow("zero") << "0=10.0.0.1" << -1;
    QTest::newRow("no address") << "1=" << -1;
    QTest::newRow("nothing") << "" << -1;
  }
  void addressesAreGivenByNumberOrName() {
    QFETCH(QString, text);
    QFETCH(int, projector);
    NetworkProjectors projectors;
    const std::string failure =
        sentenceOf([&] { addAddress(projectors, twoScreens(), text.toStdString()); }, ErrorKind::usage);
    QCOMPARE(failure.empty(), projector >= 0);
    QCOMPARE(projectors.addresses.size(), projector >= 0 ? std::size_t{1} : std::size_t{0});
    if (projector >= 0) QCOMPARE(projectors.addresses.begin()->first, static_cast<std::size_t>(projector));
  }

  void aChangedAddressKeepsItsPassword() {
    NetworkProjectors projectors;
    projectors.addresses[0] = {"10.0.0.1", 4352, "secret"};
    addAddress(projectors, tiny().rig, "10.0.0.2");
    QVERIFY((projectors.addresses.at(0) == pjlink::Address{"10.0.0.2", 4352, "secret"}));
  }

  void impossibleOnesAreTold() {
    NetworkProjectors projectors;
    projectors.addresses = {{0, {"10.0.0.1"}}, {1, {"10.0.0.1"}}, {2, {"10.0.0.3"}}};
    QCOMPARE(problems(projectors, twoScreens()).size(), std::size_t{2});
    CalibrateSettings settings = tiny();
    settings.network = projectors;
    QVERIFY(problems(settings).size() >= 2);
  }

  /// Powered on first, measured, and nothing of what was measured depends on where they are.
  void measuringSwitchesThemOn() {
    FakeProjector projector(quick());
    CalibrateSettings settings = tiny();
    settings.network = {{{0, projector.address()}}, WarmUp::power};
    projector.change([](FakeProjectorState& state) { state.signal = "1280x720"; });
    Progress quiet;
    const CalibrateResult result = calibrate(path(), settings, {}, quiet);
    QCOMPARE(projector.orders(), QStringList{"POWR 1"});
    QVERIFY(mentions(english(result.findings.front()), "receives 1280x720 pixels"));

    CalibrationFolder folder = CalibrationFolder::open(path(), toWrite);
    NetworkProjectors moved = networkProjectorsOf(folder);
    moved.addresses[0].host = "localhost";
    keepNetworkProjectors(folder, moved);
    QVERIFY(progressOf(folder, calibration::Stage::acquisition) == calibration::StageProgress::done);
    QVERIFY(progressOf(folder, calibration::Stage::inverse) == calibration::StageProgress::done);
  }

  void whatIsFinishedNeedsNoLamp() {
    FakeProjector projector(quick());
    CalibrateSettings settings = tiny();
    settings.network = {{{0, projector.address()}}, WarmUp::power};
    Progress quiet;
    calibrate(path(), settings, {}, quiet);
    const int visits = projector.connections();
    resume(path(), {}, quiet);
    QCOMPARE(projector.connections(), visits);
    // A check of what was measured does.
    projector.change([](FakeProjectorState& state) { state.power = "0"; });
    verifyCalibration(path(), {}, {}, quiet);
    QCOMPARE(projector.orders(), (QStringList{"POWR 1", "POWR 1"}));
  }

  void aProjectorThatDoesNotAnswerStopsBeforeAnythingIsMeasured() {
    FakeProjector projector(quick(), ProjectorFault::otherProtocol);
    CalibrateSettings settings = tiny();
    settings.network = {{{0, projector.address()}}, WarmUp::power};
    Progress quiet;
    QVERIFY(mentions(sentenceOf([&] { calibrate(path(), settings, {}, quiet); }, ErrorKind::device),
                     "does not speak PJLink"));
    // And goes on once it does.
    projector.setFault(ProjectorFault::none);
    QVERIFY(resume(path(), {}, quiet).exposures > 0);
  }

  void noneNeedsNoNetwork() {
    Progress quiet;
    CalibrateSettings settings = tiny();
    settings.network = {{{0, {"127.0.0.1", 1}}}, WarmUp::none};
    ProjectorWarmUp warmUp(settings.network, settings.rig);
    warmUp.switchOn(quiet);
    OpenedRig devices = openRig(settings.rig, {}, quiet);
    warmUp.awaitSteadyLight(devices.rig, quiet);
  }

  /// With the devices of a simulated venue, whose lamp drifts little, in no time of ours.
  void steadyLightIsAwaitedByTheRigsOwnCamera() {
    FakeProjector projector(quick());
    NetworkProjectors network{{{0, projector.address()}}, WarmUp::steady};
    pjlink::Waiting::Time now{};
    pjlink::Waiting waiting{[&] { return now; }, [&](std::chrono::milliseconds time) { now += time; }};
    Progress quiet;
    ProjectorWarmUp warmUp(network, tiny().rig, waiting);
    warmUp.switchOn(quiet);
    OpenedRig devices = openRig(tiny().rig, {}, quiet);
    const auto begin = now;
    warmUp.awaitSteadyLight(devices.rig, quiet);
    QVERIFY(now - begin >= std::chrono::seconds(108));
    QVERIFY(now - begin <= std::chrono::seconds(300));
  }

  void statusesOfSeveral() {
    FakeProjector left(quick()), right(quick(), ProjectorFault::closesAtOnce);
    left.beFound();
    Progress quiet;
    const std::vector<ProjectorStatus> statuses =
        projectorStatuses({{left.address(), right.address()}, {}, ProjectorOrder::on}, quiet);
    QCOMPARE(statuses.size(), std::size_t{2});
    QVERIFY(statuses[0].report && statuses[0].problem.empty());
    QVERIFY(statuses[0].report->power == pjlink::Power::on);
    QVERIFY(!statuses[1].report && !statuses[1].problem.empty());
    pjlink::SearchSettings search{std::chrono::milliseconds(400), {"127.0.0.1"}, left.address().port};
    // What is found answers at the standard port, where this one does not listen.
    QCOMPARE(projectorStatuses({{}, search}, quiet).size(), std::size_t{1});
  }

  void passwordsComeFromFiles() {
    const fs::path file = fs::path(folder_.path().toStdString()) / "password";
    writeFileAtomically(file, "secret\r\nsecond line\n");
    QCOMPARE(passwordFrom(file), std::string("secret"));
    writeFileAtomically(file, "\nsecret");
    QVERIFY(mentions(sentenceOf([&] { passwordFrom(file); }, ErrorKind::input), "no password"));
  }
};

QTEST_GUILESS_MAIN(TestNetworkProjectors)
#include "test_network_projectors.moc"
