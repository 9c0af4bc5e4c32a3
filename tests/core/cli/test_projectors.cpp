// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/cli/commands.h"
#include "relucent/cli/projectors_document.h"
#include "support/fake_projector.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::cli;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;
using relucent::test::ProjectorFault;

class TestProjectors : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::string at(const char* name) const { return folder_.filePath(name).toStdString(); }

  static CommandResult run(const std::vector<std::string>& arguments) {
    Progress quiet;
    return execute(parseArguments(arguments).command, quiet);
  }

 private slots:
  void whatAProjectorSaysIsPrinted() {
    FakeProjectorState state;
    state.power = "1";
    state.troubles = "000010";
    state.signal = "1280x720";
    FakeProjector projector(state);
    const CommandResult result = run({"projectors", toString(projector.address())});
    QCOMPARE(result.status, 0);
    for (const char* part :
         {"ACME P-1 \"Left\", PJLink class 2, serial number SN1", "power: on, shutter open", "lamp: 1234 h\n",
          "filter: 12 h", "input: HDMI 1, 1280x720", "its own pixels: 1920x1080", "warns: filter",
          "it scales the picture"})
      QVERIFY(mentions(result.text, part));
    const calibration::Json& one = result.document.at("projectors").at(0);
    QCOMPARE(one.at("power").get<std::string>(), std::string("on"));
    QCOMPARE(one.at("errors").dump(), std::string(R"([{"part":"filter","level":"warning"}])"));
    QCOMPARE(one.at("signal").dump(), std::string("[1280,720]"));
    QCOMPARE(one.at("remarks").size(), std::size_t{2});
  }

  void oneThatDoesNotAnswerIsAStatus() {
    FakeProjector projector({}, ProjectorFault::otherProtocol);
    const CommandResult result = run({"projectors", toString(projector.address())});
    QCOMPARE(result.status, 1);
    QVERIFY(mentions(result.text, "does not speak PJLink"));
    QCOMPARE(result.document.at("projectors").at(0).at("answers").dump(), std::string("false"));
  }

  void whatIsNotToldIsNull() {
    FakeProjectorState state;
    state.protocolClass = "1";
    state.name = "";
    FakeProjector projector(state);
    const CommandResult result = run({"projectors", toString(projector.address())});
    const calibration::Json& one = result.document.at("projectors").at(0);
    for (const char* key : {"name", "serial", "signal", "own_size", "filter_hours", "input_name"})
      QVERIFY2(one.at(key).is_null(), key);
  }

  void ordersAreTold_data() {
    QTest::addColumn<QString>("order");
    QTest::addColumn<QString>("heard");
    QTest::newRow("on") << "on"
                        << "POWR 1";
    QTest::newRow("off") << "off"
                         << "POWR 0";
    QTest::newRow("close") << "close"
                           << "AVMT 11";
    QTest::newRow("open") << "open"
                          << "AVMT 10";
  }
  void ordersAreTold() {
    QFETCH(QString, order);
    QFETCH(QString, heard);
    FakeProjectorState state;
    state.power = order == "on" ? "0" : "1";
    FakeProjector projector(state);
    run({"projectors", toString(projector.address()), "--tell", order.toStdString()});
    QCOMPARE(projector.orders(), QStringList{heard});
  }

  void aCalibrationIsToldOfThem() {
    FakeProjectorState state;
    state.password = "secret";
    FakeProjector projector(state);
    writeFileAtomically(at("password"), "secret\n");
    Progress quiet;
    run({"calibrate", at("venue"), "--venue", "plain", "--projector", "24x18", "--camera", "20x16", "--paths",
         "16", "--levels", "5", "--cache", at("cache")});
    const std::string address = toString(projector.address());
    QCOMPARE(run({"projectors", "--calibration", at("venue"), "--pjlink", address}).status, 1);
    const CommandResult set = run({"projectors", "--calibration", at("venue"), "--pjlink-password-file",
                                   at("password"), "--warm-up", "power"});
    QCOMPARE(set.status, 0);
    QVERIFY(set.text.find("secret") == std::string::npos &&
            set.document.dump().find("secret") == std::string::npos);
    QCOMPARE(run({"projectors", "--calibration", at("venue")}).document.at("projectors").size(),
             std::size_t{1});
    run({"verify", at("venue"), "--cache", at("cache")});
    QCOMPARE(projector.state().power, QByteArray("1"));
    QCOMPARE(run({"projectors", "--calibration", at("venue"), "--forget"}).document.at("projectors").size(),
             std::size_t{0});
    QCOMPARE(run({"projectors", "--calibration", at("venue")}).document.at("projectors").size(),
             std::size_t{0});
  }

  void wrongUsage_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("nobody") << QStringList{} << "say which projectors";
    QTest::newRow("no address") << QStringList{"a b"} << "'a b' is no address";
    QTest::newRow("no calibration") << QStringList{"left", "--pjlink", "left"} << "need --calibration";
    QTest::newRow("no order") << QStringList{"left", "--tell", "dance"} << "dance";
    QTest::newRow("forget what") << QStringList{"left", "--forget"} << "need --calibration";
  }
  void wrongUsage() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, sentence);
    std::vector<std::string> words{"projectors"};
    for (const QString& word : arguments) words.push_back(word.toStdString());
    try {
      parseArguments(words);
      QFAIL("it was understood");
    } catch (const WrongUsage& error) {
      QVERIFY(mentions(error.what(), sentence.toStdString()));
    }
  }

  void calibrateTakesAddresses() {
    const Command command =
        parseArguments({"calibrate", "d", "--pjlink", "1=left:4400", "--warm-up", "power"}).command;
    const auto& network = std::get<Calibrate>(command).settings.network;
    QVERIFY((network.addresses.at(0) == pjlink::Address{"left", 4400}));
    QVERIFY(network.warmUp == pipeline::WarmUp::power);
  }
};

QTEST_GUILESS_MAIN(TestProjectors)
#include "test_projectors.moc"
