// SPDX-License-Identifier: MIT
// The power fails at random instants of a repair.
//   RELUCENT_KILLS      how often, a row; RELUCENT_KILL_SEED  of the instants: for those who have more time
#include <QElapsedTimer>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <map>

#include "relucent/base/file.h"
#include "relucent/base/random.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/repair.h"
#include "support/sanitized.h"

using namespace relucent;
using namespace relucent::pipeline;
using calibration::CalibrationFolder;
namespace fs = std::filesystem;

namespace {

constexpr int longest = 60'000;  // milliseconds
// Of what is killed, milliseconds: from when a repair's files are prepared until they have been stored.
constexpr double longestStoring = 60.0;

std::map<std::string, std::string> filesIn(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = readFile(entry.path());
  return files;
}

std::string correctionOf(const fs::path& calibration) {
  return fingerprintOfCorrection(CalibrationFolder::open(calibration, CalibrationFolder::Access::read));
}

/// A result is being prepared or stored.
bool isBeingStored(const fs::path& calibration) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(calibration / "results", code))
    if (const std::string name = entry.path().filename().string(); name.starts_with('.')) return true;
  return false;
}

}  // namespace

class TestRepairKilled : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path venue() const { return folder_.filePath("venue").toStdString(); }
  QStringList repair() const {
    return {"repair",   QString::fromStdString(venue().string()),
            "--change", "painted:0.4,0.5,0.15",
            "--cache",  folder_.filePath("cache")};
  }

 private slots:
  void initTestCase() {
    if (isSanitized)
      QSKIP("so many runs of the program take long under a sanitizer; what is on disk is the same");
    CalibrateSettings settings;
    venue::VenueSettings corner;
    corner.name = "corner";
    corner.projector = {16, 16};
    corner.camera = {16, 16};
    corner.pathsPerPixel = 16;
    settings.rig = corner;
    settings.linearization.levels = 5;
    Progress quiet;
    calibrate(venue(), settings, folder_.filePath("cache").toStdString(), quiet);
  }

  /// Law: whatever a repair was doing, afterwards there is either the calibration from before, as it was to
  /// the last byte, or the repaired one whole; and in both cases the one from before is still there.
  void theOlderCalibrationStays_data() {
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 2; ++seed) QTest::addRow("seed %d", static_cast<int>(seed)) << seed;
  }
  void theOlderCalibrationStays() {
    QFETCH(quint64, seed);
    const QString program = QCoreApplication::applicationDirPath() + "/relucent-cli";
    const fs::path manifest = venue() / CalibrationFolder::manifestName,
                   former = venue() / "results/acquisition-1";
    const std::map<std::string, std::string> measured = filesIn(former);
    const std::string correction = correctionOf(venue());
    // How long one takes, traced venue included.
    QElapsedTimer clock;
    for (int run = 0; run < 2; ++run) {
      QProcess whole;
      clock.start();
      whole.start(program, repair());
      QVERIFY(whole.waitForFinished(longest));
      QCOMPARE(whole.exitCode(), 0);
      QVERIFY(correctionOf(venue()) != correction);
      undoRepair(venue());
    }
    const auto wholeRun = static_cast<double>(clock.elapsed());

    bool isAsked = false;
    const int asked = qEnvironmentVariableIntValue("RELUCENT_KILLS", &isAsked), wanted = isAsked ? asked : 12;
    const auto more = static_cast<std::uint64_t>(qEnvironmentVariableIntValue("RELUCENT_KILL_SEED"));
    int kills = 0, whileStored = 0, committed = 0;
    Random random{20071028 + more, seed};
    Progress quiet;
    for (int run = 0; kills < wanted; ++run) {
      QVERIFY2(run < 3 * wanted, "the program hardly ever lives to be killed");
      const std::string before = readFile(manifest), formerCorrection = correctionOf(venue());
      QCOMPARE(formerCorrection, correction);
      // Most of them at any time; the others while what was found is stored, or just after.
      const double place = random.uniform(), late = random.uniform();
      const bool anyTime = run % 3 != 0;
      QProcess one;
      QElapsedTimer running, storing;
      running.start();
      one.start(program, repair());
      const auto isTime = [&] {
        if (anyTime) return static_cast<double>(running.elapsed()) >= place * wholeRun;
        if (!storing.isValid() && isBeingStored(venue())) storing.start();
        return storing.isValid() &&
               1e-6 * static_cast<double>(storing.nsecsElapsed()) >= longestStoring * late;
      };
      bool lives = true;
      while (lives && !isTime())
        lives = !one.waitForFinished(anyTime ? 1 : 0) && one.state() != QProcess::NotRunning;
      one.kill();
      one.waitForFinished(longest);
      const bool isKilled = one.exitStatus() == QProcess::CrashExit;
      kills += isKilled;
      whileStored += isKilled && isBeingStored(venue());

      QVERIFY(filesIn(former) == measured);
      const bool isRepaired = correctionOf(venue()) != correction;
      if (!isRepaired) QCOMPARE(readFile(manifest), before);
      loadCalibration(CalibrationFolder::open(venue(), CalibrationFolder::Access::read), quiet);
      committed += isRepaired;
      if (isRepaired) {
        undoRepair(venue());
        QCOMPARE(correctionOf(venue()), correction);
      }
      // Whoever opens it for writing clears away what the killed one left.
      CalibrationFolder::open(venue(), CalibrationFolder::Access::write);
      QVERIFY(!isBeingStored(venue()));
    }
    qInfo("killed %d times, %d of them while a result was stored; %d repairs were whole by then", kills,
          whileStored, committed);
    QVERIFY(whileStored > 0);
    QVERIFY(committed < wanted);
    QProcess last;
    last.start(program, repair());
    QVERIFY(last.waitForFinished(longest));
    QVERIFY(correctionOf(venue()) != correction);
    QVERIFY(filesIn(former) == measured);
    undoRepair(venue());
  }
};

QTEST_GUILESS_MAIN(TestRepairKilled)
#include "test_repair_killed.moc"
