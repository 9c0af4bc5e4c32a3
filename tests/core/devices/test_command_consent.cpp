// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/devices/command/command_projector.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
namespace fs = std::filesystem;

class TestCommandConsent : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path file(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }
  /// As if a program was started.
  void start(std::function<bool(const std::string&)> isNamed = {}) const {
    askForConsent({file("kept/commands"), std::move(isNamed), Message::plain("agree to it")});
  }
  /// A camera that leaves a trace when it is run.
  std::string tracing() const { return "touch " + file("trace").string() + " && : {exposure} {output}"; }
  static std::unique_ptr<rig::Camera> open(const std::string& command, std::optional<Size> size = {}) {
    return cameraRegistry().open({"command", command}, {size, {1e-3, 1.0}});
  }

 private slots:
  void cleanup() {
    askForNoConsent();
    fs::remove_all(file("kept"));
    fs::remove(file("trace"));
  }

  void whoAsksForNothingRunsAll() {
    QVERIFY(withoutConsent({"a", "b"}).empty());
    requireConsent("rm -rf /nowhere");
  }

  /// Law: without consent nothing is run, whichever way the device is opened, and the command is in the
  /// sentence.
  void nothingRunsUnasked() {
    start();
    const std::string said = sentenceOf([&] { open(tracing()); }, ErrorKind::usage);
    QVERIFY2(QString::fromStdString(said).contains("nobody at this computer has agreed"), said.c_str());
    QVERIFY(said.find(tracing()) != std::string::npos && said.find("agree to it") != std::string::npos);
    QVERIFY(!fs::exists(file("trace")));
    QVERIFY(!sentenceOf([&] { open(tracing(), Size{4, 3}); }, ErrorKind::usage).empty());
    CommandProjectorSettings projector;
    projector.command = "touch " + file("trace").string() + " {image}";
    projector.size = {4, 3};
    QVERIFY(!sentenceOf([&] { CommandProjector shown(projector); }, ErrorKind::usage).empty());
    QCOMPARE(withoutConsent({tracing(), projector.command, tracing()}),
             (std::vector<std::string>{tracing(), projector.command}));
  }

  /// Law: what was agreed to once is run by every program of the same user from then on, and nothing else is.
  void consentIsKept() {
    const std::string hostile = "a {exposure}\nb \\n {output}";
    start();
    giveConsent({tracing(), hostile});
    for (int program = 0; program < 2; ++program) {
      QVERIFY(withoutConsent({tracing(), hostile}).empty());
      QCOMPARE(withoutConsent({"a {exposure}", "b \\n {output}", "a {exposure}\\nb \\\\n {output}"}).size(),
               3u);
      open(tracing(), Size{4, 3});
      start();
    }
    // What another program wrote meanwhile counts, and is not lost by what is agreed to here.
    std::ofstream(file("kept/commands"), std::ios::app) << "written elsewhere\n";
    giveConsent({"one more"});
    start();
    QVERIFY(withoutConsent({"written elsewhere", "one more", tracing()}).empty());
  }

  void whoNamesItAgrees() {
    start([](const std::string& command) { return command == "shoot {exposure} {output}"; });
    QCOMPARE(withoutConsent({"shoot {exposure} {output}", "other"}), std::vector<std::string>{"other"});
    QVERIFY(!fs::exists(file("kept/commands")));
    requireConsent("shoot {exposure} {output}");
    start();
    requireConsent("shoot {exposure} {output}");
  }

  /// Law: a program by a path of its own is another one in another folder.
  void relativeProgramsBelongToTheirFolder_data() {
    QTest::addColumn<QString>("command");
    QTest::addColumn<bool>("moves");
    QTest::newRow("beside it") << "./photograph {exposure} {output}" << true;
    QTest::newRow("within") << "scripts/photograph {exposure} {output}" << true;
    QTest::newRow("as an argument") << "sh ../photograph {exposure} {output}" << true;
    QTest::newRow("installed") << "photograph {exposure} {output}" << false;
    QTest::newRow("by its whole path") << "/opt/photograph --to {output} {exposure}" << false;
  }
  void relativeProgramsBelongToTheirFolder() {
    QFETCH(QString, command);
    QFETCH(bool, moves);
    start();
    const fs::path here = fs::current_path();
    giveConsent({command.toStdString()});
    fs::current_path(fs::path(folder_.path().toStdString()));
    const bool lacks = !withoutConsent({command.toStdString()}).empty();
    fs::current_path(here);
    QCOMPARE(lacks, moves);
    QVERIFY(withoutConsent({command.toStdString()}).empty());
  }

  /// What cannot be kept holds until the program ends.
  void whereNothingCanBeKept() {
    std::ofstream(file("blocked")) << "a file, no folder";
    askForConsent({file("blocked") / "commands", {}, {}});
    QVERIFY(!sentenceOf([] { giveConsent({"a"}); }, ErrorKind::disk).empty());
    QVERIFY(withoutConsent({"a"}).empty());
    askForConsent({{}, {}, {}});
    giveConsent({"a"});
    QVERIFY(withoutConsent({"a"}).empty());
  }

  void namedOnACommandLine_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<bool>("named");
    QTest::newRow("a word") << QStringList{"--camera-command", "shoot {output}"} << true;
    QTest::newRow("behind =") << QStringList{"--camera-command=shoot {output}"} << true;
    QTest::newRow("an address") << QStringList{"--camera", "command:shoot {output}"} << true;
    QTest::newRow("the end of another") << QStringList{"--camera-command", "overshoot {output}"} << false;
    QTest::newRow("the beginning") << QStringList{"shoot {output} twice"} << false;
    QTest::newRow("not at all") << QStringList{"verify", "calibration"} << false;
  }
  void namedOnACommandLine() {
    QFETCH(QStringList, arguments);
    QFETCH(bool, named);
    std::vector<std::string> words;
    for (const QString& argument : arguments) words.push_back(argument.toStdString());
    QCOMPARE(isNamedBy(words, "shoot {output}"), named);
  }
};

QTEST_GUILESS_MAIN(TestCommandConsent)
#include "test_command_consent.moc"
