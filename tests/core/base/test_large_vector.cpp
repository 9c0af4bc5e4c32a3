// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>

#include "relucent/base/large_vector.h"
#include "relucent/platform/memory_limits.h"

using namespace relucent;

namespace {

constexpr std::size_t large = LargeAllocator<int>::large / sizeof(int);

/// Files that this program has mapped and that are gone from every folder.
int mappedScratch(const std::string& folder) {
  std::ifstream maps("/proc/self/maps");
  int count = 0;
  for (std::string line; std::getline(maps, line);)
    count += line.find(folder) != std::string::npos && line.find("(deleted)") != std::string::npos ? 1 : 0;
  return count;
}

}  // namespace

class TestLargeVector : public QObject {
  Q_OBJECT

 private slots:
  void init() { before_ = qgetenv("TMPDIR"); }
  void cleanup() {
    if (before_.isNull())
      qunsetenv("TMPDIR");
    else
      qputenv("TMPDIR", before_);
  }

  void growingKeepsWhatIsThere() {
    LargeVector<int> values;
    for (std::size_t i = 0; i < large + 1000; ++i) values.push_back(static_cast<int>(i));
    for (std::size_t i = 0; i < values.size(); i += 997) QCOMPARE(values[i], static_cast<int>(i));
    LargeVector<int> copy = values;
    QVERIFY(copy == values);
    copy.resize(1000);
    copy.shrink_to_fit();
    QCOMPARE(copy.back(), 999);
  }

  /// Law: much lies in a file, except where the machine has plenty of memory; nobody sees that file.
  void muchLiesInAFileThatNobodySees() {
    QTemporaryDir folder;
    qputenv("TMPDIR", folder.path().toLocal8Bit());
    const std::string path = folder.path().toStdString();
    {
      LargeVector<int> little(large / 2, 1);
      QCOMPARE(mappedScratch(path), 0);
      const bool isInMemory = platform::isPlenty(large * sizeof(int));
      LargeVector<int> much(large, 1);
      QCOMPARE(mappedScratch(path), isInMemory ? 0 : 1);
      QVERIFY(std::filesystem::is_empty(path));
      QCOMPARE(std::accumulate(much.begin(), much.end(), 0), static_cast<int>(large));
    }
    QCOMPARE(mappedScratch(path), 0);
  }

  void withoutADiskItLiesInMemory() {
    qputenv("TMPDIR", "/nowhere/at/all");
    LargeVector<int> much(large, 3);
    QCOMPARE(much.back(), 3);
  }

  void moreThanThereCanBeIsRefused() {
    QVERIFY_THROWS_EXCEPTION(std::bad_alloc, LargeAllocator<int>().allocate(std::size_t{1} << 62));
    QVERIFY_THROWS_EXCEPTION(std::bad_alloc, LargeAllocator<int>().allocate(std::size_t{1} << 58));
  }

 private:
  QByteArray before_;
};

QTEST_MAIN(TestLargeVector)
#include "test_large_vector.moc"
