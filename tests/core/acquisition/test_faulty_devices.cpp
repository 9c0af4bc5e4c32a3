// SPDX-License-Identifier: MIT
// What real devices do wrong in the middle of a measurement: each fault ends in another try or in a pause,
// and leaves no trace in the transport.
#include <QTemporaryDir>
#include <filesystem>

#include "acquisition_run.h"
#include "disturbed_rig.h"
#include "relucent/base/message.h"
#include "relucent/calibration/shot_journal.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::linearization;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::venue;
using namespace relucent::test;
namespace fs = std::filesystem;

Q_DECLARE_METATYPE(Fault)

namespace {

CameraKind kindFor(Fault fault) {
  const bool isStill = fault == Fault::flatBattery || fault == Fault::fullCard || fault == Fault::lateFile;
  return isStill ? CameraKind::still : CameraKind::network;
}

/// Runs of acquisition in a traced venue, each with devices of its own.
class Measurements {
 public:
  Measurements() : venue_(settings(), {}, progress_) {
    const DeviceModelSettings& devices = venue_.settings().devices;
    linearization_.cameras.resize(1);
    linearization_.cameras[0].gain = 1.0 / devices.fullWell;
    linearization_.cameras[0].readNoise =
        std::hypot(devices.readElectrons / devices.fullWell, 1.0 / 4095.0 / std::sqrt(12.0));
    acquisition_.relativeThreshold = 0.05;
    acquisition_.references = 3;
    acquisition_.verificationPatterns = 4;
  }

  DisturbedRig rig(CameraKind kind, const Disturbance& disturbance = {}) const {
    return {venue_, kind, disturbance};
  }
  /// What was measured, or the sentence of the failure of a device.
  struct Outcome {
    std::optional<Acquisition> measured{};
    std::string said{};
  };
  Outcome run(DisturbedRig& rig, ShotLog& log) {
    Outcome outcome;
    outcome.said = sentenceOf([&] { outcome.measured = measured(rig, log); }, ErrorKind::device);
    return outcome;
  }
  /// Undisturbed, once.
  const Acquisition& sound(CameraKind kind) {
    auto& known = sound_[kind];
    if (!known) {
      NoShotLog log;
      DisturbedRig sane = rig(kind);
      known = measured(sane, log);
    }
    return *known;
  }
  const TransportMatrix& truth() const { return venue_.trueTransport(); }

 private:
  Acquisition measured(DisturbedRig& rig, ShotLog& log) {
    Linearization linearization = linearization_;
    const ExposureRange range = rig.rig().cameras.front()->exposures();
    for (double seconds : {longExposure, shortExposure})
      linearization.exposures.push_back(std::clamp(seconds, range.shortest, range.longest));
    ShotTaker shots(rig.rig(), log, "acquisition");
    return acquire({shots, linearization, acquisition_}, progress_);
  }
  static VenueSettings settings() {
    VenueSettings settings;
    settings.projector = {24, 18};
    settings.camera = {24, 18};
    settings.pathsPerPixel = 16;
    return settings;
  }

  Progress progress_;
  SimulatedVenue venue_;
  Linearization linearization_;
  AcquisitionSettings acquisition_;
  std::map<CameraKind, std::optional<Acquisition>> sound_;
};

/// Whether that was measured, to the bit; says why not.
bool isSame(const Measurements::Outcome& outcome, const Acquisition& b) {
  if (!outcome.measured) qWarning("%s", outcome.said.c_str());
  if (!outcome.measured) return false;
  const Acquisition& a = *outcome.measured;
  return a.transport == b.transport && a.black == b.black && a.flood == b.flood &&
         a.leafVariance == b.leafVariance && a.flagged == b.flagged && a.patterns == b.patterns &&
         a.exposures == b.exposures;
}

/// A journal as it was left: writing each shot through to the disk takes most of this test's time.
class JournalToRead : public ShotLog {
 public:
  explicit JournalToRead(const fs::path& folder) : journal_(folder) {}
  std::optional<Shot> find(const ShotId& id, const std::string& fingerprint) override {
    return journal_.find(id, fingerprint);
  }
  void keep(const Shot&) override {}

 private:
  ShotJournal journal_;
};

int shotsIn(const fs::path& journal) {
  return static_cast<int>(std::distance(fs::directory_iterator(journal), fs::directory_iterator()));
}

}  // namespace

