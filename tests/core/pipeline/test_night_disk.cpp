// SPDX-License-Identifier: MIT
// A night on a disk that is full.
#include <QCoreApplication>
#include <QTemporaryDir>
#include <QtTest>

#include "core/pipeline/night_venue.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/measured_venue.h"
#include "support/own_network.h"
#include "support/small_disk.h"

using namespace relucent;
using namespace relucent::pipeline;
using namespace relucent::test;
namespace fs = std::filesystem;

class TestNightDisk : public QObject {
  Q_OBJECT

  const fs::path root_;
  SmallDisk& disk_;
  Progress quiet_;

 public:
  TestNightDisk(fs::path root, SmallDisk& disk) : root_(std::move(root)), disk_(disk) {}

 private slots:
  void initTestCase() {
    if (!disk_.isMounted()) QSKIP("nobody may mount a disk of his own here");
    measureNightVenue(root_ / "measured", root_ / "cache");
    writeNightPicture(root_ / "picture.png");
  }
  void init() {
    fs::remove_all(disk_.folder() / "venue");
    fs::copy(root_ / "measured", disk_.folder() / "venue", fs::copy_options::recursive);
  }

  void theOlderCalibrationPlaysOn_data() {
    QTest::addColumn<quint64>("left");
    QTest::addColumn<bool>("isTold");  // a line of the history has room
    QTest::newRow("room for a line") << quint64{24 * 1024} << true;
    QTest::newRow("room for a part of the light transport") << quint64{96 * 1024} << true;
    QTest::newRow("none") << quint64{0} << false;
  }
  /// Law: where a repair has no room the calibration is what it was, an alarm says why, and the next night
  /// that has room repairs it.
  void theOlderCalibrationPlaysOn() {
    QFETCH(quint64, left);
    QFETCH(bool, isTold);
    const fs::path venue = disk_.folder() / "venue", told = root_ / "told";
    const std::string manifest = readFile(venue / calibration::CalibrationFolder::manifestName);
    NightSettings settings = nightSettings(root_ / "picture.png", paintedWall());
    settings.alarmCommand = "echo {sentence} >" + told.string();
    fs::remove(told);
    disk_.fillUpTo(left);
    if (isTold) {
      const NightRecord night = tendCalibration(venue, settings, root_ / "cache", quiet_);
      QVERIFY(isAlarm(night) && !night.repair && night.told);
      QVERIFY2(english(night.alarm).find("disk") != std::string::npos ||
                   english(night.alarm).find("space") != std::string::npos,
               english(night.alarm).c_str());
      QCOMPARE(nightsOf(venue).size(), 1);
    } else {
      QVERIFY_THROWS_EXCEPTION(Error, tendCalibration(venue, settings, root_ / "cache", quiet_));
    }
    QVERIFY(fs::file_size(told) > 10);
    QCOMPARE(readFile(venue / calibration::CalibrationFolder::manifestName), manifest);
    {
      const auto folder =
          calibration::CalibrationFolder::open(venue, calibration::CalibrationFolder::Access::read);
      loadCalibration(folder, quiet_);
    }
    disk_.makeRoom();
    const NightRecord next = tendCalibration(venue, settings, root_ / "cache", quiet_);
    QVERIFY2(!isAlarm(next), english(next.alarm).c_str());
    QVERIFY(next.repair == RepairEnd::repaired);
  }
};

int main(int argc, char** argv) {
  enterOwnNetwork();
  const QTemporaryDir folder;
  const fs::path root = folder.path().toStdString();
  constexpr std::uint64_t bytes = 24 << 20;
  SmallDisk disk(root / "disk", bytes);
  QCoreApplication application(argc, argv);
  TestNightDisk test(root, disk);
  return QTest::qExec(&test, argc, argv);
}
#include "test_night_disk.moc"
