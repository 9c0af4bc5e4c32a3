// SPDX-License-Identifier: MIT
#include "remote/remote_control.h"

#include <QFile>
#include <QSignalSpy>
#include <QtTest>

#include "gui/remote/noted_actions.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

std::string described(const RemoteState& state) {
  return fmt::format("{} {} {} {} {} {}", state.paused, state.black, state.compensated, state.brightness,
                     state.chart ? testChartName(*state.chart).toStdString() : "none", state.item);
}

}  // namespace

class TestRemoteControl : public QObject {
  Q_OBJECT

  std::unique_ptr<OscServer> server_;
  QUdpSocket client_, desk_;

  /// All answers to a message, the last of which is that to a question behind it.
  std::vector<OscMessage> answers(const OscMessage& message) {
    for (const OscMessage& one : {message, OscMessage{"/item", {}}})
      client_.writeDatagram(oscDatagram(one), server_->place().host, server_->place().port);
    std::vector<OscMessage> all;
    const auto isLast = [&] { return !all.empty() && all.back().address == "/item"; };
    const bool arrived = QTest::qWaitFor([&] {
      for (const OscMessage& one : receivedAt(client_)) all.push_back(one);
      return isLast();
    });
    if (arrived) all.pop_back();
    return all;
  }
  static std::vector<OscMessage> receivedAt(QUdpSocket& socket) {
    std::vector<OscMessage> all;
    while (socket.hasPendingDatagrams()) {
      QByteArray datagram(socket.pendingDatagramSize(), '\0');
      socket.readDatagram(datagram.data(), datagram.size());
      const auto messages = oscMessages(datagram);
      if (messages) all.insert(all.end(), messages->begin(), messages->end());
    }
    return all;
  }

 private slots:
  void init() {
    server_ = std::make_unique<OscServer>(NetworkPlace{QHostAddress::LocalHost, 0});
    QVERIFY(desk_.bind(QHostAddress::LocalHost, 0));
  }
  void cleanup() { desk_.close(); }

  void commandsAreCarriedOut_data() {
    QTest::addColumn<QString>("address");
    QTest::addColumn<QVariant>("argument");
    QTest::addColumn<QString>("state");
    const auto row = [](const char* address, const QVariant& argument, const char* state) {
      QTest::addRow("%s %s", address, qPrintable(argument.toString())) << address << argument << state;
    };
    row("/pause", {}, "true false true 1 none 0");
    row("/play", {}, "false false true 1 none 0");
    row("/freeze", 1, "true false true 1 none 0");
    row("/freeze", 0, "false false true 1 none 0");
    row("/black", 1, "false true true 1 none 0");
    row("/black", 1.0, "false true true 1 none 0");
    row("/compensation", 0, "false false false 1 none 0");
    row("/brightness", 0.25, "false false true 0.25 none 0");
    row("/chart", "grid", "false false true 1 grid 0");
    row("/chart", "none", "false false true 1 none 0");
    row("/next", {}, "false false true 1 none 1");
    row("/item", 3, "false false true 1 none 2");
  }
  void commandsAreCarriedOut() {
    QFETCH(QString, address);
    QFETCH(QVariant, argument);
    QFETCH(QString, state);
    NotedActions actions;
    RemoteControl control(*server_, actions, std::nullopt);
    OscMessage message{address, {}};
    if (argument.typeId() == QMetaType::QString)
      message.arguments = {argument.toString()};
    else if (argument.isValid())
      message.arguments = {argument.toDouble()};
    const std::vector<OscMessage> answered = answers(message);
    QCOMPARE(described(actions.now), state.toStdString());
    // Those that have a value tell it; for the others that is what they change.
    if (!message.arguments.empty()) {
      QCOMPARE(answered.size(), std::size_t{1});
      QVERIFY(answered.front() == message);
    }
  }

  void theLastItemIsFollowedByTheFirst() {
    NotedActions actions;
    actions.now.item = 2;
    RemoteControl control(*server_, actions, std::nullopt);
    answers({"/next", {}});
    QCOMPARE(actions.now.item, qsizetype{0});
  }

  /// Controllers send 1 when a button is pressed, and 0 when it is let go of.
  void aButtonActsWhenItIsPressed() {
    NotedActions actions;
    RemoteControl control(*server_, actions, std::nullopt);
    for (const double value : {1.0, 0.0}) QVERIFY(answers({"/next", {value}}).empty());
    QCOMPARE(actions.now.item, qsizetype{1});
    for (const double value : {1.0, 0.0})
      QCOMPARE(answers({"/check", {value}}).size(), value == 1.0 ? 1U : 0U);
    QCOMPARE(actions.begun, QStringList{"check"});
  }

  void theViewerMovesWithoutAnAnswer() {
    NotedActions actions;
    RemoteControl control(*server_, actions, std::nullopt);
    QVERIFY(answers({"/viewer", {1.0, -2.5, 0.5}}).empty());
    QVERIFY(actions.viewer == compensation::Position({1.0, -2.5, 0.5}));
    QVERIFY(answers({"/viewer", {3.0, 4.0}}).empty());
    QVERIFY(actions.viewer == compensation::Position({3.0, 4.0, 0.0}));
  }

