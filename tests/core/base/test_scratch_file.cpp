// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <numeric>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/scratch_file.h"
#include "support/sentences.h"

using namespace relucent;

class TestScratchFile : public QObject {
  Q_OBJECT

 private slots:
  void init() { before_ = qgetenv("TMPDIR"); }
  void cleanup() {
    if (before_.isNull())
      qunsetenv("TMPDIR");
    else
      qputenv("TMPDIR", before_);
  }

  void whatIsWrittenIsRead() {
    ScratchFile file;
    std::vector<int> values(100000);
    std::iota(values.begin(), values.end(), 1);
    const std::uint64_t far = 5'000'000'000;  // beyond 32 bits, and no disk is filled by it
    file.write(far, std::span<const int>(values));
    std::vector<int> part(10), hole(10, -1), beyond(10, -1);
    file.read(far + 500 * sizeof(int), std::span(part));
    QCOMPARE(part, std::vector<int>(values.begin() + 500, values.begin() + 510));
    file.read(1000, std::span(hole));
    QCOMPARE(hole, std::vector<int>(10, 0));
    file.read(far + values.size() * sizeof(int) - 3 * sizeof(int), std::span(beyond));
    QCOMPARE(beyond, (std::vector<int>{99998, 99999, 100000, 0, 0, 0, 0, 0, 0, 0}));
  }

  void nobodySeesIt() {
    QTemporaryDir folder;
    qputenv("TMPDIR", folder.path().toLocal8Bit());
    ScratchFile file;
    const std::vector<char> values(1000, 'x');
    file.write(0, std::span<const char>(values));
    QVERIFY(std::filesystem::is_empty(folder.path().toStdString()));
  }

  void aMissingFolderIsTold() {
    qputenv("TMPDIR", "/nowhere/at/all");
    const std::string sentence = sentenceOf([] { ScratchFile(); }, ErrorKind::disk);
    QVERIFY2(sentence.find("/nowhere/at/all: there is no room for intermediate results") == 0 &&
                 sentence.find("TMPDIR") != std::string::npos,
             sentence.c_str());
  }

 private:
  QByteArray before_;
};

QTEST_APPLESS_MAIN(TestScratchFile)
#include "test_scratch_file.moc"