class TestFaultyDevices : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    measurements_ = std::make_unique<Measurements>();
    for (CameraKind kind : {CameraKind::network, CameraKind::still}) {
      const Acquisition& sound = measurements_->sound(kind);
      qInfo("%d patterns, %d exposures, verification %.4f", sound.patterns, sound.exposures,
            sound.verificationError);
      QVERIFY(sound.patterns > 100);
    }
  }

  /// Three times each: among the floods, in the tree, and near the end.
  void aShortFaultLeavesNoTrace_data() {
    QTest::addColumn<Fault>("fault");
    QTest::addColumn<int>("photographs");  // one after the other, each of the three times
    QTest::addColumn<int>("seconds");
    QTest::addColumn<int>("repeats");        // of photographs, in all
    QTest::addColumn<int>("reconnections");  // in all
    QTest::addColumn<int>("dropped");        // frames, in all
    auto row = [](const char* name, Fault fault, int photographs, int seconds, int repeats, int reconnections,
                  int dropped) {
      QTest::newRow(name) << fault << photographs << seconds << repeats << reconnections << dropped;
    };
    row("lost packets", Fault::lostPackets, 1, 0, 3, 0, 3);
    row("lost packets, again and again", Fault::lostPackets, 4, 0, 12, 9, 12);
    row("timeout", Fault::noFrame, 1, 0, 3, 0, 0);
    row("timeout, again and again", Fault::noFrame, 4, 0, 12, 9, 0);
    row("wrong size", Fault::otherSize, 1, 0, 3, 3, 3);
    row("stale frame", Fault::staleFirst, 1, 0, 0, 0, 3);
    row("stale frame and no other", Fault::staleOnly, 2, 0, 6, 3, 6);
    row("stale frame under its old number", Fault::sameNumber, 1, 0, 0, 0, 3);
    row("unplugged", Fault::unplugged, 1, 20, 3, 3, 0);
    row("dead battery", Fault::flatBattery, 1, 100, 3, 3, 0);
    row("full card", Fault::fullCard, 1, 100, 3, 3, 0);
    row("late file", Fault::lateFile, 1, 0, 3, 0, 0);
    row("vanishing screen", Fault::vanishingScreen, 1, 0, 0, 0, 0);
    row("vanishing screen, again and again", Fault::vanishingScreen, 19, 0, 0, 0, 0);
  }
  void aShortFaultLeavesNoTrace() {
    QFETCH(Fault, fault);
    QFETCH(int, photographs);
    QFETCH(int, seconds);
    const CameraKind kind = kindFor(fault);
    const Acquisition& sound = measurements_->sound(kind);
    Disturbance disturbance{fault, {7, sound.patterns / 2, sound.patterns - 3}, photographs};
    disturbance.lasts = std::chrono::seconds(seconds);
    DisturbedRig rig = measurements_->rig(kind, disturbance);
    NoShotLog log;
    QVERIFY(isSame(measurements_->run(rig, log), sound));
    QCOMPARE(rig.venue().spoilt(), 3 * photographs);
    QTEST(rig.camera().repeats(), "repeats");
    QTEST(rig.camera().reconnections(), "reconnections");
    if (kind == CameraKind::network) QTEST(rig.dropped(), "dropped");
  }

  void aLongFaultIsAPause_data() {
    QTest::addColumn<Fault>("fault");
    QTest::addColumn<QString>("sentence");
    auto row = [](const char* name, Fault fault, const char* sentence) {
      QTest::newRow(name) << fault << QString(sentence);
    };
    row("lost packets", Fault::lostPackets,
        "5 attempts at a photograph failed: parts of the photograph were lost");
    row("timeout", Fault::noFrame, "5 attempts at a photograph failed: no photograph came within 2");
    row("wrong size", Fault::otherSize,
        "the photograph has 24x17 pixels as RGB12 where 24x18 as RGB12 were agreed");
    row("stale frame", Fault::staleOnly, "no photograph came within 2");
    row("unplugged", Fault::unplugged, "the camera has been gone for 30 s: the cable was pulled");
    row("cut exposure", Fault::cutExposure, "the camera was asked to expose 0.125 s but exposes 0.05 s");
    row("dead battery", Fault::flatBattery, "battery seems to be empty (8 % when it was last asked)");
    row("full card", Fault::fullCard, "its memory card is full; change or empty the memory card");
    row("vanishing screen", Fault::vanishingScreen,
        "HDMI-1: the projector's screen keeps losing its picture");
  }
  /// What was measured before stays in the journal, and running it again with sound devices goes on from
  /// there.
  void aLongFaultIsAPause() {
    QFETCH(Fault, fault);
    QFETCH(QString, sentence);
    const CameraKind kind = kindFor(fault);
    const Acquisition& sound = measurements_->sound(kind);
    const int shot = sound.patterns / 3;
    const Disturbance disturbance{fault, {shot}, 1 << 30, std::chrono::hours(1)};
    QTemporaryDir folder;
    const fs::path path = folder.path().toStdString();
    int kept = 0;
    {
      ShotJournal journal(path);
      DisturbedRig rig = measurements_->rig(kind, disturbance);
      const std::string said = measurements_->run(rig, journal).said;
      QVERIFY(mentions(said, sentence.toStdString()));
      QVERIFY(rig.venue().spoilt() > 0);
      kept = *rig.venue().photographed().rbegin();  // all but the one that failed
      QVERIFY(kept >= shot && kept < sound.patterns);
      QCOMPARE(shotsIn(path), kept);
    }
    JournalToRead journal(path);
    DisturbedRig rig = measurements_->rig(kind);
    QVERIFY(isSame(measurements_->run(rig, journal), sound));
    QCOMPARE(static_cast<int>(rig.venue().photographed().size()), sound.patterns - kept);
    QCOMPARE(*rig.venue().photographed().begin(), kept);
  }

  /// A camera that claims more than it keeps to is used as if it had claimed what it keeps to.
  void aRangeIsUsedAsKeptTo() {
    Disturbance honest, boasting;
    honest.claimed = honest.kept = boasting.kept = {1.0 / 8000.0, 0.1};
    NoShotLog log;
    DisturbedRig modest = measurements_->rig(CameraKind::network, honest);
    DisturbedRig rig = measurements_->rig(CameraKind::network, boasting);
    QCOMPARE(rig.camera().exposures().longest, 0.1);
    QCOMPARE(rig.camera().traits().remarks.size(), std::size_t{1});
    QVERIFY(mentions(english(rig.camera().traits().remarks.front()),
                     "claims exposures up to 4 s but reaches only 0.1 s"));
    const auto expected = measurements_->run(modest, log);
    QVERIFY2(expected.measured, expected.said.c_str());
    QVERIFY(!isSame(expected, measurements_->sound(CameraKind::network)));
    QVERIFY(isSame(measurements_->run(rig, log), *expected.measured));
    QCOMPARE(rig.camera().repeats(), 0);
  }

  /// Off by less than half, an exposure counts as what the camera keeps to: noisier, and no less true.
  void anExposureThatIsCutALittleIsUsedAsKeptTo() {
    const Acquisition& sound = measurements_->sound(CameraKind::network);
    const Disturbance disturbance{Fault::slightlyCut, {sound.patterns / 2}};
    DisturbedRig rig = measurements_->rig(CameraKind::network, disturbance);
    MemoryLog log;
    const auto outcome = measurements_->run(rig, log);
    QVERIFY2(outcome.measured, outcome.said.c_str());
    int cut = 0;
    for (const auto& [number, shot] : log.shots)
      for (const auto& frames : shot.frames) cut += frames.front().seconds == 0.8 * longExposure;
    QVERIFY(cut > 0);
    QCOMPARE(rig.venue().spoilt(), cut);
    const double error = difference(outcome.measured->transport, measurements_->truth()).frobenius;
    const double best = difference(sound.transport, measurements_->truth()).frobenius;
    QVERIFY2(error < 1.05 * best, qPrintable(QString("%1 instead of %2").arg(error).arg(best)));
  }

  /// Read back as it was asked for, it is found by the light: the journal forgets what may be wrong.
  void anExposureThatIsCutUnseenIsFoundByTheSentinels() {
    const Acquisition& sound = measurements_->sound(CameraKind::network);
    const int shot = sound.patterns / 3;
    QTemporaryDir folder;
    const fs::path path = folder.path().toStdString();
    {
      ShotJournal journal(path);
      DisturbedRig rig = measurements_->rig(CameraKind::network, {Fault::cutUnseen, {shot}});
      const std::string said = measurements_->run(rig, journal).said;
      QVERIFY(mentions(said, "photographs of one pattern differ"));
      QVERIFY(rig.venue().spoilt() > 0);
      QVERIFY2(shotsIn(path) <= shot, said.c_str());
      QVERIFY2(shotsIn(path) > shot - 45, said.c_str());  // the checks are 40 shots apart
    }
    JournalToRead journal(path);
    DisturbedRig rig = measurements_->rig(CameraKind::network);
    QVERIFY(isSame(measurements_->run(rig, journal), sound));
  }

 private:
  std::unique_ptr<Measurements> measurements_;
};

QTEST_GUILESS_MAIN(TestFaultyDevices)
#include "test_faulty_devices.moc"