  void questionsAreAnswered() {
    NotedActions actions;
    actions.now.brightness = 0.5;
    RemoteControl control(*server_, actions, std::nullopt);
    const std::vector<OscMessage> answered = answers({"/brightness", {}});
    QVERIFY(answered.size() == 1 && answered.front() == OscMessage({"/brightness", {0.5}}));
  }

  /// What takes some seconds is begun, and told of when it is done; a question begins nothing.
  void aSetIsBegunAndAskedFor() {
    NotedActions actions;
    RemoteControl control(*server_, actions, std::nullopt);
    const std::vector<OscMessage> answered = answers({"/set", {QString("night")}});
    QVERIFY(answered.size() == 2 && answered[0] == OscMessage({"/set/begun", {}}) &&
            answered[1] == OscMessage({"/set", {QString("night")}}));
    QCOMPARE(actions.now.set, QString("night"));
    const std::vector<OscMessage> asked = answers({"/set", {}});
    QVERIFY(asked.size() == 1 && asked.front() == OscMessage({"/set", {QString("night")}}));
    for (const OscArgument& wrong : {OscArgument(1.0), OscArgument(QString())}) {
      const std::vector<OscMessage> refused = answers({"/set", {wrong}});
      QVERIFY(refused.size() == 1 && refused.front().address == "/error");
    }
    QCOMPARE(actions.now.set, QString("night"));
  }

  void whatCannotBeDoneIsSaid_data() {
    QTest::addColumn<QString>("address");
    QTest::addColumn<QVariantList>("arguments");
    QTest::addColumn<QString>("why");
    QTest::newRow("no such address") << "/explode" << QVariantList{} << "no such address";
    QTest::newRow("a part of one") << "/blac" << QVariantList{1} << "no such address";
    QTest::newRow("no argument") << "/viewer" << QVariantList{} << "x y, or x y z";
    QTest::newRow("too many") << "/viewer" << QVariantList{1, 2, 3, 4} << "x y, or x y z";
    QTest::newRow("an argument too many") << "/next" << QVariantList{2} << "no arguments";
    QTest::newRow("two arguments too many") << "/next" << QVariantList{1, 1} << "no arguments";
    QTest::newRow("text for a number") << "/black" << QVariantList{"on"} << "0 or 1";
    QTest::newRow("half a switch") << "/black" << QVariantList{0.5} << "0 or 1";
    QTest::newRow("no place") << "/viewer" << QVariantList{1.0, "left"} << "finite numbers";
    QTest::newRow("not a number") << "/viewer" << QVariantList{1.0, std::nan("")} << "finite numbers";
    QTest::newRow("endless") << "/viewer" << QVariantList{1.0, INFINITY} << "finite numbers";
    QTest::newRow("too bright") << "/brightness" << QVariantList{1.6} << "0 to 1.5";
    QTest::newRow("darker than black") << "/brightness" << QVariantList{-0.1} << "0 to 1.5";
    QTest::newRow("no such item") << "/item" << QVariantList{4} << "1 to 3";
    QTest::newRow("item 0") << "/item" << QVariantList{0} << "1 to 3";
    QTest::newRow("half an item") << "/item" << QVariantList{1.5} << "1 to 3";
    QTest::newRow("no such chart") << "/chart" << QVariantList{"mandala"} << "grid, ramps";
    QTest::newRow("a chart's number") << "/chart" << QVariantList{1} << "grid, ramps";
  }
  void whatCannotBeDoneIsSaid() {
    QFETCH(QString, address);
    QFETCH(QVariantList, arguments);
    QFETCH(QString, why);
    NotedActions actions;
    const std::string before = described(actions.now);
    RemoteControl control(*server_, actions, std::nullopt);
    QSignalSpy warned(&control, &RemoteControl::warned);
    OscMessage message{address, {}};
    for (const QVariant& argument : arguments) {
      if (argument.typeId() == QMetaType::QString)
        message.arguments.emplace_back(argument.toString());
      else
        message.arguments.emplace_back(argument.toDouble());
    }
    for (int again = 0; again < 3; ++again) {
      const std::vector<OscMessage> answered = answers(message);
      // Who tells a position many times a second is told once what is wrong with it.
      QCOMPARE(answered.size(), std::size_t{again == 0 || address != "/viewer" ? 1u : 0u});
      if (answered.empty()) continue;
      QCOMPARE(answered.front().address, QString("/error"));
      QCOMPARE(std::get<QString>(answered.front().arguments[0]), address);
      const QString sentence = std::get<QString>(answered.front().arguments[1]);
      QVERIFY2(sentence.contains(why), qPrintable(sentence));
    }
    QCOMPARE(warned.count(), 1);
    QCOMPARE(described(actions.now), before);
    QVERIFY(!actions.viewer);
  }

