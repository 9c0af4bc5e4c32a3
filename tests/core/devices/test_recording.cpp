// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <fstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/devices/recording/recording.h"
#include "relucent/devices/recording/recording_files.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/rig/shot.h"
#include "support/scripted_rig.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::venue;
using namespace relucent::test;
namespace fs = std::filesystem;

namespace {

/// Two projectors and two cameras, noise included; one camera of 12 bits, one of floats.
ScriptedVenue scene() {
  SyntheticSettings synthetic;
  synthetic.projectors = {{16, 12}, {8, 8}};
  synthetic.cameras = {{12, 9}, {5, 7}};
  ScriptedSettings settings;
  settings.cameras.resize(2);
  settings.cameras[0].bits = 12;
  settings.cameras[1].bits = 0;
  return ScriptedVenue(syntheticTransport(synthetic), {}, settings);
}

std::vector<Image> patterns(float value) {
  return {Image({16, 12}, 3, value), Image({8, 8}, 3, 1.0f - value)};
}

/// Shots of a small stage: pattern i at two exposures.
std::vector<Shot> photographed(Rig& rig, int shots, const std::string& stage = "stage") {
  NoShotLog log;
  ShotTaker taker(rig, log, stage);
  std::vector<Shot> taken;
  for (int i = 0; i < shots; ++i)
    taken.push_back(taker.take(patterns(0.25f * static_cast<float>(i)), {0.02, 0.005}, Progress()));
  return taken;
}

bool sameFrames(const std::vector<Shot>& a, const std::vector<Shot>& b) {
  bool same = a.size() == b.size();
  for (std::size_t shot = 0; same && shot < a.size(); ++shot)
    for (std::size_t exposure = 0; exposure < a[shot].frames.size(); ++exposure)
      for (std::size_t camera = 0; camera < a[shot].frames[exposure].size(); ++camera) {
        const RawFrame &one = a[shot].frames[exposure][camera], &two = b[shot].frames[exposure][camera];
        same = same && one.signal == two.signal && one.bits == two.bits && one.seconds == two.seconds;
      }
  return same;
}

}  // namespace

