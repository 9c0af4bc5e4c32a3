// SPDX-License-Identifier: MIT
// Pictures that are corrected by photographs of themselves, whatever happens to the camera meanwhile.
#include "relucent/pipeline/perfect.h"

#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <fstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/image/metrics.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stills.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/tidy.h"
#include "relucent/venue/device_faults.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::pipeline;
using namespace relucent::venue;
namespace fs = std::filesystem;

namespace {

Progress quiet;
constexpr Size projector{40, 30}, camera{28, 21};

VenueSettings venueNamed(const std::string& name) {
  VenueSettings venue;
  venue.name = name;
  venue.projector = projector;
  venue.camera = camera;
  venue.pathsPerPixel = 32;
  return venue;
}

}  // namespace

class TestPerfect : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }

  /// A copy of a calibration, measured once.
  fs::path copyOf(const std::string& venue, const char* name) {
    fs::path copy = root() / (venue + "-" + name);
    fs::copy(root() / venue, copy, fs::copy_options::recursive);
    return copy;
  }
  fs::path picture(std::size_t which = 0) const {
    return root() / ("picture" + std::to_string(which) + ".png");
  }

  /// What truly is seen of a drive, against what is wanted: the weighed error without noise.
  double trueError(const SimulatedVenue& venue, const fs::path& folder, const ProjectorStack& drive) {
    const CalibrationFolder calibration = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
    const MeasuredCalibration measured = loadCalibration(calibration, quiet);
    const Target target =
        fitTarget(readLinearContent(picture()), measured.venue, targetOf(settingsOf(calibration).content));
    hdr::HdrFrame light;
    light.radiance = venue.trueRadiance(
        encodedDrive(drive, measured.venue.transport.projectors(), measured.linearization));
    for (std::size_t i = 0; i < light.radiance.size(); ++i) light.radiance[i] -= venue.trueBlack()[i];
    light.variance.assign(light.radiance.size(), 0.0f);
    light.valid.assign(light.radiance.size(), 1);
    return weighedError(light, target).value;
  }
  ProjectorStack shownAsMeasured(const fs::path& folder) {
    const CalibrationFolder calibration = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
    const MeasuredCalibration measured = loadCalibration(calibration, quiet);
    const Target target =
        fitTarget(readLinearContent(picture()), measured.venue, targetOf(settingsOf(calibration).content));
    return Compensator(measured.venue, measured.inverse).solve(Method::refined, target, quiet).projector;
  }
  std::string keyOf(const fs::path& folder, const fs::path& image) {
    const CalibrationFolder calibration = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
    return perfectedKey(fingerprintOfShown(calibration),
                        contentIdentity(readFile(image), readLinearContent(image).size(), {}));
  }
  /// As a perfected picture is kept, of made-up drive.
  void keep(const fs::path& folder, const fs::path& image, float level) {
    savePerfected({keyOf(folder, image),
                   folder,
                   image.string(),
                   "2026-01-01T00:00:00Z",
                   {{{20.0, 3.0}}, {{21.0, 2.0}}, 7},
                   {},
                   fingerprintOfShown(CalibrationFolder::open(folder, CalibrationFolder::Access::read)),
                   ContentCanvas{}},
                  ProjectorStack(3 * projector.count(), level), Rasters(projector));
  }

 private slots:
  void initTestCase() {
    for (const char* name : {"corner", "glass"}) {
      CalibrateSettings settings;
      settings.rig = venueNamed(name);
      settings.linearization.levels = 9;
      calibrate(root() / name, settings, root() / "cache", quiet);
    }
    for (std::size_t which : {0, 1}) writePng(picture(which), srgbEncoded(standardImages()[which].linear), 8);
  }

  void neverWorse_data() {
    QTest::addColumn<QString>("venue");
    QTest::addColumn<QVector<int>>("fault");  // kind, from shot, to shot
    QTest::addColumn<double>("amount");
    QTest::addColumn<bool>("disturbed");
    constexpr int always = 1000;
    const auto row = [&](const char* name, const char* venue, FaultKind kind, int first, int last,
                         double amount, bool disturbed) {
      QTest::addRow("%s, %s", venue, name)
          << venue << QVector<int>{static_cast<int>(kind), first, last} << amount << disturbed;
    };
    for (const char* venue : {"corner", "glass"}) {
      row("nothing happens", venue, FaultKind::hand, always, always, 0.0, false);
      row("bumped before", venue, FaultKind::shiftedCamera, 0, always, 1.0, true);
      row("bumped meanwhile", venue, FaultKind::shiftedCamera, 3, always, 1.0, true);
      row("covered", venue, FaultKind::coveredLens, 2, always, 0.0, true);
      row("projector asleep", venue, FaultKind::asleepProjector, 2, always, 0.0, true);
      row("blinded", venue, FaultKind::flash, 1, always, 10.0, true);
      row("hand", venue, FaultKind::hand, 3, always, 0.0, true);
      row("hand that goes away", venue, FaultKind::hand, 2, 3, 0.0, false);
      row("another room light", venue, FaultKind::ambient, 0, always, 0.1, false);
      row("light goes on", venue, FaultKind::ambient, 3, always, 0.05, true);
    }
  }
  void neverWorse() {
    QFETCH(QString, venue);
    QFETCH(QVector<int>, fault);
    QFETCH(double, amount);
    QFETCH(bool, disturbed);
    const fs::path folder = copyOf(venue.toStdString(), QTest::currentDataTag());
    const SimulatedVenue simulated(venueNamed(venue.toStdString()), root() / "cache", quiet);
    auto faults = std::make_shared<FaultSchedule>();
    DeviceFault happens{static_cast<FaultKind>(fault[0]), "perfect", fault[1], fault[2], amount};
    happens.x0 = happens.y0 = 0.3;
    happens.x1 = happens.y1 = 0.7;
    faults->faults.push_back(happens);
    rig::Rig rig = simulated.rig(faults);
    PerfectSettings settings;
    settings.images = {picture()};
    int told = 0;
    const PerfectResult result =
        perfectPictures(folder, settings, rig, [&](std::size_t, const PerfectingRound&) { ++told; }, quiet);
    const PerfectedImage& image = result.images.front();
    QVERIFY2(image.failure.empty(), englishSentence(image.failure).c_str());
    QCOMPARE(told, static_cast<int>(image.rounds.size()));
    const std::optional<PerfectedPicture> kept = findPerfected(folder, keyOf(folder, picture()));
    QCOMPARE(kept.has_value(), image.kept);
    QCOMPARE(image.end == PerfectingEnd::disturbed, disturbed);
    if (disturbed) {
      QVERIFY(!image.kept);
      QVERIFY(!image.disturbance.empty());
      return;
    }
    const double before = trueError(simulated, folder, shownAsMeasured(folder));
    // More light is more noise, in which what is left to correct may be lost.
    if (static_cast<FaultKind>(fault[0]) == FaultKind::ambient && !image.kept) return;
    QVERIFY2(image.kept, "these measurements leave something to correct");
    const double after = trueError(simulated, folder, driveOf(*kept, Rasters(projector)));
    qInfo("true error %.5f -> %.5f", before, after);
    QVERIFY2(after < before, qPrintable(QString("%1 is not below %2").arg(after).arg(before)));
  }

  void theLastPairDecides_data() {
    QTest::addColumn<double>("spoiled");  // of the best picture's light, when it is photographed last
    QTest::addColumn<bool>("better");
    QTest::newRow("seen to be better") << 0.0 << true;
    QTest::newRow("not seen again") << 0.015 << false;
  }
  /// What the loop has seen counts for nothing if it is not seen again beside the picture that there was.
  void theLastPairDecides() {
    QFETCH(double, spoiled);
    QFETCH(bool, better);
    const MeasuredCalibration measured =
        loadCalibration(CalibrationFolder::open(root() / "corner", CalibrationFolder::Access::read), quiet);
    const MeasuredVenue& venue = measured.venue;
    const Compensator compensator(venue, measured.inverse);
    const Target target = fitTarget(readLinearContent(picture()), venue, {});
    const Compensation start = compensator.solve(Method::refined, target, quiet);
    const auto frameOf = [&](CameraStack radiance) {
      hdr::HdrFrame frame;
      frame.variance.assign(radiance.size(), 0.0f);
      frame.valid.assign(radiance.size(), 1);
      frame.radiance = std::move(radiance);
      return frame;
    };
    int blacks = 0;
    const PerfectingCamera camera{[&] {
                                    ++blacks;
                                    return hdr::BlackLevel(frameOf(venue.black));
                                  },
                                  [&](const ProjectorStack& drive) {
                                    CameraStack seen = venue.transport.apply(drive);
                                    const bool isSpoiled = blacks == 2 && drive != start.projector;
                                    for (std::size_t i = 0; i < seen.size(); ++i) {
                                      // Up and down, pixel by pixel: no change of brightness takes it for the
                                      // better.
                                      const double sign = i / 3 % 2 == 0 ? 1.0 : -1.0;
                                      if (isSpoiled) seen[i] *= static_cast<float>(1.0 + sign * spoiled);
                                      seen[i] += venue.black[i];
                                    }
                                    return frameOf(std::move(seen));
                                  }};
    const PerfectingResult result = perfected(compensator, target, start, camera, 4, {}, quiet);
    QVERIFY(result.end != PerfectingEnd::disturbed);
    QCOMPARE(blacks, 2);
    QCOMPARE(result.better, better);
    QCOMPARE(result.picture.projector == start.projector, !better);
  }

  /// A second time it goes on from there, and keeps what it has unless it finds better.
  void goesOn() {
    const fs::path folder = copyOf("corner", "goes-on");
    PerfectSettings settings;
    settings.images = {picture()};
    const PerfectResult first = perfectPictures(folder, settings, root() / "cache", {}, quiet);
    QVERIFY(!first.images.front().wentOn && first.images.front().kept);
    const PerfectResult second = perfectPictures(folder, settings, root() / "cache", {}, quiet);
    QVERIFY(second.images.front().wentOn);
    QVERIFY(second.images.front().before.error.value < first.images.front().before.error.value);
    QVERIFY(findPerfected(folder, keyOf(folder, picture())).has_value());
  }

  void leavesOutWhatItCannotRead() {
    const fs::path folder = copyOf("corner", "leaves-out");
    std::ofstream(root() / "no-picture.png") << "no picture";
    PerfectSettings settings;
    settings.images = {root() / "no-picture.png", root() / "missing.png", picture(1)};
    settings.photographs = 2;
    const PerfectResult result = perfectPictures(folder, settings, root() / "cache", {}, quiet);
    QCOMPARE(result.images.size(), 3u);
    QVERIFY(!result.images[0].failure.empty() && !result.images[1].failure.empty());
    QVERIFY(result.images[2].failure.empty() && result.images[2].rounds.size() == 2);
    QVERIFY(!isPerfect(result));
  }

  void isKeptForWhatItIs() {
    const fs::path folder = copyOf("corner", "kept");
    keep(folder, picture(0), 0.25f);
    const std::string key = keyOf(folder, picture(0));
    const std::optional<PerfectedPicture> found = findPerfected(folder, key);
    QVERIFY(found.has_value());
    QCOMPARE(found->picture, picture(0).string());
    QCOMPARE(found->figures.photographs, 7);
    QCOMPARE(found->figures.after.front().deltaE, 2.0);
    for (float value : driveOf(*found, Rasters(projector))) QCOMPARE(value, 0.25f);
    // Another picture, and another way to show this one.
    QVERIFY(!findPerfected(folder, keyOf(folder, picture(1))).has_value());
    {
      CalibrationFolder calibration = CalibrationFolder::open(folder, CalibrationFolder::Access::write);
      CalibrateSettings settings = settingsOf(calibration);
      settings.content.reachablePercentile += 5.0;
      changeSettings(calibration, settings);
    }
    QVERIFY(keyOf(folder, picture(0)) != key);
    QCOMPARE(allPerfected(folder).size(), 1u);  // out of date, and there
    // The same file elsewhere is the same picture; on a canvas of its shape too.
    const fs::path copy = root() / "the-same.png";
    fs::copy_file(picture(0), copy, fs::copy_options::overwrite_existing);
    QCOMPARE(keyOf(folder, copy), keyOf(folder, picture(0)));
    const Size size = readLinearContent(copy).size();
    const std::string bytes = readFile(copy);
    QCOMPARE(contentIdentity(bytes, size, {{2 * size.width, 2 * size.height}, Fit::fit}),
             contentIdentity(bytes, size, {}));
    QVERIFY(contentIdentity(bytes, size, {{2 * size.width, size.height}, Fit::fit}) !=
            contentIdentity(bytes, size, {}));
    QVERIFY(contentIdentity(bytes, size, {{2 * size.width, size.height}, Fit::fill}) !=
            contentIdentity(bytes, size, {{2 * size.width, size.height}, Fit::fit}));
  }

  /// What a program leaves that was killed: the earlier one, and files that nobody names.
  void survivesAKillInTheMiddle() {
    const fs::path folder = copyOf("corner", "killed");
    keep(folder, picture(), 0.25f);
    const std::string key = keyOf(folder, picture());
    std::ofstream(perfectedFolder(folder) / key / "projector-1-half.exr") << "half of it";
    for (float value : driveOf(*findPerfected(folder, key), Rasters(projector))) QCOMPARE(value, 0.25f);
    keep(folder, picture(), 0.75f);
    for (float value : driveOf(*findPerfected(folder, key), Rasters(projector))) QCOMPARE(value, 0.75f);
    const auto files = fs::directory_iterator(perfectedFolder(folder) / key);
    QCOMPARE(std::distance(fs::begin(files), fs::end(files)), 2);
  }

  void refusesDamage_data() {
    QTest::addColumn<QByteArray>("record");
    QTest::newRow("nothing") << QByteArray();
    QTest::newRow("no JSON") << QByteArray("{");
    QTest::newRow("of a newer version")
        << QByteArray(R"({"version": 2, "picture": "a", "perfected": "b", "before": [], "after": [],
                          "photographs": 7, "files": []})");
    QTest::newRow("lacks its files") << QByteArray(R"({"picture": "a", "perfected": "b"})");
    QTest::newRow("names a file elsewhere")
        << QByteArray(R"({"picture": "a", "perfected": "b", "before": [], "after": [], "photographs": 7,
                          "files": ["../../transport.exr"]})");
  }
  void refusesDamage() {
    QFETCH(QByteArray, record);
    const fs::path folder = copyOf("corner", QTest::currentDataTag());
    keep(folder, picture(), 0.25f);
    const std::string key = keyOf(folder, picture());
    std::ofstream(perfectedFolder(folder) / key / "perfected.json") << record.toStdString();
    QVERIFY_THROWS_EXCEPTION(Error, findPerfected(folder, key));
    QCOMPARE(allPerfected(folder).size(), 0u);
  }
  void refusesOtherProjectors() {
    const fs::path folder = copyOf("corner", "other-projectors");
    keep(folder, picture(), 0.25f);
    const PerfectedPicture kept = allPerfected(folder).front();
    QVERIFY_THROWS_EXCEPTION(Error, driveOf(kept, Rasters(Size{30, 40})));
    QVERIFY_THROWS_EXCEPTION(Error, driveOf(kept, Rasters({projector, projector})));
  }

  void forgets() {
    const fs::path folder = copyOf("corner", "forgets");
    for (std::size_t which : {0, 1}) keep(folder, picture(which), 0.25f);
    QCOMPARE(forgetPerfected(folder, {picture(1)}, {}).pictures,
             std::vector<std::string>{picture(1).string()});
    QVERIFY(findPerfected(folder, keyOf(folder, picture(0))).has_value());
    QVERIFY(!findPerfected(folder, keyOf(folder, picture(1))).has_value());
    QCOMPARE(forgetPerfected(folder, {}, {}).pictures.size(), 1u);
    QCOMPARE(forgetPerfected(folder, {}, {}).pictures.size(), 0u);
  }

  /// Law: tidying frees what no show finds any more, and nothing else: a picture whose file is away for now,
  /// and one of which an earlier version did not keep what it was made for, stay.
  void tidyingFreesWhatIsOutOfDate() {
    const fs::path folder = copyOf("corner", "tidied");
    const fs::path changing = root() / "changing.png", away = root() / "away.png";
    const auto grey = [](const fs::path& file, float level) {
      writePng(file, relucent::image::Image({32, 24}, 3, level), 8);
    };
    grey(away, 0.25f);
    grey(changing, 0.5f);
    for (const fs::path& image : {picture(0), picture(1), changing, away}) keep(folder, image, 0.25f);
    const std::string inDate = keyOf(folder, picture(0)), ofAway = keyOf(folder, away);
    const std::string former =
        readFile(perfectedFolder(folder) / keyOf(folder, picture(1)) / "perfected.json");
    calibration::Json record = calibration::Json::parse(former);
    record.erase("shown_from");
    record.erase("canvas");
    std::ofstream(perfectedFolder(folder) / keyOf(folder, picture(1)) / "perfected.json") << record.dump();
    grey(changing, 0.75f);
    fs::remove(away);
    const auto tidied = [&](bool dryRun) { return tidy({folder}, {{}, dryRun}, quiet).calibrations.front(); };
    for (const bool dryRun : {true, false}) {
      QCOMPARE(tidied(dryRun).perfected.files, 2);  // of the picture that is another one now
      QCOMPARE(allPerfected(folder).size(), dryRun ? 4u : 3u);
    }
    QVERIFY(findPerfected(folder, inDate) && findPerfected(folder, ofAway));
    {
      CalibrationFolder calibration = CalibrationFolder::open(folder, CalibrationFolder::Access::write);
      CalibrateSettings settings = settingsOf(calibration);
      settings.content.reachablePercentile += 5.0;
      changeSettings(calibration, settings);
    }
    QVERIFY(tidied(false).perfected.bytes > 0);
    QCOMPARE(allPerfected(folder).size(), 1u);
  }

  void aCanvasHasBounds_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::addColumn<bool>("possible");
    QTest::newRow("the content's own") << 0 << 0 << true;
    QTest::newRow("least") << 8 << 8 << true;
    QTest::newRow("most") << 8192 << 8192 << true;
    QTest::newRow("too wide") << 8193 << 100 << false;
    QTest::newRow("too high") << 100 << 1000000 << false;
    QTest::newRow("too low") << 100 << 7 << false;
    QTest::newRow("no height") << 100 << 0 << false;
    QTest::newRow("negative") << -100 << 100 << false;
  }
  void aCanvasHasBounds() {
    QFETCH(int, width);
    QFETCH(int, height);
    QFETCH(bool, possible);
    PerfectSettings settings;
    settings.images = {picture()};
    settings.canvas.size = {width, height};
    const std::vector<Message> found = problems(settings);
    QCOMPARE(found.empty(), possible);
    if (!possible) QVERIFY(mentions(english(found.front()), "each side is 8 to 8192"));
  }

  void findsStills() {
    const fs::path folder = root() / "stills";
    fs::create_directory(folder);
    for (const char* name : {"b.PNG", "a.jpg", "film.mp4", "notes.txt"}) std::ofstream(folder / name) << "x";
    QCOMPARE(stillsOf(folder), (std::vector<fs::path>{folder / "a.jpg", folder / "b.PNG"}));
    std::ofstream(folder / "list.playlist")
        << R"({"version": 1, "items": [{"path": "b.PNG"}, {"path": "film.mp4"}, {"path": "../a.jpg"},
               {"path": "screen:HDMI-1"}, {"path": "stream:http://camera/picture.jpg"}]})";
    QCOMPARE(stillsOf(folder / "list.playlist"), (std::vector<fs::path>{folder / "b.PNG", root() / "a.jpg"}));
    QCOMPARE(stillsOf(folder / "film.mp4"),
             std::vector<fs::path>{folder / "film.mp4"});  // told when it is read
    std::ofstream(folder / "broken.playlist") << "{";
    QVERIFY_THROWS_EXCEPTION(Error, stillsOf(folder / "broken.playlist"));
    fs::create_directory(folder / "empty");
    QVERIFY_THROWS_EXCEPTION(Error, stillsOf(folder / "empty"));
  }

  void putsOnACanvas_data() {
    QTest::addColumn<int>("fit");
    QTest::addColumn<float>("corner");
    QTest::addColumn<float>("middle");
    QTest::newRow("fit") << static_cast<int>(Fit::fit) << 0.0f << 1.0f;
    QTest::newRow("fill") << static_cast<int>(Fit::fill) << 1.0f << 1.0f;
    QTest::newRow("cover") << static_cast<int>(Fit::cover) << 1.0f << 1.0f;
  }
  void putsOnACanvas() {
    QFETCH(int, fit);
    QFETCH(float, corner);
    QFETCH(float, middle);
    const Image canvas = onCanvas(Image({12, 12}, 3, 1.0f), {{32, 9}, static_cast<Fit>(fit)});
    QVERIFY((canvas.size() == Size{32, 9}));
    QCOMPARE(canvas.at(0, 0, 0), corner);
    QCOMPARE(canvas.at(16, 4, 1), middle);
    QVERIFY((onCanvas(Image({12, 12}, 3, 1.0f), {}).size() == Size{12, 12}));
  }
};

QTEST_GUILESS_MAIN(TestPerfect)
#include "test_perfect.moc"
