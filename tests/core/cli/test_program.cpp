// SPDX-License-Identifier: MIT
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QJsonDocument>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "relucent/base/error.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/cli/interruption.h"

using namespace relucent;
using namespace relucent::cli;

namespace {

struct Run {
  int status = -1;
  QByteArray out, err;
};

Run run(const QStringList& arguments) {
  QProcess process;
  process.start(QString::fromLocal8Bit(qgetenv("RELUCENT_CLI")), arguments);
  if (!process.waitForFinished(60000)) return {};
  return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
}

}  // namespace

/// The program as it is started by people and scripts.
class TestProgram : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QVERIFY2(!qgetenv("RELUCENT_CLI").isEmpty(), "run by ctest, or set RELUCENT_CLI"); }

  void jsonIsOneDocumentAndNothingElse() {
    Run ran = run({"venues", "--json"});
    QCOMPARE(ran.status, 0);
    QCOMPARE(ran.err, QByteArray());
    QJsonParseError error;
    QJsonDocument::fromJson(ran.out, &error);
    QCOMPARE(error.error, QJsonParseError::NoError);
  }

  void statusAndSentence_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("status");
    QTest::addColumn<QByteArray>("says");
    QTest::newRow("wrong usage") << QStringList{"calibrate"} << 2 << QByteArray("CALIBRATION is required");
    QTest::newRow("small") << QStringList{"calibrate", "d", "--projector", "4x4"} << 1
                           << QByteArray("4x4 pixels is impossible");
    QTest::newRow("large") << QStringList{"calibrate", "d", "--camera", "9000x10"} << 1
                           << QByteArray("8 to 8192");
    QTest::newRow("empty") << QStringList{"calibrate", "d", "--camera", "0x0"} << 1
                           << QByteArray("impossible");
    QTest::newRow("command without its file")
        << QStringList{"calibrate",           "d",
                       "--projector-command", "true",
                       "--camera-command",    "shoot {exposure} {output}",
                       "--projector",         "64x48"}
        << 1 << QByteArray("does not contain {image}");
  }
  void statusAndSentence() {
    QFETCH(QStringList, arguments);
    QFETCH(int, status);
    QFETCH(QByteArray, says);
    QTemporaryDir folder;
    if (arguments.size() > 1) arguments[1] = folder.filePath("new");
    for (bool json : {false, true}) {
      Run ran = run(json ? arguments + QStringList{"--json"} : arguments);
      QCOMPARE(ran.status, status);
      QCOMPARE(ran.out, QByteArray());
      QVERIFY2(ran.err.startsWith("relucent-cli: ") && ran.err.contains(says), ran.err);
      QCOMPARE(ran.err.count('\n'), 1);
      QVERIFY(!QFile::exists(folder.filePath("new")));
    }
  }

  void aFullOutputIsAFailure() {
    QProcess process;
    process.setStandardOutputFile("/dev/full");
    process.start(QString::fromLocal8Bit(qgetenv("RELUCENT_CLI")), {"venues"});
    QVERIFY(process.waitForFinished(60000));
    QCOMPARE(process.exitCode(), 1);
    QVERIFY(process.readAllStandardError().contains("standard output"));
  }

  /// On a disk of one megabyte, with either answer to it. Law: in the end the results are those of a disk
  /// with room.
  void aFullDiskPausesOrStops() {
    const QString cli = QString::fromLocal8Bit(qgetenv("RELUCENT_CLI"));
    QTemporaryDir folder;
    const auto inside = [&](const QString& script) {
      QProcess shell;
      QStringList arguments{"-m", "sh", "-euc", script, "sh", cli, folder.path()};
      if (::geteuid() != 0) arguments.prepend("-r");
      shell.start("unshare", arguments);
      if (!shell.waitForStarted() || !shell.waitForFinished(300'000)) return Run{};
      return Run{shell.exitCode(), shell.readAllStandardOutput(), shell.readAllStandardError()};
    };
    const QString mount = "mkdir -p $2/disk; mount -t tmpfs -o size=1m none $2/disk; ";
    if (inside(mount).status != 0) QSKIP("nobody may mount a small disk here (unshare, mount)");
    const QString calibrate =
        "$1 calibrate $2/disk/venue --venue plain --projector 64x48 --camera 120x90 --paths 16 "
        "--cache $2/cache ";

    const Run stopped = inside(mount + calibrate + "--full-disk stop");
    QCOMPARE(stopped.status, 1);
    QVERIFY2(stopped.err.contains("the disk is full; every photograph so far is safe"), stopped.err);

    const Run waited =
        inside(mount + calibrate +
               "2> $2/said & while kill -0 $! && ! grep -q Paused $2/said; do sleep 0.1; done; "
               "mount -o remount,size=300m $2/disk; wait $!; cp -r $2/disk/venue $2/waited");
    QVERIFY2(waited.status == 0, waited.err);
    const Run undisturbed = inside("mkdir -p $2/disk; " + calibrate);
    QCOMPARE(undisturbed.status, 0);
    // Not when each thing happened.
    const Run compared = inside("diff -r -x record.json $2/disk/venue/results $2/waited/results");
    QVERIFY2(compared.status == 0, compared.out + compared.err);
  }

  void theFirstSignalAsksTheSecondEnds_data() {
    QTest::addColumn<int>("signal");
    QTest::newRow("Ctrl-C") << SIGINT;
    QTest::newRow("terminate") << SIGTERM;
  }
  void theFirstSignalAsksTheSecondEnds() {
    QFETCH(int, signal);
    pid_t child = ::fork();
    if (child == 0) {
      Interruption interruption;
      ::raise(signal);
      if (interruption.stop().asked() != StopRequest::Kind::cancel) ::_exit(1);
      ::raise(signal);
      ::_exit(2);
    }
    int status = 0;
    QCOMPARE(::waitpid(child, &status, 0), child);
    QVERIFY(WIFEXITED(status));
    QCOMPARE(WEXITSTATUS(status), 130);
  }

  void afterwardsSignalsAreHandledAsBefore() {
    pid_t child = ::fork();
    if (child == 0) {
      ::signal(SIGTERM, [](int) { ::_exit(42); });
      {
        Interruption interruption;
      }
      ::raise(SIGTERM);
      ::_exit(0);
    }
    int status = 0;
    QCOMPARE(::waitpid(child, &status, 0), child);
    QVERIFY(WIFEXITED(status));
    QCOMPARE(WEXITSTATUS(status), 42);
  }
};

QTEST_GUILESS_MAIN(TestProgram)
#include "test_program.moc"