class TestRecording : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path fresh() const {
    static int number = 0;
    return root() / std::to_string(number++);
  }

 private slots:
  void whatIsReplayedIsWhatWasRecorded() {
    const fs::path folder = fresh();
    Rig direct = scene().rig(), rig = recorded(scene().rig(), folder);
    const std::vector<Shot> expected = photographed(direct, 4), taken = photographed(rig, 4);
    QVERIFY(sameFrames(expected, taken));  // recording changes nothing

    Rig again = replayed(folder);
    QCOMPARE(again.projectors.size(), std::size_t{2});
    QCOMPARE(again.cameras.size(), std::size_t{2});
    for (std::size_t i = 0; i < 2; ++i) {
      QCOMPARE(again.projectors[i]->name(), rig.projectors[i]->name());
      QCOMPARE(again.projectors[i]->size(), rig.projectors[i]->size());
      QCOMPARE(again.projectors[i]->bits(), rig.projectors[i]->bits());
      QCOMPARE(again.cameras[i]->name(), rig.cameras[i]->name());
      QCOMPARE(again.cameras[i]->size(), rig.cameras[i]->size());
      QCOMPARE(again.cameras[i]->exposures().shortest, rig.cameras[i]->exposures().shortest);
      QCOMPARE(again.cameras[i]->exposures().longest, rig.cameras[i]->exposures().longest);
    }
    QVERIFY(sameFrames(expected, photographed(again, 4)));
  }

  void patternsAreThereToBeLookedAt() {
    const fs::path folder = fresh();
    Rig rig = recorded(scene().rig(), folder);
    photographed(rig, 3);
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder / "patterns")) {
      const Size size = readPicture(entry.path()).encoded.size();
      QVERIFY(size == (Size{16, 12}) || size == (Size{8, 8}));
      ++files;
    }
    QCOMPARE(files, std::size_t{6});  // three different ones a projector
  }

  void aRecordingIsAddedTo() {
    const fs::path folder = fresh();
    {
      Rig rig = recorded(scene().rig(), folder);
      photographed(rig, 2);
    }
    // As if the power had gone while a line was written.
    std::ofstream(folder / "photographs.jsonl", std::ios::app) << "\n{\"camera\":1,\"sta";
    Rig rig = recorded(scene().rig(), folder);
    const std::vector<Shot> expected = photographed(rig, 3);
    Rig again = replayed(folder);
    QVERIFY(sameFrames(expected, photographed(again, 3)));
  }

  void aShotTakenAgainCountsAsItWasTheSecondTime() {
    const fs::path folder = fresh();
    Rig rig = recorded(scene().rig(), folder);
    for (std::size_t i = 0; i < 2; ++i) rig.projectors[i]->show(patterns(0.5f)[i]);
    rig.cameras[0]->capture({{"stage", 3}, 0, 0.01});
    const RawFrame other = rig.cameras[0]->capture({{"stage", 4}, 0, 0.01});  // other noise
    const RawFrame third = rig.cameras[0]->capture({{"stage", 3}, 0, 0.01});
    Rig again = replayed(folder);
    for (std::size_t i = 0; i < 2; ++i) again.projectors[i]->show(patterns(0.5f)[i]);
    QCOMPARE(again.cameras[0]->capture({{"stage", 3}, 0, 0.01}).signal, third.signal);
    QCOMPARE(again.cameras[0]->capture({{"stage", 4}, 0, 0.01}).signal, other.signal);
    // Other settings count shots otherwise: the nearest with the same light.
    QCOMPARE(again.cameras[0]->capture({{"stage", 9}, 0, 0.01}).signal, other.signal);
    QCOMPARE(again.cameras[0]->capture({{"stage", 1}, 0, 0.01}).signal, third.signal);
  }

  void whatWasNotPhotographedIsTold() {
    const fs::path folder = fresh();
    Rig rig = recorded(scene().rig(), folder);
    photographed(rig, 1);
    Rig again = replayed(folder);
    const std::string before =
        sentenceOf([&] { again.cameras[0]->capture({{"stage", 0}, 0, 0.02}); }, ErrorKind::input);
    QVERIFY(mentions(before, "the recording has no photograph of stage 0 with 0.02 s"));  // nothing shown yet
    for (std::size_t i = 0; i < 2; ++i) again.projectors[i]->show(patterns(0.0f)[i]);
    again.cameras[0]->capture({{"stage", 0}, 0, 0.02});
    const std::string exposure =
        sentenceOf([&] { again.cameras[0]->capture({{"stage", 0}, 0, 0.03}); }, ErrorKind::input);
    QVERIFY(mentions(exposure, "use the settings that it was recorded with"));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, again.projectors[0]->show(Image({3, 3}, 3)));
  }

  void otherFoldersAreRefused_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<ErrorKind>("kind");
    QTest::addColumn<QString>("part");
    QTest::newRow("later version") << QByteArray(R"({"format":"relucent recording","version":2})")
                                   << ErrorKind::format << "the recording is of version 2";
    QTest::newRow("foreign") << QByteArray(R"({"format":"tape","version":1})") << ErrorKind::format
                             << "this is not a recording";
    QTest::newRow("text") << QByteArray("hello") << ErrorKind::format << "the recording is damaged";
    QTest::newRow("empty") << QByteArray("") << ErrorKind::format << "the recording is damaged";
    QTest::newRow("no devices") << QByteArray(R"({"format":"relucent recording","version":1})")
                                << ErrorKind::format << "the recording is damaged";
    QTest::newRow("size") << QByteArray(R"({"format":"relucent recording","version":1,
        "projectors":[{"name":"a","size":[0,-1],"bits":8}],"cameras":[]})")
                          << ErrorKind::format << "an impossible size";
  }
  void otherFoldersAreRefused() {
    QFETCH(QByteArray, content);
    QFETCH(ErrorKind, kind);
    QFETCH(QString, part);
    const fs::path folder = fresh();
    createFolder(folder);
    writeFileAtomically(folder / "recording.json", content.toStdString());
    QVERIFY(mentions(sentenceOf([&] { replayed(folder); }, kind), part.toStdString()));
  }

  void photographsElsewhereAreRefused_data() {
    QTest::addColumn<std::string>("file");
    QTest::newRow("above") << std::string("../0.tiff");
    QTest::newRow("anywhere") << std::string("/tmp/0.tiff");
    QTest::newRow("the folder") << std::string("..");
    QTest::newRow("none") << std::string();
  }
  void photographsElsewhereAreRefused() {
    QFETCH(std::string, file);
    const fs::path folder = fresh();
    createFolder(folder);
    RecordedPhotograph photograph;
    photograph.file = file;
    appendPhotograph(folder, photograph);
    QVERIFY(mentions(sentenceOf([&] { readPhotographs(folder); }, ErrorKind::format), "lies elsewhere"));
  }

  void nothingIsRecordedOverOtherThings() {
    const fs::path folder = fresh();
    createFolder(folder);
    writeFileAtomically(folder / "diary.txt", "dear diary");
    QVERIFY(mentions(sentenceOf([&] { recorded(scene().rig(), folder); }, ErrorKind::input),
                     "holds other things"));
    const fs::path other = fresh();
    {
      Rig rig = recorded(scene().rig(), other);
    }
    Rig different = scene().rig();
    different.cameras.pop_back();
    QVERIFY(mentions(sentenceOf([&] { recorded(std::move(different), other); }, ErrorKind::input),
                     "a recording of other devices"));
  }

  void aCalibrationFromAReplayIsTheSameBits() {
    VenueSettings simulated;
    simulated.name = "plain";
    simulated.projector = {24, 18};
    simulated.camera = {24, 18};
    simulated.pathsPerPixel = 16;
    CalibrateSettings settings;
    settings.rig = simulated;
    settings.linearization.levels = 9;
    settings.acquisition = settingsOf(AcquisitionMode::fast);

    auto measure = [&](Rig rig, const fs::path& path) {
      Progress silent;
      CalibrationFolder folder = beginCalibration(path, settings);
      const Linearization linearization = measureLinearization(folder, rig, silent);
      measureAcquisition(folder, rig, linearization, {}, silent);
      for (const auto& entry : fs::recursive_directory_iterator(path))
        if (entry.path().filename() == "transport.npz") return readFile(entry.path());
      return std::string();
    };
    Progress silent;
    const SimulatedVenue place(simulated, {}, silent);
    const fs::path recording = fresh();
    const std::string first = measure(recorded(place.rig(), recording), fresh());
    QVERIFY(!first.empty());
    QVERIFY(first == measure(replayed(recording), fresh()));

    // Other settings of what is computed, not of what is photographed, are possible.
    settings.acquisition.flagSigmas *= 2.0;
    QVERIFY(!measure(replayed(recording), fresh()).empty());
  }
};

QTEST_GUILESS_MAIN(TestRecording)
#include "test_recording.moc"
