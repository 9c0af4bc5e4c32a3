// SPDX-License-Identifier: MIT
// What stays on the disk of a calibration, while it is measured and afterwards.
#include "relucent/pipeline/kept_photographs.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <map>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/random.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/shot_file.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/acquisition_record.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/storage.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/tidy.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::pipeline;
namespace fs = std::filesystem;

namespace {

using Access = CalibrationFolder::Access;

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

/// Every file by its name within the folder, but when each thing happened.
std::map<std::string, std::string> contentOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != acquisitionRecordName)
      files[fs::relative(entry.path(), folder).string()] = readFile(entry.path());
  return files;
}

std::map<std::string, std::string> shotsOf(const fs::path& calibration) {
  std::map<std::string, std::string> shots = contentOf(calibration / "shots");
  std::erase_if(shots, [](const auto& file) { return !file.first.ends_with(".shot"); });
  return shots;
}

std::uint64_t bytesOf(const std::map<std::string, std::string>& files) {
  std::uint64_t bytes = 0;
  for (const auto& [name, content] : files) bytes += content.size();
  return bytes;
}

/// The file as programs before compression wrote it.
std::string plainFileOf(const rig::Shot& shot) {
  Json frames = Json::array();
  std::string samples;
  for (const auto& exposure : shot.frames) {
    Json cameras = Json::array();
    for (const rig::RawFrame& frame : exposure) {
      cameras.push_back({{"width", frame.signal.width()},
                         {"height", frame.signal.height()},
                         {"channels", frame.signal.channels()},
                         {"bits", frame.bits},
                         {"seconds", frame.seconds},
                         {"samples", "float"}});
      const std::vector<float>& signal = frame.signal.data();
      samples.append(reinterpret_cast<const char*>(signal.data()), signal.size() * sizeof(float));
    }
    frames.push_back(std::move(cameras));
  }
  Json header = {{"format", "relucent shot"},       {"version", 1},
                 {"stage", shot.id.stage},          {"number", shot.id.number},
                 {"fingerprint", shot.fingerprint}, {"exposures_asked", shot.exposuresAsked},
                 {"frames", std::move(frames)}};
  header["checksum"] = Fingerprint().add(header.dump()).add(std::string_view(samples)).hex();
  return header.dump() + "\n" + samples;
}

void makePlain(const fs::path& calibration) {
  for (const auto& [name, content] : shotsOf(calibration))
    std::ofstream(calibration / "shots" / name, std::ios::binary) << plainFileOf(shotFrom(content).value());
}

/// Stops and keeps when a level has begun.
struct StopAtALevel : ProgressSink {
  explicit StopAtALevel(StopRequest& asked) : stop(asked) {}
  void progressed(double, const Message& stage) override {
    if (english(stage).starts_with("patterns in blocks of 4")) stop.ask(StopRequest::Kind::keep);
  }
  StopRequest& stop;
};

/// A disk that is full now and then, by the count of looks at it.
class FullNowAndThen : public RoomWaiter {
 public:
  explicit FullNowAndThen(std::uint64_t seed) : random_{seed} {}
  std::uint64_t freeBytes(const fs::path&) const override { return random_.below(10) == 0 ? 0 : 1ULL << 40; }
  Answer wait(const FullDisk&) override { return Answer::look; }
  void over() override { ++pauses; }
  int pauses = 0;

 private:
  mutable Random random_;
};

}  // namespace

