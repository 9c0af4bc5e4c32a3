// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>
#include <fstream>
#include <iterator>

#include "relucent/platform/files.h"
#include "relucent/platform/folder_lock.h"
#include "relucent/platform/interruption_signals.h"
#include "relucent/platform/process.h"
#include "relucent/platform/shell.h"
#include "relucent/platform/system_description.h"

using namespace relucent;
using namespace relucent::platform;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

std::string contentOf(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::error_code lockFailure(const fs::path& folder, FolderLock::Kind kind) {
  try {
    FolderLock lock(folder, kind);
    return {};
  } catch (const std::system_error& failure) {
    return failure.code();
  }
}

int interruptions = 0;
void countInterruption() {
  ++interruptions;
}

}  // namespace

class TestPlatform : public QObject {
  Q_OBJECT

  QTemporaryDir place_;
  fs::path folder() const { return place_.path().toStdString(); }

 private slots:
  void whatIsWrittenIsThere() {
    const fs::path file = folder() / "file";
    QVERIFY(!writeContent(file, "a longer text").code);
    QVERIFY(!writeContent(file, "a text").code);
    QCOMPARE(contentOf(file), std::string("a text"));
    QVERIFY(!appendContent(file, " and more").code);
    QCOMPARE(contentOf(file), std::string("a text and more"));
    QVERIFY(!appendContent(folder() / "new", "begun").code);
    QCOMPARE(contentOf(folder() / "new"), std::string("begun"));
    QVERIFY(!syncFile(file).code);
    QVERIFY(!syncFolder(folder()).code);
  }

  void whatCannotBeOpenedIsToldSo() {
    const FileOutcome outcomes[] = {writeContent(folder() / "none" / "file", "text"),
                                    appendContent(folder() / "none" / "file", "text"),
                                    syncFile(folder() / "none"), syncFolder(folder() / "none")};
    for (const FileOutcome& outcome : outcomes) {
      QVERIFY(outcome.code == std::errc::no_such_file_or_directory);
      QVERIFY(!outcome.opened);
    }
  }

  void aFullDiskIsKnown() {
    const FileOutcome outcome = writeContent("/dev/full", "text");
    QVERIFY(outcome.opened);
    QVERIFY(isDiskFull(outcome.code));
    QVERIFY(!isDiskFull(std::make_error_code(std::errc::permission_denied)));
    QVERIFY(!isDiskFull({}));
  }

  /// Law: several readers or one writer.
  void locksExcludeEachOther() {
    using Kind = FolderLock::Kind;
    {
      FolderLock reader(folder(), Kind::read);
      QVERIFY(!lockFailure(folder(), Kind::read));
      QVERIFY(lockFailure(folder(), Kind::write) == std::errc::operation_would_block);
    }
    FolderLock writer(folder(), Kind::write);
    FolderLock moved(std::move(writer));
    QVERIFY(lockFailure(folder(), Kind::read) == std::errc::operation_would_block);
    moved = FolderLock(folder() / "..", Kind::read);
    QVERIFY(!lockFailure(folder(), Kind::write));
    QVERIFY(lockFailure(folder() / "none", Kind::read) == std::errc::no_such_file_or_directory);
  }

  void commandsEndAsTheyEnd_data() {
    QTest::addColumn<QString>("command");
    QTest::addColumn<int>("end");
    QTest::addColumn<int>("status");
    QTest::newRow("well") << "true" << static_cast<int>(ShellResult::End::exited) << 0;
    QTest::newRow("badly") << "exit 7" << static_cast<int>(ShellResult::End::exited) << 7;
    QTest::newRow("killed") << "kill -9 $$" << static_cast<int>(ShellResult::End::killed) << SIGKILL;
  }
  void commandsEndAsTheyEnd() {
    QFETCH(QString, command);
    QFETCH(int, end);
    QFETCH(int, status);
    const ShellResult result = runShell("echo out; echo err >&2; " + command.toStdString(), 60s, 1s);
    QCOMPARE(static_cast<int>(result.end), end);
    QCOMPARE(result.status, status);
    QCOMPARE(result.outputTail, std::string("out\nerr\n"));
  }

  void aCommandThatTakesTooLongIsEnded() {
    const ShellResult result = runShell("echo begun; sleep 600", 200ms, 1s);
    QCOMPARE(static_cast<int>(result.end), static_cast<int>(ShellResult::End::timedOut));
    QCOMPARE(result.outputTail, std::string("begun\n"));
  }

  void interruptionsCallTheHandlerWhileItIsSet() {
    std::signal(SIGHUP, SIG_IGN);
    {
      const InterruptionSignals handled(countInterruption);
      for (int number : {SIGINT, SIGTERM, SIGHUP}) std::raise(number);
      QCOMPARE(interruptions, 3);
    }
    std::raise(SIGHUP);  // ignored, as before
    QCOMPARE(interruptions, 3);
    std::signal(SIGHUP, SIG_DFL);
  }

  void theProgramKnowsItself() {
    QCOMPARE(processNumber(), static_cast<std::uint64_t>(QCoreApplication::applicationPid()));
    QVERIFY(peakMemoryBytes() > 1'000'000);
    QVERIFY(systemDescription().find(" cores\n") != std::string::npos);
  }
};

QTEST_GUILESS_MAIN(TestPlatform)
#include "test_platform.moc"
