// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/devices/command/shell_command.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

std::string sentenceOf(const std::string& command, std::chrono::milliseconds timeout = 20s) {
  return relucent::sentenceOf([&] { runShellCommand(command, timeout, "camera"); }, ErrorKind::device);
}

}  // namespace

class TestShellCommand : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path file(const char* name) const { return fs::path(folder_.path().toStdString()) / name; }

 private slots:
  void quotedTextIsOneWordToTheShell_data() {
    QTest::addColumn<QString>("text");
    for (const char* text :
         {"plain", "two words", "it's", "$HOME `id` \"x\" \\", "", "*", ";rm", "a\nb", "ä"})
      QTest::newRow(text) << QString::fromUtf8(text);
  }
  void quotedTextIsOneWordToTheShell() {
    QFETCH(QString, text);
    const std::string path = file("word").string();
    runShellCommand("printf '%s|' " + shellQuoted(text.toStdString()) + " > " + shellQuoted(path), 20s,
                    "shell");
    QCOMPARE(readFile(path), text.toStdString() + "|");
  }

  void onlyKnownNamesAreReplaced_data() {
    QTest::addColumn<QString>("command");
    QTest::addColumn<QString>("expected");
    QTest::newRow("one") << "show {image}"
                         << "show /tmp/a.png";
    QTest::newRow("twice") << "{image}{image}"
                           << "/tmp/a.png/tmp/a.png";
    QTest::newRow("quoted") << "x {name} y"
                            << "x 'a b' y";
    QTest::newRow("shell braces") << "${HOME} {print} {image}"
                                  << "${HOME} {print} /tmp/a.png";
    QTest::newRow("nested") << "{{image}}"
                            << "{/tmp/a.png}";
    QTest::newRow("unfinished") << "awk '{' {image"
                                << "awk '{' {image";
    QTest::newRow("empty") << ""
                           << "";
  }
  void onlyKnownNamesAreReplaced() {
    QFETCH(QString, command);
    QFETCH(QString, expected);
    QCOMPARE(QString::fromStdString(
                 substituted(command.toStdString(), {{"image", "/tmp/a.png"}, {"name", "a b"}})),
             expected);
  }

  void successIsSilent() { QCOMPARE(sentenceOf("echo words; echo more >&2; exit 0"), std::string()); }

  void failureQuotesTheLastLine_data() {
    QTest::addColumn<QString>("command");
    QTest::addColumn<QString>("part");
    QTest::newRow("error output") << "echo first >&2; echo 'No camera found' >&2; exit 3"
                                  << "camera: the command failed with status 3, saying \"No camera found\";";
    QTest::newRow("output") << "echo Busy; echo; exit 1"
                            << "status 1, saying \"Busy\";";
    QTest::newRow("no words") << "exit 7"
                              << "the command failed with status 7; run it";
    QTest::newRow("unknown program") << "no-such-program-here"
                                     << "status 127, saying \"sh: 1: no-such-program";
    QTest::newRow("killed") << "kill -9 $$"
                            << "was killed by signal 9;";
    QTest::newRow("many words") << "head -c 1000000 /dev/zero | tr '\\0' x; exit 1"
                                << "xxx...\"";
  }
  void failureQuotesTheLastLine() {
    QFETCH(QString, command);
    QFETCH(QString, part);
    const std::string sentence = sentenceOf(command.toStdString());
    if (QTest::currentDataTag() == std::string("unknown program")) {
      QVERIFY(mentions(sentence, "status 127"));  // the wording is the shell's
      QVERIFY(mentions(sentence, "no-such-program-here"));
    } else {
      QVERIFY(mentions(sentence, part.toStdString()));
    }
    QVERIFY(sentence.size() < 1000);
  }

  void tooSlowIsEnded_data() {
    QTest::addColumn<QString>("prefix");
    QTest::newRow("obedient") << "";
    QTest::newRow("deaf") << "trap '' TERM; ";
  }
  void tooSlowIsEnded() {
    QFETCH(QString, prefix);
    const std::string pids = file("pids").string();
    fs::remove(pids);
    // The shell and a program that it started: both must be gone.
    const std::string command = prefix.toStdString() + "echo warming up; echo $$ > " + pids +
                                "; sleep 30 & echo $! >> " + pids + "; wait";
    QElapsedTimer timer;
    timer.start();
    const std::string sentence = sentenceOf(command, 200ms);
    QVERIFY(mentions(sentence, "took longer than 0.2 s, saying \"warming up\""));
    QVERIFY(timer.elapsed() < 10000);  // not the 30 s of the sleep

    std::istringstream numbers(readFile(pids));
    int ended = 0;
    for (pid_t process = 0; numbers >> process; ++ended)
      QTRY_VERIFY2(::kill(process, 0) != 0 || isZombie(process), qPrintable(QString::number(process)));
    QCOMPARE(ended, 2);
  }

  void whatRunsInTheBackgroundIsLeftAlone() {
    // The command's end counts, not that of the viewer that it leaves behind and that holds its output open.
    const std::string pid = file("viewer").string();
    QElapsedTimer timer;
    timer.start();
    QCOMPARE(sentenceOf("sleep 20 & echo $! > " + pid), std::string());
    QVERIFY(timer.elapsed() < 10000);
    const pid_t viewer = std::stoi(readFile(pid));
    QCOMPARE(::kill(viewer, 0), 0);
    ::kill(viewer, SIGKILL);
  }

  void standardInputIsEmpty() { QCOMPARE(sentenceOf("read line; test -z \"$line\""), std::string()); }

 private:
  /// In a container nobody may be there to bury an orphan.
  static bool isZombie(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string content((std::istreambuf_iterator<char>(status)), {});
    return content.find(") Z ") != std::string::npos;
  }
};

QTEST_GUILESS_MAIN(TestShellCommand)
#include "test_shell_command.moc"
