// SPDX-License-Identifier: MIT
#include "relucent/calibration/prepared_files.h"

#include <sys/wait.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/leftovers.h"

using namespace relucent;
using namespace relucent::calibration;
namespace fs = std::filesystem;
using Access = CalibrationFolder::Access;

class TestPreparedFiles : public QObject {
  Q_OBJECT

  std::optional<QTemporaryDir> temporary_;
  fs::path venue_;

  std::size_t entriesInResults() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(venue_ / "results"), fs::directory_iterator()));
  }
  bool isListed(const fs::path& folder) const {
    const auto found = leftovers(CalibrationFolder::open(venue_, Access::read));
    return std::ranges::find(found, folder) != found.end();
  }

 private slots:
  void init() {
    venue_ = fs::path(temporary_.emplace().path().toStdString()) / "venue";
    CalibrationFolder::create(venue_, {}, {});
  }

  /// Law: while it is decided, whoever reads or writes the calibration leaves them alone; what is not taken
  /// goes with them.
  void whoeverPreparesIsNotDisturbed() {
    fs::path first, second;
    {
      const PreparedFiles one(venue_), other(venue_);
      first = one.folder();
      second = other.folder();
      QVERIFY(first != second);
      writeFileAtomically(one.folder() / "a", "1");
      CalibrationFolder::open(venue_, Access::write);
      QVERIFY(!isListed(first) && !isListed(second));
      QCOMPARE(readFile(first / "a"), std::string("1"));
      QVERIFY(isBeingPrepared(first) && isBeingPrepared(second));
    }
    QVERIFY(!fs::exists(first) && !fs::exists(second));
  }

  /// Law: they become a result's files in the step that stores it.
  void theyBecomeAResult() {
    const PreparedFiles files(venue_);
    writeFileAtomically(files.folder() / "a", "1");
    writeFileAtomically(files.folder() / "b", "22");
    CalibrationFolder folder = CalibrationFolder::open(venue_, Access::write);
    const StageResult stored =
        folder.store(Stage::threshold, "f", {}, [&](const fs::path& in) { files.moveTo(in); });
    QCOMPARE(stored.files.size(), std::size_t{2});
    QCOMPARE(readFile(fileOf(stored, "a")), std::string("1"));
    QCOMPARE(readFile(fileOf(stored, "b")), std::string("22"));
    QVERIFY(fs::is_empty(files.folder()));
  }

  /// Law: what cannot be moved is an error, and no result.
  void whatIsGoneIsNoResult() {
    const PreparedFiles files(venue_);
    writeFileAtomically(files.folder() / "a", "1");
    CalibrationFolder folder = CalibrationFolder::open(venue_, Access::write);
    fs::remove_all(files.folder());
    QVERIFY_THROWS_EXCEPTION(
        Error, folder.store(Stage::threshold, "f", {}, [&](const fs::path& in) { files.moveTo(in); }));
    QVERIFY(!folder.latest(Stage::threshold));
  }

  /// Law: of a program that died the next one that opens the calibration clears them away.
  void aDeadProgramsAreCleared() {
    const pid_t child = fork();
    QVERIFY(child >= 0);
    if (child == 0) {
      const PreparedFiles files(venue_);
      writeFileAtomically(files.folder() / "a", "1");
      _exit(0);  // as if it were killed: nothing is destroyed
    }
    int status = 0;
    QCOMPARE(waitpid(child, &status, 0), child);
    QCOMPARE(status, 0);
    QCOMPARE(entriesInResults(), std::size_t{1});
    const fs::path left = fs::directory_iterator(venue_ / "results")->path();
    QVERIFY(!isBeingPrepared(left));
    QVERIFY(isListed(left));
    CalibrationFolder::open(venue_, Access::write);
    QCOMPARE(entriesInResults(), std::size_t{0});
  }
};

QTEST_APPLESS_MAIN(TestPreparedFiles)
#include "test_prepared_files.moc"
