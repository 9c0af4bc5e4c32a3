// SPDX-License-Identifier: MIT
#include <sys/wait.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/json.h"

using namespace relucent;
using namespace relucent::calibration;
namespace fs = std::filesystem;
using Access = CalibrationFolder::Access;

namespace {

/// The sentence of the Error that `action` throws; empty if it throws none.
template <typename Action>
std::string sentenceOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

template <typename Action>
std::optional<ErrorKind> kindOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.kind();
  }
  return std::nullopt;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

class TestCalibrationFolder : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir temporary_;
  fs::path root_;

 private slots:
  void init() {
    temporary_ = QTemporaryDir();
    root_ = temporary_.path().toStdString();
  }

  void whatIsCreatedIsOpened() {
    {
      CalibrationFolder made =
          CalibrationFolder::create(root_ / "a/new", {{"venue", "corner"}}, {{"levels", 33}});
      QVERIFY(made.software().starts_with("Relucent "));
    }
    CalibrationFolder read = CalibrationFolder::open(root_ / "a/new", Access::read);
    QVERIFY(read.rig() == Json({{"venue", "corner"}}));
    QVERIFY(read.settings() == Json({{"levels", 33}}));
    QCOMPARE(read.created().size(), std::string("2000-01-01T00:00:00Z").size());
    QVERIFY(!read.latest(Stage::linearization));
    // The manifest itself can be named too, as a file dialog does.
    CalibrationFolder byManifest =
        CalibrationFolder::open(root_ / "a/new/calibration.relucent", Access::read);
    QCOMPARE(byManifest.path(), read.path());
  }

  /// Law: taken as current, the newest result is found by these inputs; where there is none, nothing is.
  void theNewestResultIsTakenAsCurrent() {
    CalibrationFolder folder = CalibrationFolder::create(root_ / "a", {}, {});
    folder.takeAsCurrent(Stage::linearization, "now");
    QVERIFY(!folder.isCurrent(Stage::linearization, "now"));
    folder.store(Stage::linearization, "first", {{"n", 1}});
    folder.store(Stage::linearization, "second", {{"n", 2}});
    folder.takeAsCurrent(Stage::linearization, "now");
    QCOMPARE(folder.find(Stage::linearization, "now")->values->at("n").get<int>(), 2);
    QVERIFY(folder.isCurrent(Stage::linearization, "first"));
    QVERIFY(!folder.isCurrent(Stage::linearization, "second"));
  }

  void createRefusesWhatIsThere() {
    {
      CalibrationFolder::create(root_ / "taken", {}, {});
    }
    std::string manifest = readFile(root_ / "taken/calibration.relucent");
    std::string sentence = sentenceOf([&] { CalibrationFolder::create(root_ / "taken", {}, {}); });
    QVERIFY2(contains(sentence, "resume") && contains(sentence, "another name"), sentence.c_str());
    QCOMPARE(readFile(root_ / "taken/calibration.relucent"), manifest);

    createFolder(root_ / "photos");
    writeFileAtomically(root_ / "photos/holiday.jpg", "x");
    sentence = sentenceOf([&] { CalibrationFolder::create(root_ / "photos", {}, {}); });
    QVERIFY2(contains(sentence, "empty folder"), sentence.c_str());
    QVERIFY(!fs::exists(root_ / "photos/calibration.relucent"));

    sentence = sentenceOf([&] { CalibrationFolder::create(root_ / "photos/holiday.jpg", {}, {}); });
    QVERIFY2(contains(sentence, "another name"), sentence.c_str());
    QCOMPARE(readFile(root_ / "photos/holiday.jpg"), std::string("x"));
  }

  void createAcceptsAnEmptyFolder() {
    createFolder(root_ / "empty");
    // What a program that died while creating left behind does not count.
    writeFileAtomically(root_ / "empty/.calibration.part17.relucent", "{");
    CalibrationFolder::create(root_ / "empty", {}, {});
    QVERIFY(fs::exists(root_ / "empty/calibration.relucent"));
  }

  /// Law: what a stranger's calibration names lies within it.
  void nothingLeavesTheFolder_data() {
    QTest::addColumn<QString>("folder");
    QTest::addColumn<QString>("file");
    QTest::addColumn<bool>("opens");
    QTest::newRow("within") << "acquisition-1"
                            << "transport.npz" << true;
    QTest::newRow("without files") << ""
                                   << "" << true;
    QTest::newRow("above") << "../../home"
                           << "transport.npz" << false;
    QTest::newRow("its own parent") << ".."
                                    << "transport.npz" << false;
    QTest::newRow("elsewhere") << "/etc"
                               << "passwd" << false;
    QTest::newRow("deeper") << "acquisition-1/more"
                            << "transport.npz" << false;
    QTest::newRow("a file above") << "acquisition-1"
                                  << "../../../.ssh/id" << false;
    QTest::newRow("a file elsewhere") << "acquisition-1"
                                      << "/etc/passwd" << false;
    QTest::newRow("cut short") << "acquisition-1" << QString::fromUtf8("a\0b", 3) << false;
  }
  void nothingLeavesTheFolder() {
    QFETCH(QString, folder);
    QFETCH(QString, file);
    QFETCH(bool, opens);
    Json files = Json::object();
    if (!file.isEmpty()) files[file.toStdString()] = 1;
    const Json entry{{"inputs", "x"},
                     {"stored", ""},
                     {"folder", folder.toStdString()},
                     {"values", Json::object()},
                     {"files", files}};
    const Json manifest{{"format", "relucent calibration"},
                        {"version", 1},
                        {"software", ""},
                        {"created", ""},
                        {"rig", Json::object()},
                        {"settings", Json::object()},
                        {"results", {{"acquisition", Json::array({entry})}}}};
    createFolder(root_ / "c");
    writeFileAtomically(root_ / "c/calibration.relucent", manifest.dump());
    const auto open = [&] { CalibrationFolder::open(root_ / "c", Access::read); };
    if (opens) return open();
    QCOMPARE(kindOf(open), std::optional(ErrorKind::format));
  }

  void openRefuses_data() {
    QTest::addColumn<QByteArray>("manifest");
    QTest::addColumn<int>("kind");
    QTest::addColumn<QByteArray>("says");
    auto format = static_cast<int>(ErrorKind::format);
    QTest::newRow("no manifest") << QByteArray() << static_cast<int>(ErrorKind::input)
                                 << QByteArray("not a calibration");
    QTest::newRow("text") << QByteArray("hello") << format << QByteArray("damaged");
    QTest::newRow("zeros") << QByteArray(64, '\0') << format << QByteArray("damaged");
    QTest::newRow("list") << QByteArray("[1]") << format << QByteArray("damaged");
    QTest::newRow("foreign") << QByteArray(R"({"format":"photo album"})") << format
                             << QByteArray("not a calibration");
    QTest::newRow("newer") << QByteArray(R"({"format":"relucent calibration","version":2})") << format
                           << QByteArray("newer");
    QTest::newRow("no version") << QByteArray(R"({"format":"relucent calibration"})") << format
                                << QByteArray("damaged");
    QTest::newRow("wrong types")
        << QByteArray(R"({"format":"relucent calibration","version":1,"software":1,"created":"","rig":{},)"
                      R"("settings":{},"results":{}})")
        << format << QByteArray("damaged");
    QTest::newRow("bad result")
        << QByteArray(R"({"format":"relucent calibration","version":1,"software":"","created":"","rig":{},)"
                      R"("settings":{},"results":{"acquisition":[{"inputs":"x","files":{"a":-1}}]}})")
        << format << QByteArray("damaged");
  }
  void openRefuses() {
    QFETCH(QByteArray, manifest);
    QFETCH(int, kind);
    QFETCH(QByteArray, says);
    createFolder(root_ / "c");
    if (!manifest.isEmpty()) writeFileAtomically(root_ / "c/calibration.relucent", manifest.toStdString());
    auto open = [&] { CalibrationFolder::open(root_ / "c", Access::read); };
    QCOMPARE(static_cast<int>(kindOf(open).value_or(ErrorKind::numerics)), kind);
    QVERIFY2(contains(sentenceOf(open), says.toStdString()), sentenceOf(open).c_str());
    QVERIFY2(contains(sentenceOf(open), (root_ / "c").string()), sentenceOf(open).c_str());
  }

  void openSaysThatAFolderIsMissing() {
    std::string sentence = sentenceOf([&] { CalibrationFolder::open(root_ / "nowhere", Access::read); });
    QVERIFY2(contains(sentence, "no such calibration"), sentence.c_str());
    QVERIFY(!fs::exists(root_ / "nowhere"));
  }

  void everyTruncationIsAnErrorAndNothingElse() {
    {
      CalibrationFolder folder =
          CalibrationFolder::create(root_ / "c", {{"venue", "corner"}}, Json::object());
      folder.store(Stage::linearization, "f1", {{"x", 1.5}});
    }
    fs::path manifest = root_ / "c/calibration.relucent";
    std::string whole = readFile(manifest);
    // The last byte is the line end after the document.
    for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
      std::ofstream(manifest, std::ios::binary) << whole.substr(0, length);
      QVERIFY2(kindOf([&] { CalibrationFolder::open(root_ / "c", Access::read); }) == ErrorKind::format,
               std::to_string(length).c_str());
    }
  }

  void writersAreAloneReadersAreMany() {
    {
      CalibrationFolder writer = CalibrationFolder::create(root_ / "c", {}, {});
      std::string sentence = sentenceOf([&] { CalibrationFolder::open(root_ / "c", Access::read); });
      QVERIFY2(contains(sentence, "another program"), sentence.c_str());
      QVERIFY(kindOf([&] { CalibrationFolder::open(root_ / "c", Access::write); }) == ErrorKind::input);
    }
    CalibrationFolder one = CalibrationFolder::open(root_ / "c", Access::read);
    CalibrationFolder two = CalibrationFolder::open(root_ / "c", Access::read);
    QVERIFY(kindOf([&] { CalibrationFolder::open(root_ / "c", Access::write); }) == ErrorKind::input);
  }

  void theLockOfADeadProgramIsGone() {
    pid_t child = ::fork();
    if (child == 0) {
      auto* folder = new CalibrationFolder(CalibrationFolder::create(root_ / "c", {}, {}));
      ::_exit(folder == nullptr ? 1 : 0);  // no destructor runs, as when a program is killed
    }
    int status = 0;
    QCOMPARE(::waitpid(child, &status, 0), child);
    CalibrationFolder::open(root_ / "c", Access::write);
  }

  void aReaderCannotStore() {
    {
      CalibrationFolder::create(root_ / "c", {}, {});
    }
    CalibrationFolder folder = CalibrationFolder::open(root_ / "c", Access::read);
    QVERIFY_EXCEPTION_THROWN(folder.store(Stage::threshold, "f", {}), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(folder.setSettings({}), std::logic_error);
  }

  void resultsAreKeptAndBecomeStaleAndCurrentAgain() {
    {
      CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {{"threshold", 1}});
      QVERIFY(!folder.isCurrent(Stage::acquisition, "f1"));
      QVERIFY(!folder.latest(Stage::acquisition));
      folder.store(Stage::acquisition, "f1", {{"patterns", 805}},
                   [](const fs::path& in) { writeFileAtomically(in / "transport.npz", "first"); });
      QVERIFY(folder.isCurrent(Stage::acquisition, "f1"));
      QVERIFY(folder.latest(Stage::acquisition) && !folder.isCurrent(Stage::acquisition, "f2"));
      folder.setSettings({{"threshold", 2}});
      folder.store(Stage::acquisition, "f2", {{"patterns", 9}},
                   [](const fs::path& in) { writeFileAtomically(in / "transport.npz", "second one"); });
    }
    CalibrationFolder folder = CalibrationFolder::open(root_ / "c", Access::read);
    QVERIFY(folder.settings() == Json({{"threshold", 2}}));
    QVERIFY(folder.isCurrent(Stage::acquisition, "f1"));
    QVERIFY(folder.isCurrent(Stage::acquisition, "f2"));
    QVERIFY(folder.latest(Stage::acquisition) && !folder.isCurrent(Stage::acquisition, "f3"));
    QCOMPARE(readFile(fileOf(*folder.find(Stage::acquisition, "f1"), "transport.npz")), std::string("first"));
    QCOMPARE(readFile(fileOf(*folder.latest(Stage::acquisition), "transport.npz")),
             std::string("second one"));
    QCOMPARE(folder.find(Stage::acquisition, "f1")->values->at("patterns").get<int>(), 805);
  }

  void aNewerResultForTheSameInputsWins() {
    CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {});
    folder.store(Stage::acquisition, "f", {{"levels", 5}},
                 [](const fs::path& in) { writeFileAtomically(in / "t", "1"); });
    folder.store(Stage::acquisition, "f", {{"levels", 9}},
                 [](const fs::path& in) { writeFileAtomically(in / "t", "2"); });
    QCOMPARE(folder.find(Stage::acquisition, "f")->values->at("levels").get<int>(), 9);
    QCOMPARE(readFile(fileOf(*folder.find(Stage::acquisition, "f"), "t")), std::string("2"));
  }

  /// What is set aside is as if it had never been: the one before is found, and then none.
  void aResultThatIsSetAsideIsNotFound() {
    CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {});
    folder.setLatestAside(Stage::acquisition);  // nothing happens
    for (int n : {1, 2}) folder.store(Stage::acquisition, "f", {{"n", n}});
    folder.store(Stage::threshold, "f", {{"n", 3}});
    for (int n : {2, 1}) {
      QCOMPARE(folder.find(Stage::acquisition, "f")->values->at("n").get<int>(), n);
      folder.setLatestAside(Stage::acquisition);
    }
    QVERIFY(!folder.find(Stage::acquisition, "f") && !folder.latest(Stage::acquisition));
    QVERIFY(folder.find(Stage::threshold, "f"));
    folder.store(Stage::acquisition, "f", {{"n", 4}});
    QCOMPARE(folder.latest(Stage::acquisition)->values->at("n").get<int>(), 4);
  }

  void numbersSurviveToTheLastBit() {
    std::vector<double> numbers{0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.5e-17};
    {
      CalibrationFolder::create(root_ / "c", {}, {}).store(Stage::threshold, "f", {{"numbers", numbers}});
    }
    CalibrationFolder folder = CalibrationFolder::open(root_ / "c", Access::read);
    QCOMPARE(folder.latest(Stage::threshold)->values->at("numbers").get<std::vector<double>>(), numbers);
  }

  void aFailedStoreLeavesEverythingAsItWas() {
    CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {});
    folder.store(Stage::threshold, "f1", {},
                 [](const fs::path& in) { writeFileAtomically(in / "a", "good"); });
    std::string manifest = readFile(root_ / "c/calibration.relucent");
    auto fail = [](const fs::path& in) {
      writeFileAtomically(in / "a", "half");
      throw Error(ErrorKind::disk, Message::plain("the disk is full"), Message::plain("free some space"));
    };
    QVERIFY(kindOf([&] { folder.store(Stage::threshold, "f2", {}, fail); }) == ErrorKind::disk);
    QCOMPARE(readFile(root_ / "c/calibration.relucent"), manifest);
    QCOMPARE(std::distance(fs::directory_iterator(root_ / "c/results"), fs::directory_iterator()), 1);
    QVERIFY(folder.latest(Stage::threshold) && !folder.isCurrent(Stage::threshold, "f2"));
    folder.store(Stage::threshold, "f2", {},
                 [](const fs::path& in) { writeFileAtomically(in / "a", "again"); });
    QCOMPARE(readFile(fileOf(*folder.latest(Stage::threshold), "a")), std::string("again"));
  }

  void leftoversAreClearedAwayAndNothingElse() {
    {
      CalibrationFolder::create(root_ / "c", {}, {});
    }
    createFolder(root_ / "c/results/.acquisition-1.part");
    writeFileAtomically(root_ / "c/results/.acquisition-1.part/transport.npz", "half");
    writeFileAtomically(root_ / "c/.parts-list", "the technician's own");
    writeFileAtomically(root_ / "c/notes.txt", "the technician's own");
    CalibrationFolder::open(root_ / "c", Access::write);
    QVERIFY(!fs::exists(root_ / "c/results/.acquisition-1.part"));
    QVERIFY(fs::exists(root_ / "c/.parts-list"));
    QVERIFY(fs::exists(root_ / "c/notes.txt"));
  }

  /// Law: killed between a result's folder and its entry, the next one takes its place, as if nothing had
  /// been killed; a result that has an entry keeps its own.
  void aFolderWithoutAnEntryIsReplaced() {
    CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {});
    const auto storing = [&](const std::string& inputs, const std::string& content) {
      return folder.store(Stage::threshold, inputs, {},
                          [&](const fs::path& in) { writeFileAtomically(in / "a", content); });
    };
    createFolder(root_ / "c/results/threshold-1");
    writeFileAtomically(root_ / "c/results/threshold-1/a", "killed");
    writeFileAtomically(root_ / "c/results/threshold-1/b", "killed");
    const StageResult first = storing("f1", "first");
    QCOMPARE(first.folder, root_ / "c/results/threshold-1");
    QVERIFY(!fs::exists(first.folder / "b"));
    createFolder(root_ / "c/results/threshold-2");
    const StageResult second = storing("f2", "second");
    QCOMPARE(second.folder, root_ / "c/results/threshold-2");
    QCOMPARE(readFile(fileOf(first, "a")), std::string("first"));
    QCOMPARE(readFile(fileOf(second, "a")), std::string("second"));
  }

  void filesThatChangedAreFound() {
    CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {});
    StageResult result = folder.store(Stage::threshold, "f", {}, [](const fs::path& in) {
      writeFileAtomically(in / "transport.npz", "12345");
    });
    writeFileAtomically(result.folder / "transport.npz", "123");
    std::string sentence = sentenceOf([&] { fileOf(result, "transport.npz"); });
    QVERIFY2(contains(sentence, "3 bytes instead of 5"), sentence.c_str());
    fs::remove(result.folder / "transport.npz");
    sentence = sentenceOf([&] { fileOf(result, "transport.npz"); });
    QVERIFY2(contains(sentence, "missing"), sentence.c_str());
  }
};

QTEST_APPLESS_MAIN(TestCalibrationFolder)
#include "test_calibration_folder.moc"
