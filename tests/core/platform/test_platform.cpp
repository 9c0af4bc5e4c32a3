// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>
#include <fstream>
#include <iterator>

#include "relucent/platform/child_process.h"
#include "relucent/platform/files.h"
#include "relucent/platform/folder_lock.h"
#include "relucent/platform/interruption_signals.h"
#include "relucent/platform/memory_limits.h"
#include "relucent/platform/memory_peak.h"
#include "relucent/platform/process.h"
#include "relucent/platform/scratch_memory.h"
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

  /// Machines as their files describe them.
  void memoryIsLimitedByTheLeast_data() {
    using Files = std::vector<std::pair<const char*, const char*>>;
    QTest::addColumn<Files>("files");
    QTest::addColumn<quint64>("machine");
    QTest::addColumn<quint64>("group");
    const std::pair memory("proc/meminfo", "MemFree:  9 kB\nMemTotal:  8000000 kB\nCached: 7 kB\n");
    const quint64 whole = 8'192'000'000, none = noMemoryLimit;
    QTest::newRow("nothing known") << Files{} << none << none;
    QTest::newRow("no groups") << Files{memory} << whole << none;
    QTest::newRow("version 2, none set") << Files{memory,
                                                  {"proc/self/cgroup", "0::/user/session\n"},
                                                  {"sys/fs/cgroup/user/session/memory.max", "max\n"}}
                                         << whole << none;
    QTest::newRow("version 2, of the group")
        << Files{memory,
                 {"proc/self/cgroup", "0::/user/session\n"},
                 {"sys/fs/cgroup/user/session/memory.max", "4000000000\n"},
                 {"sys/fs/cgroup/user/memory.max", "max\n"}}
        << whole << quint64{4'000'000'000};
    QTest::newRow("version 2, of one that it is in")
        << Files{memory,
                 {"proc/self/cgroup", "0::/user/session\n"},
                 {"sys/fs/cgroup/user/session/memory.max", "4000000000\n"},
                 {"sys/fs/cgroup/user/memory.max", "3000000000\n"}}
        << whole << quint64{3'000'000'000};
    QTest::newRow("version 2, a container's own")
        << Files{memory, {"proc/self/cgroup", "0::/\n"}, {"sys/fs/cgroup/memory.max", "2000000000\n"}}
        << whole << quint64{2'000'000'000};
    QTest::newRow("version 1")
        << Files{memory,
                 {"proc/self/cgroup", "5:cpu,cpuacct:/a\n4:memory:/job\n1:name=systemd:/b\n"},
                 {"sys/fs/cgroup/memory/job/memory.limit_in_bytes", "1500000000\n"},
                 {"sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n"}}
        << whole << quint64{1'500'000'000};
    QTest::newRow("version 1, in a container")
        << Files{memory,
                 {"proc/self/cgroup", "4:hugetlb,memory:/docker/0123\n"},
                 {"sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000000\n"}}
        << whole << quint64{1'000'000'000};
  }
  void memoryIsLimitedByTheLeast() {
    using Files = std::vector<std::pair<const char*, const char*>>;
    QFETCH(Files, files);
    QFETCH(quint64, machine);
    QFETCH(quint64, group);
    QTemporaryDir root;
    for (const auto& [name, content] : files) {
      const fs::path file = fs::path(root.path().toStdString()) / name;
      fs::create_directories(file.parent_path());
      QVERIFY(!writeContent(file, content).code);
    }
    const MemoryLimits limits = memoryLimits(root.path().toStdString());
    QCOMPARE(quint64{limits.machine}, machine);
    QCOMPARE(quint64{limits.group}, group);
    QCOMPARE(quint64{limits.free}, quint64{0});  // MemFree is another thing
  }
  void memoryThatIsLeft_data() {
    QTest::addColumn<quint64>("machine");
    QTest::addColumn<quint64>("group");
    QTest::addColumn<quint64>("addressSpace");
    QTest::addColumn<quint64>("left");  // with 100 MB in use and 1 GB mapped
    QTest::addColumn<quint64>("leftToMap");
    const quint64 none = noMemoryLimit, mapped = 1'000'000'000 + (quint64{128} << 20);
    QTest::newRow("no limits") << none << none << none << none << none;
    QTest::newRow("the machine") << quint64{10'000'000'000} << none << none << quint64{7'900'000'000} << none;
    QTest::newRow("its group") << quint64{10'000'000'000} << quint64{4'000'000'000} << none
                               << quint64{3'900'000'000} << none;
    QTest::newRow("its address space") << quint64{10'000'000'000} << quint64{4'000'000'000} << mapped + 5
                                       << quint64{3'900'000'000} << quint64{5};
    QTest::newRow("all in use") << quint64{10'000'000'000} << quint64{90'000'000} << mapped - 5 << quint64{0}
                                << quint64{0};
  }
  void memoryThatIsLeft() {
    QFETCH(quint64, machine);
    QFETCH(quint64, group);
    QFETCH(quint64, addressSpace);
    QFETCH(quint64, left);
    QFETCH(quint64, leftToMap);
    const MemoryUse found = memoryLeft({machine, group, addressSpace}, {100'000'000, 1'000'000'000});
    QCOMPARE(quint64{found.resident}, left);
    QCOMPARE(quint64{found.addressSpace}, leftToMap);
  }
  void plentyLeavesHalfAndEightGibibytes_data() {
    QTest::addColumn<quint64>("machine");
    QTest::addColumn<quint64>("free");
    QTest::addColumn<quint64>("group");
    QTest::addColumn<quint64>("most");  // that is plenty with 1 GiB in use; 0: nothing is
    const quint64 none = noMemoryLimit, gibibyte = quint64{1} << 30;
    QTest::newRow("nothing known") << none << quint64{0} << none << quint64{0};
    QTest::newRow("no machine told") << none << 100 * gibibyte << none << quint64{0};
    QTest::newRow("what is free not told") << 64 * gibibyte << quint64{0} << none << quint64{0};
    QTest::newRow("a small machine") << 8 * gibibyte << 7 * gibibyte << none << quint64{0};
    QTest::newRow("a usual one") << 16 * gibibyte << 13 * gibibyte << none << 5 * gibibyte;
    QTest::newRow("others use it") << 16 * gibibyte << 9 * gibibyte << none << gibibyte;
    QTest::newRow("a large one") << 64 * gibibyte << 60 * gibibyte << none << 28 * gibibyte;
    QTest::newRow("a small group") << 64 * gibibyte << 60 * gibibyte << 4 * gibibyte << quint64{0};
    QTest::newRow("a group of half") << 64 * gibibyte << 60 * gibibyte << 32 * gibibyte << 15 * gibibyte;
    QTest::newRow("less free than in use") << 16 * gibibyte << gibibyte << none << quint64{0};
  }
  void plentyLeavesHalfAndEightGibibytes() {
    QFETCH(quint64, machine);
    QFETCH(quint64, free);
    QFETCH(quint64, group);
    QFETCH(quint64, most);
    const MemoryLimits limits{machine, group, noMemoryLimit, free};
    const MemoryUse use{std::uint64_t{1} << 30};
    QCOMPARE(isPlenty(1, limits, use), most > 0);
    if (most > 0) QVERIFY(isPlenty(most, limits, use));
    QVERIFY(!isPlenty(most + 1, limits, use));
    QVERIFY(!isPlenty(noMemoryLimit, limits, use));
  }
  /// Law: memory for what is large is zeros, can be written, and is given back, of either kind.
  void scratchIsZerosAndIsGivenBack() {
    constexpr std::size_t bytes = std::size_t{40} << 20;
    for (void* (*map)(std::size_t) : {&mapScratch, &mapScratchFile}) {
      const MemoryUse before = memoryUse();
      auto* memory = static_cast<char*>(map(bytes));
      QVERIFY(memory != nullptr);
      QCOMPARE(std::count(memory, memory + bytes, '\0'), static_cast<std::ptrdiff_t>(bytes));
      std::fill_n(memory, bytes, 'x');
      QVERIFY(memoryUse().addressSpace >= before.addressSpace + bytes);
      unmapScratch(memory, bytes);
      QVERIFY(memoryUse().addressSpace < before.addressSpace + bytes);
    }
  }

  /// Of this machine: there is some, and this program takes some of it; what lies in files only of its
  /// addresses.
  void memoryOfThisProgramIsKnown() {
    constexpr std::size_t bytes = std::size_t{64} << 20;
    const MemoryUse before = memoryUse();
    const std::vector<char> touched(bytes, 'x');
    const MemoryUse more = memoryUse();
    QVERIFY(more.resident >= before.resident + bytes / 2 && more.addressSpace > more.resident);
    QVERIFY(memoryLimits().machine > more.resident && memoryLimits().machine != noMemoryLimit);
    QVERIFY(memoryLimits().free > bytes && memoryLimits().free < memoryLimits().machine);
    void* scratch = mapScratchFile(bytes);
    QVERIFY(scratch != nullptr);
    std::fill_n(static_cast<char*>(scratch), bytes, touched.back());
    const MemoryUse mapped = memoryUse();
    unmapScratch(scratch, bytes);
    QVERIFY(mapped.resident < more.resident + bytes / 2);
    QVERIFY(mapped.addressSpace >= more.addressSpace + bytes);
  }

  /// Also of memory that is given back before anybody asks.
  void theMostMemoryIsRemembered() {
    constexpr std::size_t bytes = std::size_t{64} << 20;
    MemoryPeak peak(std::chrono::milliseconds(1));
    const MemoryUse before = peak.value();
    {
      const std::vector<char> touched(bytes, 'x');
      QTRY_VERIFY(peak.value().resident >= before.resident + bytes / 2);
    }
    QVERIFY(peak.value().resident >= before.resident + bytes / 2);
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
    const double before = processorSeconds();
    double after = before;
    for (int i = 0; i < 100'000'000 && after - before < 0.01; ++i) after = processorSeconds();
    QVERIFY(before > 0.0 && after - before >= 0.01);
    QVERIFY(systemDescription().find(" cores\n") != std::string::npos);
    QCOMPARE(ownProgram().string(), QCoreApplication::applicationFilePath().toStdString());
  }

  void anotherProgramIsWatchedAndEnded() {
    std::error_code error;
    const auto sh = [&](const char* script, const std::vector<std::string>& environment = {}) {
      return ChildProcess::start("/bin/sh", {"-c", script}, environment, error);
    };
    const auto said = [](ChildProcess& child, const std::string& wanted) {
      std::string all;
      for (int look = 0; look < 500 && all.size() < wanted.size(); ++look) {
        all += child.errors();
        QTest::qSleep(10);
      }
      return all;
    };
    const auto child = sh("echo \"$NAME $TZ\" >&2; exec sleep 600", {"NAME=one", "TZ=UTC"});
    QVERIFY(child != nullptr);
    QCOMPARE(said(*child, "one UTC\n"), std::string("one UTC\n"));
    const std::optional<ProcessUse> use = child->use();
    QVERIFY(use && use->residentBytes >= use->ownBytes && use->ownBytes > 0);
    QVERIFY(use->handles >= 3);
    QCOMPARE(use->threads, 1);
    QVERIFY(!child->ended());
    child->ask();
    QTRY_VERIFY(child->ended());
    QVERIFY(child->ended()->killed && child->ended()->status == SIGTERM && !child->use());
    const auto other = sh("exec sleep 600");
    other->kill();
    QCOMPARE(other->ended()->status, SIGKILL);
    const auto failing = sh("exit 7");
    QTRY_VERIFY(failing->ended());
    QVERIFY(!failing->ended()->killed && failing->ended()->status == 7);
    QVERIFY(ChildProcess::start("/nowhere", {}, {}, error) == nullptr);
    QVERIFY(error == std::errc::no_such_file_or_directory);
  }
};

QTEST_GUILESS_MAIN(TestPlatform)
#include "test_platform.moc"
