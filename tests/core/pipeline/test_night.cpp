// SPDX-License-Identifier: MIT
// What a venue does by itself between two shows, and what is told of it.
#include "relucent/pipeline/night.h"

#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/pipeline/night_venue.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/image/exr.h"
#include "relucent/pipeline/perfected.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/stills.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/venue/device_faults.h"
#include "support/sanitized.h"

using namespace relucent;
using namespace relucent::pipeline;
using namespace relucent::test;
using namespace relucent::venue;
namespace fs = std::filesystem;

namespace {

Progress quiet;

NightRecord nightNumber(int number) {
  NightRecord night;
  night.when = fmt::format("2026-01-{:02}T03:00:00Z", number);
  night.repair = RepairEnd::repaired;
  night.what = {Message::plain("somebody painted the wall")};
  night.perfected = number;
  night.measured = PictureError{30.5, 1.25};
  night.predicted = PictureError{31.0, 1.0};
  night.alarm = number % 2 == 0 ? Message::plain("the lamp is off") : Message();
  night.seconds = 12.5;
  return night;
}

bool areSame(const NightRecord& a, const NightRecord& b) {
  return a.when == b.when && a.repair == b.repair && a.what.size() == b.what.size() &&
         a.perfected == b.perfected && a.measured->deltaE == b.measured->deltaE &&
         a.predicted->psnr == b.predicted->psnr && english(a.alarm) == english(b.alarm) &&
         a.seconds == b.seconds;
}

}  // namespace

