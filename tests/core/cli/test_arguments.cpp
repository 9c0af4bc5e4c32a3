// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <QTest>
#include <cstdlib>

#include "relucent/cli/arguments.h"
#include "relucent/pipeline/command_devices.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::cli;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

std::vector<std::string> words(const QByteArray& line) {
  std::vector<std::string> result;
  for (const QByteArray& word : line.split(' '))
    if (!word.isEmpty()) result.push_back(word.toStdString());
  return result;
}

template <typename Made>
Made parsed(const QByteArray& line) {
  return std::get<Made>(parseArguments(words(line)).command);
}

}  // namespace

class TestArguments : public QObject {
  Q_OBJECT

 private slots:
  void sizes_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<bool>("valid");
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("usual") << QByteArray("256x192") << true << 256 << 192;
    QTest::newRow("capital") << QByteArray("1X2") << true << 1 << 2;
    QTest::newRow("zero is a size, though impossible") << QByteArray("0x0") << true << 0 << 0;
    for (const char* wrong : {"", "x", "256", "256x", "x192", "256x192x3", "256 x192", "12.5x10", "0x10x",
                              "axb", "99999999999x1", "256*192"})
      QTest::newRow(*wrong != '\0' ? wrong : "nothing") << QByteArray(wrong) << false << 0 << 0;
  }
  void sizes() {
    QFETCH(QByteArray, text);
    QFETCH(bool, valid);
    QFETCH(int, width);
    QFETCH(int, height);
    if (!valid) {
      QVERIFY_EXCEPTION_THROWN(parseSize(text.toStdString()), WrongUsage);
      return;
    }
    QVERIFY((parseSize(text.toStdString()) == Size{width, height}));
  }

  void calibrateHasDefaults() {
    Calibrate command = parsed<Calibrate>("calibrate demo");
    QCOMPARE(command.calibration, std::filesystem::path("demo"));
    const auto& venue = std::get<VenueSettings>(command.settings.rig);
    QCOMPARE(venue.name, std::string("corner"));
    QVERIFY((venue.projector == Size{256, 192}));
    QVERIFY((venue.camera == Size{160, 120}));
    QCOMPARE(venue.devices.cameraBits, DeviceModelSettings().cameraBits);
    QCOMPARE(command.settings.acquisition.scheme, AcquisitionScheme::multiplexed);
    QCOMPARE(command.settings.acquisition.relativeThreshold,
             settingsOf(AcquisitionMode::multiplexed).relativeThreshold);
    QCOMPARE(command.cache, defaultCache());
  }

  void calibrateTakesEveryOption() {
    Calibrate command = parsed<Calibrate>(
        "calibrate d --venue dome --projector 64x48 --camera 32x24 --seed 9 --threshold 0.02 --levels 17 "
        "--acquisition adaptive --colour rgb --cache /tmp/c --camera-bits 8 --white-segment --drift 0.01 "
        "--paths 16 --camera-pixels 1/3");
    const auto& venue = std::get<VenueSettings>(command.settings.rig);
    QCOMPARE(venue.name, std::string("dome"));
    QVERIFY((venue.projector == Size{64, 48}));
    QVERIFY((venue.camera == Size{32, 24}));
    QCOMPARE(venue.seed, std::uint64_t{9});
    QCOMPARE(venue.pathsPerPixel, 16);
    QCOMPARE(venue.devices.cameraBits, 8);
    QCOMPARE(venue.devices.drift, 0.01);
    QVERIFY(venue.devices.whiteSegment);
    QCOMPARE(command.settings.acquisition.relativeThreshold, 0.02);
    QCOMPARE(command.settings.acquisition.seed, std::uint64_t{9});
    QCOMPARE(command.settings.linearization.seed, std::uint64_t{9});
    QCOMPARE(command.settings.linearization.levels, 17);
    QCOMPARE(command.cache, std::filesystem::path("/tmp/c"));
    QVERIFY((command.settings.pixels == reduction::PixelUse{reduction::PixelUse::Kind::binned, 3}));
    QVERIFY(parsed<Calibrate>("calibrate d").settings.pixels == reduction::PixelUse());
    QVERIFY(parsed<ImportPictures>("import d --patterns a --photographs b --camera-pixels all")
                .settings.pixels.kind == reduction::PixelUse::Kind::all);
  }

  void aFullDiskIsWaitedForUnlessToldOtherwise() {
    QCOMPARE(parsed<Calibrate>("calibrate d").fullDisk, FullDiskAction::wait);
    QCOMPARE(parsed<Resume>("resume d").fullDisk, FullDiskAction::wait);
    QCOMPARE(parsed<Calibrate>("calibrate d --full-disk stop").fullDisk, FullDiskAction::stop);
    QCOMPARE(parsed<Resume>("resume d --full-disk stop").fullDisk, FullDiskAction::stop);
  }

  void whatIsKeptIsChosen() {
    using pipeline::KeptPhotographs;
    QCOMPARE(parsed<Calibrate>("calibrate d").kept, KeptPhotographs::everything);
    QCOMPARE(parsed<Calibrate>("calibrate d --keep results").kept, KeptPhotographs::results);
    const Tidy tidy = parsed<Tidy>("tidy a b --keep latest --dry-run");
    QCOMPARE(tidy.calibrations, (std::vector<std::filesystem::path>{"a", "b"}));
    QCOMPARE(tidy.settings.kept, KeptPhotographs::latest);
    QVERIFY(tidy.settings.dryRun);
    QVERIFY(!parsed<Tidy>("tidy a").settings.kept && !parsed<Tidy>("tidy a").settings.dryRun);
  }

  void externalProgramsAreARig() {
    Calibrate command = parsed<Calibrate>(
        "calibrate d --projector-command show,{image} --camera-command shoot,{exposure},{output} "
        "--projector 1024x768 --longest 2");
    const auto& rig = std::get<CommandRigSettings>(command.settings.rig);
    QCOMPARE(rig.projectorCommand, std::string("show,{image}"));
    QCOMPARE(rig.cameraCommand, std::string("shoot,{exposure},{output}"));
    QVERIFY((rig.projector == Size{1024, 768}));
    QVERIFY(!rig.camera);
    QCOMPARE(rig.longestExposure, 2.0);
  }

  void aCameraMayHaveAnAddress_data() {
    QTest::addColumn<QByteArray>("address");
    for (const char* address :
         {"genicam:40012345", "genicam:192.168.1.20", "v4l2:/dev/v4l/by-id/usb-A-index0"})
      QTest::newRow(address) << QByteArray(address);
  }
  void aCameraMayHaveAnAddress() {
    QFETCH(QByteArray, address);
    const QByteArray line =
        "calibrate d --projector-command show,{image} --projector 1024x768 --camera " + address;
    const auto whole = std::get<CommandRigSettings>(parsed<Calibrate>(line.constData()).settings.rig);
    QCOMPARE(whole.cameraAddress, address.toStdString());
    QVERIFY(!whole.camera);
    const QByteArray more = line + " --camera-size 640x480 --record tape";
    const auto part = std::get<CommandRigSettings>(parsed<Calibrate>(more.constData()).settings.rig);
    QVERIFY((part.camera == Size{640, 480}));
    QVERIFY(std::filesystem::path(part.record).is_absolute());
    QVERIFY(part.record.ends_with("/tape"));
  }

  /// Devices are in the order in which they are named; one size stands for all.
  void severalDevicesAreARig_data() {
    QTest::addColumn<QByteArray>("line");
    QTest::addColumn<QList<Size>>("projectors");
    QTest::addColumn<QByteArray>("cameras");  // command or address, size
    const QByteArray show = "calibrate d --projector-command a,{image} --projector-command b,{image} ";
    const QByteArray photograph =
        "--camera-command c,{exposure},{output} --camera-command d,{exposure},{output} ";
    QTest::newRow("mixed sizes") << show + photograph +
                                        "--projector 64x48 --projector 80x60 --camera 32x24 --camera 40x30"
                                 << QList<Size>{{64, 48}, {80, 60}}
                                 << QByteArray("c,{exposure},{output} 32x24; d,{exposure},{output} 40x30; ");
    QTest::newRow("one size") << show + photograph + "--projector 64x48 --camera 32x24"
                              << QList<Size>{{64, 48}, {64, 48}}
                              << QByteArray("c,{exposure},{output} 32x24; d,{exposure},{output} 32x24; ");
    QTest::newRow("addresses") << show +
                                      "--projector 64x48 --camera genicam:7 --camera v4l2:/dev/video0 "
                                      "--camera genicam:8 --camera-size 32x24 --camera-size 40x30 "
                                      "--camera-size 48x36"
                               << QList<Size>{{64, 48}, {64, 48}}
                               << QByteArray("genicam:7 32x24; v4l2:/dev/video0 40x30; genicam:8 48x36; ");
    QTest::newRow("a command among addresses")
        << show + "--projector 64x48 --camera genicam:7 --camera command:c,{exposure},{output}"
        << QList<Size>{{64, 48}, {64, 48}} << QByteArray("genicam:7 ; command:c,{exposure},{output} ; ");
  }
  void severalDevicesAreARig() {
    QFETCH(QByteArray, line);
    QFETCH(QList<Size>, projectors);
    QFETCH(QByteArray, cameras);
    const auto rig = std::get<CommandRigSettings>(parsed<Calibrate>(line).settings.rig);
    const std::vector<CommandRigSettings::Projector> given = projectorsOf(rig);
    QCOMPARE(std::ssize(given), projectors.size());
    for (qsizetype i = 0; i < projectors.size(); ++i) {
      const CommandRigSettings::Projector& projector = given[static_cast<std::size_t>(i)];
      QCOMPARE(projector.command, i == 0 ? "a,{image}" : "b,{image}");
      QVERIFY(projector.size == projectors[i]);
    }
    QByteArray said;
    for (const CommandRigSettings::Camera& camera : camerasOf(rig)) {
      said += camera.command + camera.address + ' ';
      if (camera.size) said += fmt::format("{}x{}", camera.size->width, camera.size->height);
      said += "; ";
    }
    QCOMPARE(said, cameras);
  }

  void whatIsCheckedIsARig() {
    const auto real = parsed<CheckRig>(
        "check --projector-command show,{image} --projector 640x480 --camera genicam:7 --frame-rate 50");
    QCOMPARE(std::get<CommandRigSettings>(real.settings.rig).cameraAddress, std::string("genicam:7"));
    QCOMPARE(real.settings.latency.frame, 0.02);
    QCOMPARE(std::get<VenueSettings>(parsed<CheckRig>("check --venue dome").settings.rig).name,
             std::string("dome"));
  }

  void aRecordingIsARig() {
    const auto rig =
        std::get<ReplayRigSettings>(parsed<Calibrate>("calibrate d --replay /tape").settings.rig);
    QCOMPARE(rig.folder, std::string("/tape"));
    parsed<ListDevices>("devices");
  }

  void otherCommandsTakeTheirOptions() {
    Compensate compensate = parsed<Compensate>(
        "compensate d --image a.png --out o --method mix --corners 1 2 3 4 5 6 7 8 --black-lift 0.02 "
        "--dark-share 5 --fit cover --solver descent --objective light "
        "--brightness region");
    QVERIFY(compensate.settings.target.fit == Fit::cover);
    QVERIFY(compensate.settings.solver == SolverSettings::Algorithm::steepestDescent);
    QVERIFY(compensate.settings.method == Method::mix);
    QCOMPARE(compensate.settings.image, std::filesystem::path("a.png"));
    QCOMPARE(compensate.settings.target.corners->at(2).at(1), 6.0);
    QCOMPARE(compensate.settings.target.blackLift, 0.02);
    QCOMPARE(compensate.settings.target.reachablePercentile, 5.0);
    QVERIFY(compensate.settings.target.objective == Objective::light);
    QVERIFY(compensate.settings.target.brightness == Brightness::region);

    Compensate views = parsed<Compensate>(
        "compensate d --image a.png --out o --view-weights 0.5 1 0 --view-corners 2:auto "
        "--view-corners 3:1,2.5,3,4,5,6,7,8");
    const std::vector<ViewSettings> expected{
        {0.5, ViewPlacement::surface, {}},
        {1.0, ViewPlacement::own, {}},
        {0.0, ViewPlacement::own, Corners{{{1, 2.5}, {3, 4}, {5, 6}, {7, 8}}}}};
    QVERIFY(views.settings.target.views == expected);
    QVERIFY(!views.settings.target.viewer);
    const TargetSettings walked = parsed<Evaluate>(
                                      "evaluate d --camera-position 1:0,2.5 --camera-position 2:-1.5,2,0.5 "
                                      "--viewer 0.5,2,0.25")
                                      .settings.target;
    QVERIFY((walked.views.at(0).position == Position{0, 2.5, 0}));
    QVERIFY((walked.views.at(1).position == Position{-1.5, 2, 0.5}));
    QVERIFY((walked.viewer == Position{0.5, 2, 0.25}));

    QVERIFY(!parsed<Compensate>("compensate d --image a.png --out o").settings.target.masks);
    const std::vector<Mask> masks{{0, Outline::lines, {{0.1, 0.2}, {0.3, 0.2}, {0.3, 0.4}}, 0.02},
                                  {1, Outline::lines, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.02}};
    QVERIFY(parsed<Evaluate>("evaluate d --mask 0.1,0.2,0.3,0.2,0.3,0.4 --mask 2:0,0,1,0,1,1,0,1")
                .settings.target.masks == masks);
    QVERIFY(parsed<Compensate>("compensate d --image a.png --out o --masks none").settings.target.masks ==
            std::vector<Mask>());
    QVERIFY(parsed<Calibrate>("calibrate d --venue corner --mask 0.1,0.2,0.3,0.2,0.3,0.4")
                .settings.content.masks == std::vector<Mask>{masks.front()});
    QVERIFY(!parsed<cli::Masks>("masks d").masks &&
            parsed<cli::Masks>("masks d --masks none").masks->empty());
    for (const char* wrong : {"1,2,3", "0.1,0.2,", "a", "0:0,0,1,0,1,1", "1,2,3,4,5,6 7", "2:"})
      QVERIFY_THROWS_EXCEPTION(WrongUsage, parseArguments({"masks", "d", "--mask", wrong}));

    QVERIFY(parsed<cli::Sets>("sets d").action == SetAction::list);
    const auto renamed = parsed<cli::Sets>("sets d rename day dawn");
    QVERIFY(renamed.action == SetAction::rename);
    QVERIFY((renamed.names == std::vector<std::string>{"day", "dawn"}));
    for (const char* wrong :
         {"sets d save", "sets d use a b", "sets d rename a", "sets d foo", "sets d list a"})
      QVERIFY_THROWS_EXCEPTION(WrongUsage, parsed<cli::Sets>(wrong));
    QCOMPARE(parsed<Compensate>("compensate d --image a.png --out o --set night").settings.set,
             std::string("night"));
    // A set says all that they say.
    QVERIFY_THROWS_EXCEPTION(WrongUsage, parsed<Evaluate>("evaluate d --set night --brightness region"));

    Evaluate evaluate =
        parsed<Evaluate>("evaluate d --image a.png --image b.exr --method mix --method refined");
    QCOMPARE(evaluate.settings.images.size(), std::size_t{2});
    QVERIFY((evaluate.settings.methods == std::vector{Method::mix, Method::refined}));
    QVERIFY(!evaluate.settings.blended && parsed<Evaluate>("evaluate d --blended").settings.blended);
    QVERIFY(parsed<Evaluate>("evaluate d").settings.methods.empty());
    QVERIFY(parsed<Evaluate>("evaluate d").settings.rivals.empty());
    QVERIFY((parsed<Evaluate>("evaluate d --rival robust --rival corrected").settings.rivals ==
             std::vector{Rival::robust, Rival::corrected}));
    const WalkSettings walk = parsed<Evaluate>("evaluate d --walk 24 --film f").settings.walk;
    QVERIFY(walk.frames == 24 && walk.film == "f");
    QCOMPARE(parsed<Evaluate>("evaluate d").settings.walk.frames, 0);

    QCOMPARE(parsed<Export>("export d --transport T.npz").settings.transport, std::filesystem::path("T.npz"));
    const pipeline::ExportSettings players =
        parsed<Export>("export d --mpcdi v.mpcdi --player-maps maps --canvas 800x600").settings;
    QCOMPARE(players.mpcdi, std::filesystem::path("v.mpcdi"));
    QCOMPARE(players.playerMaps, std::filesystem::path("maps"));
    QCOMPARE(players.canvas, Size({800, 600}));
    QCOMPARE(parsed<Export>("export d --mpcdi v.mpcdi").settings.canvas, Size({1920, 1080}));
    QVERIFY(!parsed<Relight>("relight d --image a.png --out o.exr").dual);
    QVERIFY(parsed<Relight>("dual d --out o.exr").dual);
    Separate separate = parsed<Separate>("separate d --reach 0.1 --out o");
    QCOMPARE(separate.settings.direct.reach, 0.1);
    QCOMPARE(separate.settings.out, std::filesystem::path("o"));
    Difference difference = parsed<Difference>("difference a.exr b.exr --out o.png --gain 1.75");
    QCOMPARE(difference.settings.second, std::filesystem::path("b.exr"));
    QCOMPARE(difference.settings.gain.value(), 1.75);
    QVERIFY(!parsed<Difference>("difference a b --out o.png --gain auto").settings.gain);
    QVERIFY(parsed<Report>("report d").settings.evaluate);
    QVERIFY(!parsed<Report>("report d --no-evaluate").settings.evaluate);
    QCOMPARE(parsed<Bench>("bench windows").name, std::string("windows"));
    QVERIFY(parsed<Bench>("bench windows").suite == BenchSuite::parts);
    QVERIFY(parsed<Bench>("bench engine --backend opengl").backend == BackendChoice::openGl);
    QVERIFY(parsed<Bench>("bench engine").suite == BenchSuite::engine);
    QVERIFY(!parsed<Bench>("bench engine").engine);
    const Bench devices =
        parsed<Bench>("bench engine --devices 4x1024x768/3x640x480 --backend cpu --one-thread");
    QVERIFY(devices.engine && devices.engine->projectors == 4 && devices.engine->cameras == 3 &&
            devices.engine->projector == Size({1024, 768}) && devices.engine->camera == Size({640, 480}) &&
            devices.engine->backend == BackendChoice::cpu && devices.engine->oneThread);
    const Bench scale = parsed<Bench>("bench scale --sizes 64x48/40x30 --sizes 80x60/50x40");
    QVERIFY(scale.suite == BenchSuite::scale);
    QVERIFY(
        (scale.scale.sizes == std::vector<pipeline::VenueSizes>{{{64, 48}, {40, 30}}, {{80, 60}, {50, 40}}}));
    const AcquisitionBenchSettings chosen =
        parsed<Bench>("bench acquisition --venue corner --acquisition sen --threshold 0.02 --threshold 0.05")
            .acquisition;
    QCOMPARE(chosen.venues, std::vector<std::string>{"corner"});
    QVERIFY(chosen.modes == std::vector{AcquisitionMode::sen});
    QCOMPARE(chosen.thresholds, (std::vector<double>{0.02, 0.05}));
    QCOMPARE(parsed<Resume>("resume d").calibration, std::filesystem::path("d"));
    Prove prove = parsed<Prove>("prove d --image a.png --out o --method mix --black-lift 0.02");
    QVERIFY(prove.settings.method == Method::mix);
    QCOMPARE(prove.settings.target.blackLift, 0.02);
    QCOMPARE(prove.settings.image, std::filesystem::path("a.png"));
    const Perfect perfect =
        parsed<Perfect>("perfect d --content a.png --content list.playlist --canvas 640x480 --photographs 4");
    QCOMPARE(perfect.content, (std::vector<std::filesystem::path>{"a.png", "list.playlist"}));
    QVERIFY((perfect.settings.canvas.size == Size{640, 480}));
    QCOMPARE(perfect.settings.photographs, 4);
    QVERIFY(!perfect.forget);
    QVERIFY((parsed<Perfect>("perfect d --content a").settings.canvas.size == Size{1920, 1080}));
    QVERIFY(parsed<Perfect>("perfect d --forget").forget);
    QVERIFY_THROWS_EXCEPTION(WrongUsage, parsed<Perfect>("perfect d"));
  }

  void nights() {
    const TendNight night =
        parsed<TendNight>("night d --content a.png --canvas 640x480 --photographs 3 --change dust:0.1");
    QCOMPARE(night.content, (std::vector<std::filesystem::path>{"a.png"}));
    QVERIFY((night.settings.canvas.size == Size{640, 480}));
    QCOMPARE(night.settings.photographs, 3);
    QCOMPARE(night.changes.dust, 0.1);
    QVERIFY(!night.history && parsed<TendNight>("night d --history").history);
    QVERIFY(parsed<TendNight>("night d").content.empty());  // a standard picture is proved
    QVERIFY_THROWS_EXCEPTION(WrongUsage, parsed<TendNight>("night d --history --content a.png"));
    QCOMPARE(parsed<TendNight>("night d --alarm ./call").settings.alarmCommand, std::string("./call"));
    QVERIFY(night.settings.alarmCommand.empty());
    QVERIFY_THROWS_EXCEPTION(WrongUsage, parsed<TendNight>("night d --history --alarm ./call"));
  }

  void repairsAndChanges() {
    QVERIFY(parsed<Repair>("repair d --undo").undo);
    QCOMPARE(parsed<Repair>("repair d --image p.png").settings.image, std::filesystem::path("p.png"));
    QVERIFY(!parsed<Repair>("repair d").changes.any());
    const venue::Changes changes =
        parsed<Repair>(
            "repair d --change camera:1.5,-2,0.25,2 --change painted:0.4,0.6,0.1 --change lamps:1,0.9,0.8 "
            "--change ambient:0.01")
            .changes;
    QCOMPARE(changes.cameras.size(), 1);
    QCOMPARE(changes.cameras[0].device, 1);
    QCOMPARE(changes.cameras[0].y, -2.0);
    QCOMPARE(changes.painted[0].radius, 0.1);
    QCOMPARE(changes.lamps[2], 0.8);
    QCOMPARE(*changes.ambient, 0.01);
    for (const char* command :
         {"verify d", "prove d --image a --out o", "perfect d --content a", "evaluate d"})
      QVERIFY_THROWS_EXCEPTION(WrongUsage, parseArguments(words(QByteArray(command) + " --change eaten:1")));
    for (const char* wrong : {"", "camera", "camera:1", "camera:1,2,x", "camera:1,2,3,0", "camera:1,2,3,-5",
                              "dust:0.1,0.2", "lamps:", "camera:1,2,3,1e30"})
      QVERIFY_THROWS_EXCEPTION(WrongUsage, parseArguments(words(QByteArray("repair d --change ") + wrong)));
    QVERIFY_THROWS_EXCEPTION(WrongUsage, parsed<Repair>("repair d --undo --image p.png"));
    QCOMPARE(parsed<Verify>("verify d --out maps").calibration, std::filesystem::path("d"));
    QCOMPARE(parsed<Verify>("verify d --out maps").settings.out, std::filesystem::path("maps"));
  }

  void jsonMayStandAnywhere() {
    QVERIFY(parseArguments(words("--json venues")).json);
    QVERIFY(parseArguments(words("venues --json")).json);
    QVERIFY(parseArguments(words("verify d --allow-commands")).allowCommands);
    QVERIFY(parseArguments(words("--allow-commands verify d")).allowCommands);
    QVERIFY(!parseArguments(words("verify d")).allowCommands);
    QVERIFY(parseArguments(words("evaluate d --json --image a.png")).json);
    QVERIFY(!parseArguments(words("venues")).json);
  }

  void helpAndVersionArePrinted_data() {
    QTest::addColumn<QByteArray>("line");
    QTest::addColumn<QByteArray>("contains");
    QTest::newRow("help") << QByteArray("--help") << QByteArray("Subcommands");
    QTest::newRow("version") << QByteArray("--version") << QByteArray("relucent-cli ");
    QTest::newRow("libraries' versions") << QByteArray("--version") << QByteArray("\n  Eigen 3.");
    for (const char* name : {"venues", "calibrate", "resume", "compensate", "evaluate", "export", "relight",
                             "separate", "difference", "dual", "report", "tidy", "bench"})
      QTest::newRow(name) << QByteArray(name) + " --help" << QByteArray("relucent-cli ") + name;
  }
  void helpAndVersionArePrinted() {
    QFETCH(QByteArray, line);
    QFETCH(QByteArray, contains);
    QByteArray text = QByteArray::fromStdString(parsed<PrintText>(line).text);
    QVERIFY2(text.contains(contains), text);
  }

  void wrongUsage_data() {
    QTest::addColumn<QByteArray>("line");
    QTest::addColumn<QByteArray>("says");
    QTest::newRow("nothing") << QByteArray("") << QByteArray("say what to do");
    QTest::newRow("only an option") << QByteArray("--json") << QByteArray("say what to do");
    QTest::newRow("unknown") << QByteArray("celebrate d")
                             << QByteArray("'celebrate' cannot be done: there are venues");
    QTest::newRow("no such command") << QByteArray("dream d") << QByteArray("'dream' cannot be done");
    QTest::newRow("nothing to import") << QByteArray("import d") << QByteArray("--patterns is required");
    QTest::newRow("no folder") << QByteArray("calibrate") << QByteArray("CALIBRATION is required");
    QTest::newRow("unknown option") << QByteArray("calibrate d --fast") << QByteArray("--fast");
    QTest::newRow("nothing to tidy") << QByteArray("tidy") << QByteArray("CALIBRATION is required");
    QTest::newRow("unknown choice") << QByteArray("tidy d --keep merged") << QByteArray("everything");
    QTest::newRow("no size") << QByteArray("calibrate d --camera big") << QByteArray("'big' is no size");
    QTest::newRow("no pixels") << QByteArray("calibrate d --camera-pixels half")
                               << QByteArray("'half' is no choice of camera pixels: write auto, all or 1/N");
    QTest::newRow("no number") << QByteArray("calibrate d --seed one") << QByteArray("--seed");
    QTest::newRow("mode") << QByteArray("calibrate d --acquisition slow") << QByteArray("adaptive");
    QTest::newRow("method") << QByteArray("compensate d --image a --out b --method magic")
                            << QByteArray("optimum");
    QTest::newRow("gain") << QByteArray("difference a b --out o.png --gain much") << QByteArray("no gain");
    QTest::newRow("fit") << QByteArray("compensate d --image a --out b --fit squeeze")
                         << QByteArray("squeeze");
    QTest::newRow("no image") << QByteArray("compensate d --out b") << QByteArray("--image is required");
    for (const char* place :
         {"2", "0:auto", "2:automatic", "2:1,2,3,4,5,6,7", "2:1,2,3,4,5,6,7,8,9", "x:auto"})
      QTest::addRow("view-corners %s", place)
          << QByteArray("compensate d --image a --out b --view-corners ") + place
          << QByteArray("CAMERA:auto");
    for (const char* place : {"1,2,3", "0:1,2", "1:1", "1:1;2", "1:1,2,3,4", "1:a,b"})
      QTest::addRow("camera-position %s", place)
          << QByteArray("evaluate d --camera-position ") + place << QByteArray("no camera's position");
    for (const char* place : {"1", "x,y", "1,2,3,4"})
      QTest::addRow("viewer %s", place)
          << QByteArray("evaluate d --viewer ") + place << QByteArray("no viewer's position");
    QTest::newRow("seven numbers") << QByteArray("compensate d --image a --out b --corners 1 2 3 4 5 6 7")
                                   << QByteArray("--corners");
    QTest::newRow("nothing to export")
        << QByteArray("export d")
        << QByteArray("--transport, --leaves, --inverse, --maps, --mpcdi or --player-maps");
    QTest::newRow("half a rig") << QByteArray("calibrate d --projector-command a")
                                << QByteArray("external programs need");
    QTest::newRow("rig without a size")
        << QByteArray("calibrate d --projector-command a --camera-command b") << QByteArray("--projector");
    QTest::newRow("two rigs") << QByteArray(
                                     "calibrate d --projector-command a --camera-command b --projector 8x8 "
                                     "--venue corner")
                              << QByteArray("not both");
    QTest::newRow("simulated option")
        << QByteArray("calibrate d --projector-command a --camera-command b --projector 8x8 --drift 0.1")
        << QByteArray("--drift is for simulated venues only");
    QTest::newRow("unknown kind of camera") << QByteArray("calibrate d --camera usb:7")
                                            << QByteArray("'usb:7' is not a camera: write genicam:SERIAL");
    QTest::newRow("camera alone") << QByteArray("calibrate d --camera genicam:7")
                                  << QByteArray("needs --projector-command and --projector");
    QTest::newRow("two cameras")
        << QByteArray(
               "calibrate d --projector-command a --camera-command b --projector 8x8 --camera genicam:7")
        << QByteArray("not both");
    const QByteArray two = "calibrate d --projector-command a --projector-command b --camera-command c ";
    QTest::newRow("three sizes of two projectors")
        << two + "--projector 8x8 --projector 8x9 --projector 9x9"
        << QByteArray("--projector is given 3 times for 2 devices");
    QTest::newRow("two sizes of one camera") << two + "--projector 8x8 --camera 8x8 --camera 9x9"
                                             << QByteArray("--camera is given 2 times for one device");
    QTest::newRow("two projectors of a venue")
        << QByteArray("calibrate d --venue dome4 --projector 8x8 --projector 9x9")
        << QByteArray("give --projector once");
    QTest::newRow("size without an address")
        << QByteArray("calibrate d --camera-size 8x8") << QByteArray("write --camera WxH");
    QTest::newRow("recording and devices") << QByteArray("calibrate d --replay t --projector-command a")
                                           << QByteArray("--projector-command cannot be used with --replay");
    QTest::newRow("recording and venue")
        << QByteArray("calibrate d --replay t --venue corner") << QByteArray("not both");
    QTest::newRow("nothing to check") << QByteArray("check") << QByteArray("nothing to check");
    QTest::newRow("half to check") << QByteArray("check --camera genicam:7")
                                   << QByteArray("real devices need --projector-command");
    QTest::newRow("two to check") << QByteArray("check --camera genicam:7 --venue dome")
                                  << QByteArray("not both");
    QTest::newRow("no frames") << QByteArray("check --venue dome --frame-rate 0") << QByteArray("above 0");
    QTest::newRow("nothing to record")
        << QByteArray("calibrate d --record t") << QByteArray("--record is for real devices");
    QTest::newRow("two folders") << QByteArray("resume a b") << QByteArray("b");
  }
  void wrongUsage() {
    QFETCH(QByteArray, line);
    QFETCH(QByteArray, says);
    try {
      parseArguments(words(line));
      QFAIL("was understood");
    } catch (const WrongUsage& error) {
      QVERIFY2(QByteArray(error.what()).contains(says), error.what());
      QVERIFY2(QByteArray(error.what()).contains("--help`."), error.what());
      QVERIFY2(!QByteArray(error.what()).contains('\n'), error.what());
    }
  }

  void cacheFollowsTheEnvironment() {
    ::setenv("XDG_CACHE_HOME", "/caches", 1);
    QCOMPARE(defaultCache(), std::filesystem::path("/caches/relucent"));
    ::setenv("XDG_CACHE_HOME", "relative/is/ignored", 1);
    ::setenv("HOME", "/home/me", 1);
    QCOMPARE(defaultCache(), std::filesystem::path("/home/me/.cache/relucent"));
    ::unsetenv("XDG_CACHE_HOME");
    ::unsetenv("HOME");
    QVERIFY(defaultCache().empty());
  }
};

QTEST_APPLESS_MAIN(TestArguments)
#include "test_arguments.moc"
