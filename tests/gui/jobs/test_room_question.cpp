// SPDX-License-Identifier: MIT
#include <QSignalSpy>
#include <QtTest>
#include <atomic>

#include "jobs/job.h"
#include "jobs/room_question.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;

namespace {

/// A disk whose free bytes the test sets.
struct Disk : RoomQuestion {
  std::atomic<std::uint64_t> free{0};
  std::uint64_t freeBytes(const std::filesystem::path&) const override { return free; }
};

}  // namespace

/// A measurement that waits for room, and the interface that tells so.
class TestRoomQuestion : public QObject {
  Q_OBJECT

  static constexpr int patience = 20'000;

 private slots:
  void itWaitsUntilThereIsRoom() {
    Disk disk;
    Job job;
    std::atomic<bool> isThrough = false;
    QSignalSpy changed(&disk, &RoomQuestion::changed);
    job.start([&](Progress& progress) {
      RoomOnDisk("venue", &disk, progress).waitFor(1000, 3000);
      isThrough = true;
    });
    QTRY_VERIFY_WITH_TIMEOUT(disk.waiting().has_value(), patience);
    QCOMPARE(disk.waiting()->needed, std::uint64_t{3000});
    QVERIFY(disk.waiting()->folder == "venue");
    disk.free = 2999;
    QTRY_COMPARE_WITH_TIMEOUT(disk.waiting()->free, std::uint64_t{2999}, patience);
    QVERIFY(!isThrough);
    disk.free = 3000;
    QTRY_COMPARE_WITH_TIMEOUT(job.state(), Job::State::done, patience);
    QVERIFY(isThrough && !disk.waiting());
    QCOMPARE(changed.size(), 2);  // less than a megabyte is no news
  }

  void somebodySaysGoOn() {
    Disk disk;
    disk.goOn();  // nobody waits: of no effect
    Job job;
    job.start([&](Progress& progress) { RoomOnDisk("venue", &disk, progress).waitFor(1000, 1000); });
    QTRY_VERIFY_WITH_TIMEOUT(disk.waiting().has_value(), patience);
    QVERIFY(job.isRunning());
    disk.goOn();
    QTRY_COMPARE_WITH_TIMEOUT(job.state(), Job::State::done, patience);
  }

  void cancellingEndsIt() {
    Disk disk;
    Job job;
    job.start([&](Progress& progress) { RoomOnDisk("venue", &disk, progress).waitFor(1000, 1000); });
    QTRY_VERIFY_WITH_TIMEOUT(disk.waiting().has_value(), patience);
    job.cancel();
    QTRY_COMPARE_WITH_TIMEOUT(job.state(), Job::State::cancelled, patience);
    QVERIFY(!disk.waiting());
  }
};

QTEST_GUILESS_MAIN(TestRoomQuestion)
#include "test_room_question.moc"
