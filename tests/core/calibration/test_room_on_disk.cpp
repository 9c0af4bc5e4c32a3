// SPDX-License-Identifier: MIT
#include <QTest>
#include <map>

#include "relucent/base/disk_full.h"
#include "relucent/base/random.h"
#include "relucent/calibration/patient_shot_log.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::rig;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t spare = PatientShotLog::spare;

/// A disk that fills up and that somebody makes room on while the measurement waits.
class ScriptedDisk : public RoomWaiter {
 public:
  std::uint64_t free = 0;
  std::uint64_t freedAWait = 0;
  Answer answer = Answer::look;
  StopRequest* stop = nullptr;  // asked to cancel when it is waited for
  std::vector<FullDisk> waits;
  int pauses = 0;

  std::uint64_t freeBytes(const fs::path&) const override { return free; }
  Answer wait(const FullDisk& disk) override {
    waits.push_back(disk);
    free += freedAWait;
    if (stop != nullptr) stop->ask(StopRequest::Kind::cancel);
    return answer;
  }
  void over() override { ++pauses; }
  std::chrono::steady_clock::duration paused{};
  std::chrono::steady_clock::duration otherPauses() const override { return paused; }
};

/// Holds shots as long as the disk has room for them.
class LogOnDisk : public ShotLog {
 public:
  explicit LogOnDisk(ScriptedDisk& disk) : disk_(disk) {}
  std::uint64_t bytesOfShot = 1000;
  std::map<int, int> kept;  // times, by number

  std::optional<Shot> find(const ShotId&, const std::string&) override { return std::nullopt; }
  void keep(const Shot& shot) override {
    if (disk_.free < bytesOfShot)
      throw DiskFull(ErrorKind::disk, Message::plain("cannot write"), Message::plain("free some space"));
    disk_.free -= bytesOfShot;
    ++kept[shot.id.number];
  }
  std::uint64_t bytesOfLast() const override { return bytesOfShot; }

 private:
  ScriptedDisk& disk_;
};

class Lamp : public Projector {
 public:
  explicit Lamp(int& dark) : dark_(dark) {}
  std::string name() const override { return "lamp"; }
  Size size() const override { return {2, 2}; }
  int bits() const override { return 8; }
  void show(const image::Image& drive) override {
    for (float value : drive.data())
      if (value != 0.0f) return;
    ++dark_;
  }

 private:
  int& dark_;
};

Shot shotOf(int number) {
  return {{"acquisition", number}, "f", {{RawFrame{image::Image({5, 5}, 3), 8, 1.0}}}, {1.0}};
}

}  // namespace

class TestRoomOnDisk : public QObject {
  Q_OBJECT

 private slots:
  /// Law: what somebody paused before this measurement is none of its pauses.
  void otherPausesCountFromTheBeginning() {
    using namespace std::chrono_literals;
    ScriptedDisk disk;
    disk.paused = 5s;
    Progress quiet;
    const RoomOnDisk room("/nowhere", &disk, quiet);
    QCOMPARE(room.allPauses().count(), RoomOnDisk::Duration(0s).count());
    disk.paused = 12s;
    QCOMPARE(room.allPauses().count(), RoomOnDisk::Duration(7s).count());
    QCOMPARE(RoomOnDisk("/nowhere", nullptr, quiet).allPauses().count(), RoomOnDisk::Duration(0s).count());
  }