  /// Whoever invents addresses, or tells a position that is wrong in another way every time, fills no log.
  void floodsOfNonsenseFillNoLog() {
    std::chrono::steady_clock::time_point now{};
    server_ = std::make_unique<OscServer>(NetworkPlace{QHostAddress::LocalHost, 0}, [&now] { return now; });
    NotedActions actions;
    RemoteControl control(*server_, actions, std::nullopt);
    QSignalSpy warned(&control, &RemoteControl::warned);
    for (int i = 0; i < 60; ++i) {
      actions.whyNoViewer = RELUCENT_ENGLISH_MESSAGE("test.far", "{} m away").with(i);
      QCOMPARE(answers({"/viewer", {1.0 * i, 2.0}}).size(), std::size_t{i == 0 ? 1u : 0u});
    }
    QCOMPARE(warned.count(), 1);
    for (int i = 0; i < 60; ++i) answers({QString("/nonsense/%1").arg(i), {}});
    QCOMPARE(warned.count(), static_cast<int>(RemoteControl::mostSentences));
    now += std::chrono::seconds(61);
    answers({"/nonsense", {}});
    QCOMPARE(warned.count(), static_cast<int>(RemoteControl::mostSentences) + 1);
  }

  void whyAViewerCannotBeFollowedIsSaidOnce() {
    NotedActions actions;
    actions.whyNoViewer = Message::plain("nobody knows where the cameras are");
    RemoteControl control(*server_, actions, std::nullopt);
    QSignalSpy warned(&control, &RemoteControl::warned);
    QCOMPARE(answers({"/viewer", {1.0, 2.0}}).size(), std::size_t{1});
    QVERIFY(answers({"/viewer", {1.0, 2.5}}).empty());
    QCOMPARE(warned.count(), 1);
  }

  /// Everything at first, and then what changes, by whomever.
  void theFeedbackAddressIsToldOfChanges() {
    NotedActions actions;
    RemoteControl control(*server_, actions, NetworkPlace{QHostAddress::LocalHost, desk_.localPort()});
    std::vector<OscMessage> told;
    const auto toldAll = [&](std::size_t count) {
      return QTest::qWaitFor([&] {
        for (const OscMessage& one : receivedAt(desk_)) told.push_back(one);
        return told.size() >= count;
      });
    };
    std::size_t values = 0;
    for (const RemoteCommand& command : remoteCommands()) values += command.value != nullptr;
    QVERIFY(toldAll(values));
    QCOMPARE(told.size(), values);
    told.clear();
    answers({"/black", {1.0}});
    actions.now.item = 1;
    control.report();
    control.report();
    QVERIFY(toldAll(2));
    QVERIFY((told == std::vector<OscMessage>{{"/black", {1.0}}, {"/item", {2.0}}}));
  }

  /// Whoever began it is told, and the desk; where it is the desk itself, once.
  void whatTakesLongIsAnnounced_data() {
    QTest::addColumn<QString>("work");
    QTest::newRow("check") << "check";
    QTest::newRow("perfect") << "perfect";
  }
  void whatTakesLongIsAnnounced() {
    QFETCH(QString, work);
    NotedActions actions;
    RemoteControl control(*server_, actions, NetworkPlace{QHostAddress::LocalHost, desk_.localPort()});
    const std::vector<OscMessage> begun = answers({"/" + work, {}});
    QCOMPARE(actions.begun, QStringList{work});
    QVERIFY((begun == std::vector<OscMessage>{{"/" + work + "/begun", {}}}));
    control.announce("/" + work, "done", {QString("still_good"), QString("It holds.")});
    const OscMessage done{"/" + work + "/done", {QString("still_good"), QString("It holds.")}};
    const auto hears = [&done](QUdpSocket& socket) {
      std::vector<OscMessage> heard;
      return QTest::qWaitFor([&] {
        for (const OscMessage& one : receivedAt(socket)) heard.push_back(one);
        return std::ranges::count(heard, done) == 1;
      });
    };
    QVERIFY(hears(client_));
    QVERIFY(hears(desk_));
  }

  void whatCannotBePhotographedIsAnError() {
    NotedActions actions;
    actions.whyNoPhotographs = Message::plain("this show has no camera");
    RemoteControl control(*server_, actions, std::nullopt);
    const std::vector<OscMessage> said = answers({"/check", {}});
    QCOMPARE(said.size(), std::size_t{1});
    QCOMPARE(said[0].address, QString("/error"));
    QVERIFY(std::get<QString>(said[0].arguments[1]).contains("has no camera"));
  }

  /// The README's table is this one.
  void theTableIsTheReadmes() {
    QFile readme(qEnvironmentVariable("RELUCENT_TEST_DATA") + "/../../gui/remote/README.md");
    QVERIFY(readme.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(readme.readAll());
    for (const RemoteCommand& command : remoteCommands()) {
      const QString row = QString("| `%1` | %2 | %3 |").arg(command.address, command.arguments, command.what);
      QVERIFY2(text.contains(row), qPrintable(row));
    }
    QCOMPARE(text.count("\n| `/"), static_cast<qsizetype>(remoteCommands().size()));
  }
};

QTEST_GUILESS_MAIN(TestRemoteControl)
#include "test_remote_control.moc"