class TestNight : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path cache() const { return root() / "cache"; }
  fs::path picture() const { return root() / "picture.png"; }

  fs::path copy(const char* name) {
    const fs::path folder = root() / name;
    fs::copy(root() / "measured", folder, fs::copy_options::recursive);
    return folder;
  }
  static std::string correctionOf(const fs::path& folder) {
    return fingerprintOfCorrection(
        calibration::CalibrationFolder::open(folder, calibration::CalibrationFolder::Access::read));
  }
  NightSettings settingsFor(const Changes& changes = {}) { return nightSettings(picture(), changes); }

 private slots:
  void initTestCase() {
    measureNightVenue(root() / "measured", cache());
    writeNightPicture(picture());
  }

  /// The colour error of the same picture at the same place where the venue is measured anew as it is by now.
  double measuredAnew(const fs::path& tended, const Changes& changes) {
    const fs::path anew = root() / "anew";
    fs::remove_all(anew);
    CalibrateSettings settings = settingsOf(
        calibration::CalibrationFolder::open(tended, calibration::CalibrationFolder::Access::read));
    settings.rig = nightVenue(changes);
    calibrate(anew, settings, cache(), quiet);
    return tendCalibration(anew, settingsFor(changes), cache(), quiet).measured->deltaE;
  }

  /// Law: quality is that of a new measurement, whatever happened by day, and each night has its line. A
  /// night after which nothing has changed has nothing to do.
  void weeksOfNights() {
    const fs::path folder = copy("weeks");
    Changes changes;
    const auto night = [&] { return tendCalibration(folder, settingsFor(changes), cache(), quiet); };
    NightRecord first = night();
    QVERIFY(!isAlarm(first) && first.repair == RepairEnd::nothingToDo);
    QVERIFY(isPerfected(folder, picture(), settingsFor().canvas) == (first.perfected == 1));
    const auto day = [&](const std::function<void()>& happens, RepairEnd expected) {
      happens();
      const NightRecord after = night();
      // Qualities are compared without sanitizers.
      const double anew =
          isSanitized ? std::numeric_limits<double>::infinity() : measuredAnew(folder, changes);
      const QString figures = QString("ΔE %1, measured anew %2").arg(after.measured->deltaE).arg(anew);
      qInfo().noquote() << figures;
      QVERIFY2(!isAlarm(after), english(after.alarm).c_str());
      QVERIFY2(after.repair == expected, figures.toUtf8());
      QVERIFY2(after.measured->deltaE < 1.1 * anew, figures.toUtf8());
    };
    day([&] { changes.painted.push_back({{0.4, 0.5}, 0.15}); }, RepairEnd::repaired);
    day([] {}, RepairEnd::nothingToDo);
    day([&] { changes.lamps = {0.9, 0.9, 0.8}; }, RepairEnd::repaired);
    day([&] { changes.cameras.push_back({0, 0.8, 0.5, 0.0}); }, RepairEnd::repaired);
    const std::vector<NightRecord> nights = nightsOf(folder);
    QCOMPARE(nights.size(), 5);
    QVERIFY(nights[1].when <= nights[2].when && !nights[1].what.empty() && nights[2].what.empty());
  }

  void whatGoesWrongIsAnAlarm_data() {
    QTest::addColumn<int>("fault");
    QTest::addColumn<QString>("stage");
    QTest::addColumn<bool>("repaired");
    const auto row = [](const char* name, FaultKind fault, const char* stage, bool repaired) {
      QTest::newRow(name) << static_cast<int>(fault) << stage << repaired;
    };
    row("covered", FaultKind::coveredLens, "repair", false);
    row("unplugged", FaultKind::unplugged, "repair", false);
    row("unplugged before the proof of a repair", FaultKind::unplugged, "repair-proof", false);
    row("unplugged while a picture is perfected", FaultKind::unplugged, "perfect", true);
    row("covered at the proof", FaultKind::coveredLens, "prove", true);
  }
  /// Law: a night that cannot do its work says so in its line, and leaves what was finished.
  void whatGoesWrongIsAnAlarm() {
    QFETCH(int, fault);
    QFETCH(QString, stage);
    QFETCH(bool, repaired);
    const fs::path folder = copy(QTest::currentDataTag());
    const std::string correction = correctionOf(folder);
    Changes changes;
    changes.painted.push_back({{0.4, 0.5}, 0.15});
    SimulatedVenue venue(nightVenue(changes), cache(), quiet);
    const auto schedule = std::make_shared<FaultSchedule>();
    schedule->faults.push_back({static_cast<FaultKind>(fault), stage.toStdString(), 0, 100000});
    rig::Rig rig = venue.rig(schedule);
    const NightRecord night = tendCalibration(folder, settingsFor(), rig, quiet);
    QVERIFY(isAlarm(night) && !english(night.alarm).empty());
    QCOMPARE(night.repair.has_value(), repaired);
    QCOMPARE(correctionOf(folder) != correction, repaired);
    QCOMPARE(nightsOf(folder).size(), 1);
    QCOMPARE(english(nightsOf(folder).front().alarm), english(night.alarm));
  }

  void aMissingPictureIsAnAlarm() {
    const fs::path folder = copy("missing");
    NightSettings settings = settingsFor();
    settings.images.push_back(root() / "gone.png");
    const NightRecord night = tendCalibration(folder, settings, cache(), quiet);
    QVERIFY(isAlarm(night));
    QVERIFY(night.measured && night.repair == RepairEnd::nothingToDo);
  }

  /// A playlist whose first picture is gone: the others are repaired, perfected and proved by.
  void aMissingFirstPictureStopsNothing() {
    const fs::path folder = copy("first missing");
    std::ofstream(root() / "show.playlist")
        << R"({"items": [{"path": "gone.png"}, {"path": "film.mp4"}, {"path": "picture.png"}]})";
    NightSettings settings = settingsFor(paintedWall());
    settings.images = stillsOf(root() / "show.playlist");
    const NightRecord night = tendCalibration(folder, settings, cache(), quiet);
    QVERIFY(night.repair == RepairEnd::repaired);
    QVERIFY(night.measured.has_value());
    QVERIFY2(english(night.alarm).find("gone.png") != std::string::npos, english(night.alarm).c_str());
  }

  void withoutItsDevicesItIsAnAlarm() {
    const fs::path folder = copy("no devices");
    NightSettings settings = settingsFor();
    settings.rig = ReplayRigSettings{root() / "no recording"};
    const NightRecord night = tendCalibration(folder, settings, cache(), quiet);
    QVERIFY(isAlarm(night) && !night.repair);
  }

  /// What is proved is what the show has: the perfected picture where there is one. One that is all black
  /// tells it from what T would have shown.
  void whatTheShowHasIsProved() {
    const fs::path folder = copy("shown");
    NightSettings settings = settingsFor();
    const NightRecord plain = tendCalibration(folder, settings, cache(), quiet);
    const auto calibration =
        calibration::CalibrationFolder::open(folder, calibration::CalibrationFolder::Access::read);
    const Size size = image::readLinearContent(picture()).size();
    PerfectedPicture black;
    black.key = perfectedKey(fingerprintOfShown(calibration),
                             compensation::contentIdentity(readFile(picture()), size, settings.canvas));
    black.folder = folder;
    black.picture = picture().string();
    black.perfected = "2026-01-01T00:00:00Z";
    const Rasters projectors(nightVenue().projector);
    savePerfected(black, ProjectorStack(3 * projectors.count()), projectors);
    const NightRecord night = tendCalibration(folder, settings, cache(), quiet);
    QVERIFY(night.ofPerfected);
    QVERIFY2(night.measured->deltaE > 5.0 * plain.measured->deltaE,
             qPrintable(QString("ΔE %1, %2 before").arg(night.measured->deltaE).arg(plain.measured->deltaE)));
    QVERIFY(nightsOf(folder).back().ofPerfected);
  }

  void anAlarmIsToldOnce() {
    const fs::path folder = root() / "told", calls = root() / "calls";
    fs::create_directories(folder);
    const std::string command = "echo {sentence} >>" + calls.string();
    const auto close = [&](const Message& alarm, const std::string& by, const Message& skipped = {}) {
      NightRecord night = nightNumber(1);
      night.alarm = alarm;
      night.skipped = skipped;
      closeNight(folder, night, by);
      return night;
    };
    const auto error = [](double deltaE) {
      return RELUCENT_MESSAGE("test.colour-error", "the colour error is {} of '{}'").with(deltaE, "a;b 'c'");
    };
    QVERIFY(!close(error(5.0), {}).told);  // nobody to be told by
    QVERIFY(!close(error(5.0), "echo nobody is there; false").told);
    QVERIFY(english(nightsOf(folder).back().untold).find("nobody is there") != std::string::npos);
    QVERIFY(close(error(5.25), command).told);
    QVERIFY(close(error(6.0), command).told);                    // the same, by another figure
    close({}, command, Message::plain("the show did not run"));  // no night
    QVERIFY(close(error(7.0), command).told);
    QCOMPARE(readFile(calls), std::string("the colour error is 5.25 of 'a;b 'c''.\n"));
    QVERIFY(close(Message::plain("the lamp is off"), command).told);  // another one
    close({}, command);                                               // all is well
    QVERIFY(close(Message::plain("the lamp is off"), command).told);
    const std::string all = readFile(calls);
    QCOMPARE(std::count(all.begin(), all.end(), '\n'), 3);
  }

  void sentencesAreComparedByWhatTheySay_data() {
    QTest::addColumn<bool>("same");
    QTest::addColumn<int>("a");
    QTest::addColumn<int>("b");
    QTest::newRow("itself") << true << 0 << 0;
    QTest::newRow("other figure") << true << 0 << 1;
    QTest::newRow("other camera") << false << 0 << 2;
    QTest::newRow("other file") << false << 3 << 4;
    QTest::newRow("within another sentence") << true << 5 << 6;
    QTest::newRow("another within it") << false << 5 << 7;
    QTest::newRow("words") << false << 8 << 0;
  }
  void sentencesAreComparedByWhatTheySay() {
    QFETCH(bool, same);
    QFETCH(int, a);
    QFETCH(int, b);
    const auto dark = [](double share, int camera) {
      return RELUCENT_MESSAGE("test.dark", "{} % of camera {} is dark")
          .with(as::share(share), as::label(camera));
    };
    const auto gone = [](const char* file) {
      return RELUCENT_MESSAGE("test.gone", "{} is gone").with(as::file(file));
    };
    const auto within = [](const Message& why) {
      return RELUCENT_MESSAGE("test.because", "stopped: {}").with(why);
    };
    const std::vector<Message> sentences{dark(0.1, 1),         dark(0.2, 1),          dark(0.1, 2),
                                         gone("a.png"),        gone("b.png"),         within(dark(0.1, 1)),
                                         within(dark(0.3, 1)), within(gone("a.png")), Message::plain("10 %")};
    QCOMPARE(saysTheSame(sentences[static_cast<std::size_t>(a)], sentences[static_cast<std::size_t>(b)]),
             same);
  }

  void whatCannotBeTendedIsNoNight() {
    QVERIFY_THROWS_EXCEPTION(Error, tendCalibration(root() / "nowhere", settingsFor(), cache(), quiet));
    NightSettings settings = settingsFor();
    settings.photographs = 1;
    const fs::path folder = copy("refused");
    QVERIFY_THROWS_EXCEPTION(Error, tendCalibration(folder, settings, cache(), quiet));
    QVERIFY(nightsOf(folder).empty());
  }

  void historyIsKept() {
    const fs::path folder = root() / "history";
    fs::create_directories(folder);
    for (int number = 1; number <= 9; ++number) addNight(folder, nightNumber(number));
    const std::vector<NightRecord> nights = nightsOf(folder);
    QCOMPARE(nights.size(), 9);
    for (int number = 1; number <= 9; ++number)
      QVERIFY(areSame(nights[static_cast<std::size_t>(number - 1)], nightNumber(number)));
    NightRecord bare;
    bare.when = "2026-02-01T03:00:00Z";
    addNight(folder, bare);
    QVERIFY(!nightsOf(folder).back().repair && !nightsOf(folder).back().measured);
  }
  /// Where nothing can be reached there is no PSNR: nights and proofs are read again all the same.
  void aPictureOutOfReachIsKept() {
    const fs::path folder = root() / "unreachable";
    fs::create_directories(folder);
    const PictureError none{std::numeric_limits<double>::quiet_NaN(), 40.0};
    NightRecord night = nightNumber(1);
    night.measured = none;
    addNight(folder, night);
    QVERIFY(std::isnan(nightsOf(folder).front().measured->psnr));
    QCOMPARE(nightsOf(folder).front().measured->deltaE, 40.0);
    ProofRecord proof;
    proof.figures.after.measured = none;
    saveProofRecord(proof, folder);
    QVERIFY(std::isnan(loadProofRecord(folder)->figures.after.measured.psnr));
  }
  void historyDoesNotGrowForEver() {
    const fs::path folder = root() / "long";
    fs::create_directories(folder);
    addNight(folder, nightNumber(1));
    const std::string line = readFile(folder / nightsName);
    std::string text;
    for (std::size_t night = 0; night < mostNights; ++night) text += line;
    std::ofstream(folder / nightsName) << text;
    addNight(folder, nightNumber(2));
    const std::vector<NightRecord> nights = nightsOf(folder);
    QCOMPARE(nights.size(), mostNights);
    QVERIFY(areSame(nights.back(), nightNumber(2)));
  }
  void aDamagedHistoryIsSetAside_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("no JSON") << QByteArray("{\n");
    QTest::newRow("of another kind") << QByteArray("[1, 2]\n");
    QTest::newRow("lacks") << QByteArray("{\"when\": \"2026\"}\n");
    QTest::newRow("unknown name") << QByteArray(
        "{\"when\":\"\",\"what\":[],\"perfected\":0,\"seconds\":0,\"repair\":\"eaten\"}\n");
  }
  void aDamagedHistoryIsSetAside() {
    QFETCH(QByteArray, text);
    const fs::path folder = root() / "damaged" / QTest::currentDataTag();
    fs::create_directories(folder);
    std::ofstream(folder / nightsName) << text.toStdString();
    QVERIFY_THROWS_EXCEPTION(Error, nightsOf(folder));
    addNight(folder, nightNumber(3));
    QCOMPARE(nightsOf(folder).size(), 1);
    QCOMPARE(readFile(folder / (std::string(nightsName) + ".unreadable")), text.toStdString());
  }
};

QTEST_GUILESS_MAIN(TestNight)
#include "test_night.moc"
