// SPDX-License-Identifier: MIT
#include <sys/mount.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QtTest>
#include <fstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "support/sentences.h"

using namespace relucent;
namespace fs = std::filesystem;

namespace {

template <typename Action>
std::string diskSentenceOf(const Action& action) {
  return sentenceOf(action, ErrorKind::disk);
}

std::size_t entriesOf(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// A disk of 64 KiB, where the system lets one be mounted.
class TinyDisk {
 public:
  explicit TinyDisk(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64k") == 0;
  }
  ~TinyDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }
  const fs::path& path() const { return folder_; }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

}  // namespace

class TestFile : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> temporary_;
  fs::path folder() const { return temporary_->path().toStdString(); }

 private slots:
  void init() { temporary_ = std::make_unique<QTemporaryDir>(); }

  void whatIsWrittenIsRead_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::newRow("empty") << QByteArray("");
    QTest::newRow("text") << QByteArray("line\nline\r\n");
    QTest::newRow("zeros") << QByteArray(100000, '\0');
    QTest::newRow("every byte") << [] {
      QByteArray all;
      for (int i = 0; i < 256; ++i) all.append(static_cast<char>(i));
      return all;
    }();
  }
  void whatIsWrittenIsRead() {
    QFETCH(QByteArray, content);
    writeFileAtomically(folder() / "file", content.toStdString());
    QCOMPARE(readFile(folder() / "file"), content.toStdString());
    QCOMPARE(entriesOf(folder()), std::size_t{1});  // no temporary file stays
  }

  void anOldFileIsReplaced() {
    writeFileAtomically(folder() / "file", "a long old content");
    writeFileAtomically(folder() / "file", "new");
    QCOMPARE(readFile(folder() / "file"), std::string("new"));
  }

  void aWriterGetsANameBesideWithTheSameExtension() {
    fs::path seen;
    writeFileAtomically(folder() / "image.exr", [&](const fs::path& temporary) {
      seen = temporary;
      std::ofstream(temporary) << "picture";
    });
    QCOMPARE(seen.parent_path(), folder());
    QCOMPARE(seen.extension(), fs::path(".exr"));
    QVERIFY(seen != folder() / "image.exr" && !fs::exists(seen));
    QCOMPARE(readFile(folder() / "image.exr"), std::string("picture"));
  }

  void aFailingWriterLeavesTheOldFile() {
    writeFileAtomically(folder() / "file", "old");
    QVERIFY_THROWS_EXCEPTION(std::runtime_error,
                             writeFileAtomically(folder() / "file", [](const fs::path& temporary) {
                               std::ofstream(temporary) << "half of the new";
                               throw std::runtime_error("out of ideas");
                             }));
    QCOMPARE(readFile(folder() / "file"), std::string("old"));
    QCOMPARE(entriesOf(folder()), std::size_t{1});
  }

  void aWriterThatWritesNothingIsAnError() {
    writeFileAtomically(folder() / "file", "old");
    QVERIFY(!diskSentenceOf([&] { writeFileAtomically(folder() / "file", [](const fs::path&) {}); }).empty());
    QCOMPARE(readFile(folder() / "file"), std::string("old"));
  }

  void missingAndUnreadableFilesAreNamed() {
    QVERIFY(mentions(diskSentenceOf([&] { readFile(folder() / "missing"); }), "missing: cannot read"));
    QVERIFY(mentions(diskSentenceOf([&] { readFile(folder()); }), "cannot read"));
    QVERIFY(mentions(diskSentenceOf([&] { writeFileAtomically(folder() / "no" / "file", "x"); }), "no/file"));
    QVERIFY(mentions(diskSentenceOf([&] { writeFileAtomically("/proc/relucent/file", "x"); }), "cannot"));
  }

  void aFolderOfTheSameNameStays() {
    fs::create_directories(folder() / "file" / "inside");
    QVERIFY(!diskSentenceOf([&] { writeFileAtomically(folder() / "file", "x"); }).empty());
    QVERIFY(fs::is_directory(folder() / "file" / "inside"));
    QCOMPARE(entriesOf(folder()), std::size_t{1});
  }

  void aFullDiskLeavesTheOldFile() {
    const TinyDisk disk(folder() / "disk");
    if (!disk.mounted()) QSKIP("no file system can be mounted here (that needs root)");
    writeFileAtomically(disk.path() / "file", "old");
    const std::string sentence =
        diskSentenceOf([&] { writeFileAtomically(disk.path() / "file", std::string(1 << 20, 'x')); });
    QVERIFY(mentions(sentence, "disk/file: cannot write (No space left on device); free some space"));
    QCOMPARE(readFile(disk.path() / "file"), std::string("old"));
    QCOMPARE(entriesOf(disk.path()), std::size_t{1});
    writeFileAtomically(disk.path() / "file", "new");  // there is room again
  }

  void aReadOnlyFolderIsExplained() {
    if (::geteuid() == 0) QSKIP("root may write everywhere");
    fs::permissions(folder(), fs::perms::owner_read | fs::perms::owner_exec);
    const std::string sentence = diskSentenceOf([&] { writeFileAtomically(folder() / "file", "x"); });
    fs::permissions(folder(), fs::perms::owner_all);
    QVERIFY(mentions(sentence, "choose a folder that you may write to"));
  }

  void foldersAreCreatedWithTheirParents() {
    createFolder(folder() / "a" / "b");
    createFolder(folder() / "a" / "b");  // twice is no error
    QVERIFY(fs::is_directory(folder() / "a" / "b"));
    writeFileAtomically(folder() / "file", "x");
    QVERIFY(mentions(diskSentenceOf([&] { createFolder(folder() / "file"); }), "cannot create the folder"));
    QVERIFY(mentions(diskSentenceOf([&] { createFolder(folder() / "file" / "c"); }), "Not a directory"));
  }
};

QTEST_GUILESS_MAIN(TestFile)
#include "test_file.moc"