class TestKeptPhotographs : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path path(const char* name) const { return fs::path(folder_.path().toStdString()) / name; }

  /// A copy of a calibration that was measured once.
  fs::path copyOfMeasured(const char* name) {
    Progress quiet;
    if (!fs::exists(path("measured"))) calibrate(path("measured"), tiny(), path("cache"), quiet);
    fs::remove_all(path(name));
    fs::copy(path("measured"), path(name), fs::copy_options::recursive);
    return path(name);
  }

  /// One that was stopped and kept.
  fs::path stopped(const char* name) {
    StopRequest stop;
    StopAtALevel sink(stop);
    Progress progress(sink, stop);
    calibrate(path(name), tiny(), path("cache"), progress);
    return path(name);
  }

 private slots:
  void choicesAreKeptWithTheCalibration_data() {
    QTest::addColumn<int>("kept");
    QTest::addColumn<bool>("shotsStay");
    QTest::addColumn<bool>("asideStays");
    QTest::newRow("everything") << static_cast<int>(KeptPhotographs::everything) << true << true;
    QTest::newRow("latest") << static_cast<int>(KeptPhotographs::latest) << true << false;
    QTest::newRow("results") << static_cast<int>(KeptPhotographs::results) << false << false;
  }
  /// Law: what is removed is what the choice says, and every result is as it was.
  void choicesAreKeptWithTheCalibration() {
    QFETCH(int, kept);
    QFETCH(bool, shotsStay);
    QFETCH(bool, asideStays);
    const fs::path calibration = copyOfMeasured("chosen");
    Progress quiet;
    {
      CalibrationFolder folder = CalibrationFolder::open(calibration, Access::write);
      QCOMPARE(keptPhotographs(folder), KeptPhotographs::everything);
      keepPhotographs(folder, static_cast<KeptPhotographs>(kept));
      QCOMPARE(keptPhotographs(folder), static_cast<KeptPhotographs>(kept));
      QCOMPARE(progressOf(folder, Stage::inverse), StageProgress::done);  // no fingerprint knows the choice
      fs::create_directories(folder.shotFolder() / "earlier-1");
      fs::copy(folder.shotFolder() / shotsOf(calibration).begin()->first, folder.shotFolder() / "earlier-1");
      std::ofstream(folder.shotFolder() / "notes.txt") << "mine";
    }
    const auto results = contentOf(calibration / "results");
    const std::size_t shots = shotsOf(calibration).size();
    const CalibrateResult before = resume(path("measured"), path("cache"), quiet);
    const CalibrateResult after = resume(calibration, path("cache"), quiet);
    QCOMPARE(after.leaves, before.leaves);
    QCOMPARE(after.exposures, before.exposures);
    QCOMPARE(shotsOf(calibration).size(), shotsStay ? shots - (asideStays ? 0 : 1) : 0);
    QCOMPARE(fs::exists(calibration / "shots/earlier-1"), asideStays);
    QVERIFY(fs::exists(calibration / "shots/notes.txt"));
    QVERIFY(contentOf(calibration / "results") == results);
    const CalibrationFolder folder = CalibrationFolder::open(calibration, Access::read);
    QCOMPARE(werePhotographsRemoved(folder), !shotsStay);
  }

  void aNewCalibrationKeepsWhatItIsToldTo() {
    Progress quiet;
    const CalibrateResult result =
        calibrate(path("new"), tiny(), Storage{KeptPhotographs::results, nullptr}, path("cache"), {}, quiet);
    QVERIFY(result.patterns > 0);
    QVERIFY(shotsOf(path("new")).empty());
    copyOfMeasured("same");
    QVERIFY(contentOf(path("new") / "results") == contentOf(path("same") / "results"));
  }

  /// Without its photographs a calibration whose settings change is photographed again, to the same bits.
  void otherSettingsPhotographEverythingAgain() {
    Progress quiet;
    const auto measureFiner = [&](const fs::path& calibration, KeptPhotographs kept) {
      CalibrationFolder folder = CalibrationFolder::open(calibration, Access::write);
      removePhotographs(folder, kept);
      CalibrateSettings settings = settingsOf(folder);
      settings.acquisition.relativeThreshold /= 2.0;
      changeSettings(folder, settings);
      QVERIFY(removablePhotographs(folder, KeptPhotographs::results).empty());  // it is to be measured
      OpenedRig devices = openRig(settings.rig, path("cache"), quiet);
      sentinels::AcquisitionObserver nobody;
      goOnMeasuring(folder, devices.rig, measureLinearization(folder, devices.rig, quiet), {}, nobody, {},
                    quiet);
      QVERIFY(!werePhotographsRemoved(folder));
    };
    measureFiner(copyOfMeasured("with"), KeptPhotographs::everything);
    measureFiner(copyOfMeasured("without"), KeptPhotographs::results);
    QVERIFY(contentOf(path("with") / "results") == contentOf(path("without") / "results"));
  }

  void whatWasStoppedKeepsItsPhotographs() {
    const fs::path calibration = stopped("stopped");
    const auto shots = shotsOf(calibration);
    CalibrationFolder folder = CalibrationFolder::open(calibration, Access::write);
    QVERIFY(resultFrom<Stage::acquisition>(*folder.latest(Stage::acquisition)).stoppedAt > 0);
    QVERIFY(!isComplete(folder));
    QCOMPARE(removePhotographs(folder, KeptPhotographs::results).files, 0);
    QVERIFY(shotsOf(calibration) == shots);
  }

  void anUnknownChoiceIsAnError() {
    CalibrationFolder folder = CalibrationFolder::open(copyOfMeasured("unknown"), Access::write);
    Json settings = folder.settings();
    settings["kept_photographs"] = "merged";
    folder.setSettings(settings);
    QVERIFY(mentions(sentenceOf([&] { (void)keptPhotographs(folder); }, ErrorKind::format), "merged"));
  }

  /// Law: a disk that is full now and then changes nothing but the time it takes.
  void aFullDiskEndsInTheSameBits_data() {
    QTest::addColumn<quint64>("seed");
    for (quint64 seed : {1, 2}) QTest::addRow("seed %d", static_cast<int>(seed)) << seed;
  }
  void aFullDiskEndsInTheSameBits() {
    QFETCH(quint64, seed);
    copyOfMeasured("undisturbed");
    FullNowAndThen disk(seed);
    Progress quiet;
    fs::remove_all(path("full"));
    calibrate(path("full"), tiny(), Storage{KeptPhotographs::everything, &disk}, path("cache"), {}, quiet);
    QVERIFY(disk.pauses > 3);
    QVERIFY(contentOf(path("full") / "results") == contentOf(path("undisturbed") / "results"));
    QVERIFY(shotsOf(path("full")) == shotsOf(path("undisturbed")));
  }

  /// Law: compressed photographs are the same bits, in fewer bytes, and tidying again does nothing.
  void oldPhotographsAreCompressed() {
    const fs::path calibration = copyOfMeasured("plain");
    const auto compressed = shotsOf(calibration);
    makePlain(calibration);
    const auto plain = shotsOf(calibration);
    std::string damaged = plain.begin()->second;
    damaged.back() = static_cast<char>(damaged.back() ^ 1);
    std::ofstream(calibration / "shots/acquisition-999999-00000000.shot", std::ios::binary) << damaged;

    Progress quiet;
    const TidyResult foretold = tidy({calibration}, {{}, true}, quiet);
    QVERIFY(bytesOf(shotsOf(calibration)) == bytesOf(plain) + damaged.size());
    const TidyResult done = tidy({calibration}, {}, quiet);
    auto tidied = shotsOf(calibration);
    QVERIFY(tidied.extract("acquisition-999999-00000000.shot").mapped() == damaged);
    QVERIFY(tidied == compressed);
    for (const TidyResult* result : {&foretold, &done}) {
      const TidiedCalibration& figures = result->calibrations.front();
      QCOMPARE(figures.compressed.files, static_cast<int>(plain.size()));
      QCOMPARE(figures.compressed.bytes, bytesOf(plain) - bytesOf(compressed));
      QCOMPARE(figures.kept.bytes, bytesOf(compressed) + damaged.size());
      QCOMPARE(figures.freed(), figures.compressed.bytes);
    }
    QCOMPARE(tidy({calibration}, {}, quiet).calibrations.front().freed(), std::uint64_t{0});
  }

  void photographsGoAsAskedFor() {
    const fs::path calibration = copyOfMeasured("tidied");
    const std::uint64_t bytes = bytesOf(shotsOf(calibration));
    Progress quiet;
    for (bool dryRun : {true, false}) {
      const TidyResult result =
          tidy({calibration, calibration / "."}, {KeptPhotographs::results, dryRun}, quiet);
      QCOMPARE(result.calibrations.size(), std::size_t{1});  // named twice
      QVERIFY(result.calibrations.front().isComplete);
      QCOMPARE(result.calibrations.front().photographs.bytes, bytes);
      QCOMPARE(result.calibrations.front().kept.files, 0);
      QCOMPARE(bytesOf(shotsOf(calibration)), dryRun ? bytes : 0);
    }
    // It was asked for once: what is photographed next is kept as before.
    QCOMPARE(keptPhotographs(CalibrationFolder::open(calibration, Access::read)),
             KeptPhotographs::everything);
  }

  /// What nothing reads goes, and nothing else: the result of a measurement that has gone on, and what
  /// interrupted writes left. Results of other settings stay.
  void whatNothingReadsGoes() {
    const fs::path calibration = stopped("gone on");
    Progress quiet;
    {
      CalibrationFolder folder = CalibrationFolder::open(calibration, Access::write);
      CalibrateSettings settings = settingsOf(folder);
      OpenedRig devices = openRig(settings.rig, path("cache"), quiet);
      const auto linearization = measureLinearization(folder, devices.rig, quiet);
      sentinels::AcquisitionObserver nobody;
      goOnMeasuring(folder, devices.rig, linearization, {}, nobody, {}, quiet);
      settings.acquisition.relativeThreshold = 0.1;
      changeSettings(folder, settings);
      goOnMeasuring(folder, devices.rig, linearization, {}, nobody, {}, quiet);
    }
    const auto before = contentOf(calibration / "results");
    fs::create_directories(calibration / "results/.acquisition-9.part");
    std::ofstream(calibration / "results/.acquisition-9.part/half") << "half";
    fs::create_directories(calibration / "results/acquisition-8");
    std::ofstream(calibration / "results/acquisition-8/unnamed") << "unnamed";
    fs::create_directories(calibration / "results/mine");
    std::ofstream(calibration / "results/mine/notes") << "mine";
    std::ofstream(calibration / "shots/.acquisition-000001-01234567.part99.shot") << "half";
    std::ofstream(calibration / ".calibration.part99.relucent") << "{";

    TidyResult results[2];
    for (bool dryRun : {true, false}) {
      results[dryRun] = tidy({calibration}, {{}, dryRun}, quiet);
      const TidiedCalibration& tidied = results[dryRun].calibrations.front();
      QCOMPARE(tidied.leftovers.files, 4);
      QCOMPARE(tidied.leftovers.bytes, std::uint64_t{4 + 7 + 4 + 1});
      QVERIFY(tidied.results.bytes > 0);
      QCOMPARE(tidied.photographs.files, 0);
      QVERIFY(fs::exists(calibration / "results/acquisition-1") == dryRun);
    }
    QCOMPARE(results[0].calibrations.front().results.bytes, results[1].calibrations.front().results.bytes);
    auto expected = before;
    std::erase_if(expected, [](const auto& file) { return file.first.starts_with("acquisition-1/"); });
    expected["mine/notes"] = "mine";
    QVERIFY(contentOf(calibration / "results") == expected);
    // A third result takes the place of the one that was removed, and stays.
    {
      CalibrationFolder folder = CalibrationFolder::open(calibration, Access::write);
      CalibrateSettings settings = settingsOf(folder);
      settings.acquisition.relativeThreshold = 0.2;
      changeSettings(folder, settings);
      OpenedRig devices = openRig(settings.rig, path("cache"), quiet);
      sentinels::AcquisitionObserver nobody;
      goOnMeasuring(folder, devices.rig, measureLinearization(folder, devices.rig, quiet), {}, nobody, {},
                    quiet);
      QCOMPARE(currentResultOf(folder, Stage::acquisition)->folder.filename(), fs::path("acquisition-1"));
    }
    tidy({calibration}, {}, quiet);
    {
      const CalibrationFolder folder = CalibrationFolder::open(calibration, Access::read);
      loadAcquisition(*currentResultOf(folder, Stage::acquisition));
    }
    // Either setting of before finds its result.
    CalibrationFolder folder = CalibrationFolder::open(calibration, Access::write);
    CalibrateSettings coarser = tiny();
    coarser.acquisition.relativeThreshold = 0.1;
    changeSettings(folder, coarser);
    loadAcquisition(*currentResultOf(folder, Stage::acquisition));
    changeSettings(folder, tiny());
    loadAcquisition(*currentResultOf(folder, Stage::acquisition));
  }

  void anUnfinishedCalibrationKeepsItsPhotographs() {
    const fs::path calibration = stopped("unfinished");
    const auto shots = shotsOf(calibration);
    Progress quiet;
    const TidyResult result = tidy({calibration}, {KeptPhotographs::results, false}, quiet);
    QVERIFY(!result.calibrations.front().isComplete);
    QVERIFY(shotsOf(calibration) == shots);
  }

  void aCalibrationInUseIsLeftAlone() {
    const fs::path first = copyOfMeasured("first"), used = copyOfMeasured("used");
    const auto shots = shotsOf(first);
    const CalibrationFolder folder = CalibrationFolder::open(used, Access::write);
    Progress quiet;
    const TidySettings settings{KeptPhotographs::results, false};
    QVERIFY(mentions(sentenceOf([&] { tidy({first, used}, settings, quiet); }, ErrorKind::input),
                     "another program"));
    QVERIFY(shotsOf(first) == shots);
  }

  void tidyingCanBeCancelled() {
    const fs::path calibration = copyOfMeasured("cancelled");
    makePlain(calibration);
    const auto plain = shotsOf(calibration);
    QVERIFY_EXCEPTION_THROWN(tidy({calibration}, {}, Stopped()), Cancelled);
    QVERIFY(shotsOf(calibration) == plain);
  }

  /// Law: killed at any instant of tidying, every photograph is there in one form or the other, and the next
  /// time ends as if nothing had happened.
  void killedAtAnyInstant() {
    const auto compressed = shotsOf(copyOfMeasured("killed"));
    const fs::path calibration = path("killed");
    makePlain(calibration);
    Random random{2026};
    int killed = 0;
    for (int round = 0; round < 12; ++round) {
      const pid_t child = ::fork();
      if (child == 0) {
        Progress quiet;
        tidy({calibration}, {}, quiet);
        ::_exit(0);
      }
      const auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(random.below(20000));
      while (std::chrono::steady_clock::now() < until) {
      }
      ::kill(child, SIGKILL);
      int status = 0;
      QCOMPARE(::waitpid(child, &status, 0), child);
      killed += WIFSIGNALED(status);
      for (const auto& [name, content] : compressed) {
        const auto shot = shotFrom(readFile(calibration / "shots" / name));
        QVERIFY2(shot && shotFileOf(*shot) == content, name.c_str());
      }
    }
    QVERIFY(killed > 0);
    Progress quiet;
    tidy({calibration}, {}, quiet);
    QVERIFY(shotsOf(calibration) == compressed);
  }
};

QTEST_GUILESS_MAIN(TestKeptPhotographs)
#include "test_kept_photographs.moc"