  /// Law: however the disk fills and empties, every shot is kept once, the projectors are dark in every
  /// pause, and there is always room left for what else is written.
  void noShotIsLost_data() {
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 20; ++seed) QTest::addRow("seed %d", static_cast<int>(seed)) << seed;
  }
  void noShotIsLost() {
    QFETCH(quint64, seed);
    Random random{seed};
    ScriptedDisk disk;
    disk.free = random.below(40'000'000);
    disk.freedAWait = 1 + random.below(5'000'000);
    LogOnDisk log(disk);
    log.bytesOfShot = 1 + random.below(4'000'000);
    int dark = 0;
    Rig rig;
    rig.projectors.push_back(std::make_unique<Lamp>(dark));
    const Progress progress;
    RoomOnDisk room("venue", &disk, progress);
    PatientShotLog patient(log, room, rig);
    for (int number = 0; number < 40; ++number) {
      patient.keep(shotOf(number));
      QVERIFY(disk.free >= spare);
      // Something else fills the disk meanwhile, now and then to the last byte.
      disk.free -= std::min(disk.free, random.below(8) == 0 ? disk.free : random.below(3'000'000));
    }
    QCOMPARE(log.kept.size(), std::size_t{40});
    for (const auto& [number, times] : log.kept) QCOMPARE(times, 1);
    QVERIFY(disk.pauses > 0);
    QCOMPARE(dark, disk.pauses);
    for (const FullDisk& told : disk.waits) QVERIFY(told.folder == "venue" && told.needed >= spare);
  }

  /// Once it has paused there is room for some time, not for a shot.
  void itDoesNotPauseAtEveryShot() {
    ScriptedDisk disk;
    LogOnDisk log(disk);
    log.bytesOfShot = 1'000'000;
    disk.free = spare;
    disk.freedAWait = 100'000;
    Rig rig;
    const Progress progress;
    RoomOnDisk room("venue", &disk, progress);
    PatientShotLog patient(log, room, rig);
    patient.keep(shotOf(0));
    QCOMPARE(disk.pauses, 1);
    QCOMPARE(disk.waits.front().needed, 2 * (spare + PatientShotLog::shotsAhead * log.bytesOfShot));
    for (int number = 1; number < 10; ++number) patient.keep(shotOf(number));
    QCOMPARE(disk.pauses, 1);
  }

  /// Whoever says so goes on with little room, until there is none.
  void somebodyMaySayGoOn() {
    ScriptedDisk disk;
    disk.answer = RoomWaiter::Answer::goOn;
    LogOnDisk log(disk);
    disk.free = 10 * log.bytesOfShot;
    Rig rig;
    const Progress progress;
    RoomOnDisk room("venue", &disk, progress);
    PatientShotLog patient(log, room, rig);
    for (int number = 0; number < 10; ++number) patient.keep(shotOf(number));
    QCOMPARE(disk.pauses, 1);
    disk.freedAWait = 5000;
    patient.keep(shotOf(10));
    QVERIFY(disk.pauses > 1);
    QCOMPARE(log.kept.size(), std::size_t{11});
  }

  void aPauseCanBeCancelled() {
    SilentSink sink;
    StopRequest stop;
    const Progress progress(sink, stop);
    ScriptedDisk disk;
    disk.stop = &stop;
    LogOnDisk log(disk);
    Rig rig;
    RoomOnDisk room("venue", &disk, progress);
    PatientShotLog patient(log, room, rig);
    QVERIFY_EXCEPTION_THROWN(patient.keep(shotOf(0)), Cancelled);
    QCOMPARE(disk.pauses, 1);  // whoever waits is told that it is over
    QVERIFY(log.kept.empty());
  }

  /// Before a shot is written: room for it and the next ones, as they are at most.
  void roomIsAskedForInShots() {
    ScriptedDisk disk;
    LogOnDisk log(disk);
    disk.freedAWait = std::uint64_t{1} << 40;
    Rig rig;
    const Progress progress;
    RoomOnDisk room("venue", &disk, progress);
    PatientShotLog patient(log, room, rig);
    const Shot shot = shotOf(0);
    patient.keep(shot);
    QCOMPARE(disk.waits.front().needed, spare + PatientShotLog::shotsAhead * plainBytes(shot));
  }

  void withNobodyToWaitItIsAFailure() {
    ScriptedDisk disk;
    LogOnDisk log(disk);
    Rig rig;
    const Progress progress;
    RoomOnDisk room("venue", nullptr, progress);
    PatientShotLog patient(log, room, rig);
    const std::string sentence = sentenceOf([&] { patient.keep(shotOf(0)); }, ErrorKind::disk);
    QVERIFY(mentions(sentence, "the disk is full"));
    QVERIFY(mentions(sentence, "then resume"));
    // Little room is none of its business.
    disk.free = log.bytesOfShot;
    patient.keep(shotOf(0));
    QCOMPARE(log.kept[0], 1);
  }

  void otherFailuresAreNotWaitedFor() {
    ScriptedDisk disk;
    disk.free = 1'000'000'000;
    const Progress progress;
    RoomOnDisk room("venue", &disk, progress);
    const auto broken = [] {
      throw Error(ErrorKind::disk, Message::plain("cannot write (broken)"), Message::plain("check the disk"));
    };
    QVERIFY(mentions(sentenceOf([&] { room.write(1, broken); }, ErrorKind::disk), "broken"));
    QCOMPARE(disk.pauses, 0);
  }

  /// Where a user has a quota, the free bytes are not his: it is tried again all the same, after a wait.
  void aQuotaIsWaitedForToo() {
    ScriptedDisk disk;
    disk.free = 1'000'000'000;
    const Progress progress;
    RoomOnDisk room("venue", &disk, progress);
    int tries = 0;
    room.write(1, [&] {
      if (++tries < 4) throw DiskFull(ErrorKind::disk, Message::plain("quota"), Message::plain("wait"));
    });
    QCOMPARE(tries, 4);
    QCOMPARE(disk.waits.size(), std::size_t{3});
    QCOMPARE(disk.pauses, 1);
    QVERIFY(room.paused() > std::chrono::steady_clock::duration::zero());
  }

  void theSystemSaysHowMuchIsFree() {
    class Anybody : public RoomWaiter {
      Answer wait(const FullDisk&) override { return Answer::look; }
    } anybody;
    QVERIFY(anybody.freeBytes(fs::temp_directory_path()) > 0);
    QCOMPARE(anybody.freeBytes("/no/such/place"), std::numeric_limits<std::uint64_t>::max());
  }
};

QTEST_APPLESS_MAIN(TestRoomOnDisk)
#include "test_room_on_disk.moc"
