// SPDX-License-Identifier: MIT
#include <QElapsedTimer>
#include <QtTest>
#include <thread>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/pjlink/projector.h"
#include "relucent/pjlink/session.h"
#include "support/fake_projector.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::pjlink;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;
using relucent::test::ProjectorFault;

namespace {

constexpr Patience shortPatience{std::chrono::milliseconds(300), std::chrono::milliseconds(300)};
constexpr Patience briefPatience{std::chrono::milliseconds(300), std::chrono::milliseconds(60)};
// Two waits, and what a busy machine takes.
constexpr qint64 longest = 5000;

FakeProjectorState playing() {
  FakeProjectorState state;
  state.power = "1";
  state.lamps = "1234 1 20 0";
  return state;
}

Report lookAt(const Address& address, const Patience& patience = {}) {
  Progress quiet;
  Session session(address, patience, quiet);
  return look(session);
}

}  // namespace

class TestPjlinkSession : public QObject {
  Q_OBJECT

 private slots:
  void whatAProjectorSaysIsRead_data() {
    QTest::addColumn<QString>("password");
    QTest::newRow("without a password") << QString();
    QTest::newRow("with one") << "secret";
    QTest::newRow("one with other letters") << QString::fromUtf8("schl\u00fcssel");
  }
  void whatAProjectorSaysIsRead() {
    QFETCH(QString, password);
    FakeProjectorState state = playing();
    state.password = password;
    state.troubles = "000010";
    FakeProjector projector(state);
    const Report report = lookAt(projector.address());
    QCOMPARE(report.protocolClass, 2);
    QCOMPARE(report.name, std::string("Left"));
    QCOMPARE(report.maker, std::string("ACME"));
    QCOMPARE(report.model, std::string("P-1"));
    QCOMPARE(report.serial, std::string("SN1"));
    QVERIFY(report.power == Power::on);
    QVERIFY((report.shutter == Shutter{}));
    QVERIFY((report.lamps == std::vector<Lamp>{{1234, true}, {20, false}}));
    QVERIFY((report.troubles == std::vector<Trouble>{{Part::filter, false}}));
    QCOMPARE(report.inputName, std::string("HDMI 1"));
    QVERIFY((report.signal == Signal{Signal::Kind::size, {1920, 1080}}));
    QVERIFY((report.ownPixels == Size{1920, 1080}));
    QVERIFY(report.filterHours == 12);
    QVERIFY(report.unclear.empty());
    QCOMPARE(projector.orders(), QStringList());
  }

  void aProjectorOfClassOneIsAskedNoMore() {
    FakeProjectorState state = playing();
    state.protocolClass = "1";
    FakeProjector projector(state);
    const Report report = lookAt(projector.address());
    QVERIFY(report.serial.empty() && !report.signal && !report.filterHours);
    QVERIFY(report.unclear.empty());
    QCOMPARE(report.name, std::string("Left"));
  }

  void inStandbyItTellsLittle() {
    FakeProjector projector({}, ProjectorFault::unavailable);
    const Report report = lookAt(projector.address());
    QVERIFY(report.power == Power::off);
    QVERIFY(report.name.empty() && !report.shutter && report.lamps.empty());
    QVERIFY(report.unclear.empty());
  }

  void failuresAreSentencesInTime_data() {
    QTest::addColumn<ProjectorFault>("fault");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("silent") << ProjectorFault::silent << "nothing complete came in time";
    QTest::newRow("silent after its greeting")
        << ProjectorFault::silentAfterGreeting << "nothing complete came in time";
    QTest::newRow("closes at once") << ProjectorFault::closesAtOnce << "it closed the connection";
    QTest::newRow("closes within an answer") << ProjectorFault::closesMidAnswer << "it closed the connection";
    QTest::newRow("half a line") << ProjectorFault::halfLine << "nothing complete came in time";
    QTest::newRow("slow bytes") << ProjectorFault::slowBytes << "nothing complete came in time";
    QTest::newRow("a line without an end") << ProjectorFault::overlong << "does not speak PJLink";
    QTest::newRow("another protocol") << ProjectorFault::otherProtocol << "does not speak PJLink";
    QTest::newRow("a newer authentication") << ProjectorFault::newerPassword << "this version does not know";
    QTest::newRow("refused at once") << ProjectorFault::tooManyVisitors << "asks for a password";
  }
  void failuresAreSentencesInTime() {
    QFETCH(ProjectorFault, fault);
    QFETCH(QString, sentence);
    FakeProjector projector(playing(), fault);
    QElapsedTimer took;
    took.start();
    const std::string said =
        sentenceOf([&] { lookAt(projector.address(), shortPatience); }, ErrorKind::device);
    QVERIFY(mentions(said, sentence.toStdString()));
    QVERIFY(mentions(said, toString(projector.address())));
    QVERIFY2(took.elapsed() < longest, qPrintable(QString::number(took.elapsed())));
  }

  void passwords_data() {
    QTest::addColumn<QString>("given");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("wrong") << "guess"
                           << "refuses the password";
    QTest::newRow("none") << ""
                          << "asks for a password";
  }
  void passwords() {
    QFETCH(QString, given);
    QFETCH(QString, sentence);
    FakeProjectorState state = playing();
    state.password = "secret";
    FakeProjector projector(state);
    Address address = projector.address();
    address.password = given.toStdString();
    const std::string said = sentenceOf([&] { lookAt(address); }, ErrorKind::device);
    QVERIFY(mentions(said, sentence.toStdString()));
    QVERIFY(said.find("guess") == std::string::npos && said.find("secret") == std::string::npos);
  }

  void nobodyIsThere() {
    Address nobody;
    {
      FakeProjector gone;
      nobody = gone.address();
    }
    QVERIFY(mentions(sentenceOf([&] { lookAt(nobody); }, ErrorKind::device), "does not answer"));
    nobody.host = "no-such-projector.invalid";
    QElapsedTimer took;
    took.start();
    QVERIFY(
        mentions(sentenceOf([&] { lookAt(nobody, shortPatience); }, ErrorKind::device), "does not answer"));
    QVERIFY2(took.elapsed() < longest, qPrintable(QString::number(took.elapsed())));
  }

  void namesAreFound() {
    FakeProjector projector(playing());
    Address address = projector.address();
    address.host = "localhost";
    QCOMPARE(lookAt(address).name, std::string("Left"));
  }

  void lateAnswersAreNotMistaken() {
    FakeProjector projector(playing(), ProjectorFault::lateAnswers);
    const Report report = lookAt(projector.address());
    QVERIFY(report.power == Power::on);
    QCOMPARE(report.name, std::string("Left"));
    QCOMPARE(report.maker, std::string("ACME"));
    QVERIFY(report.unclear.empty());
  }

  void garbageIsNotedAndIgnored() {
    FakeProjector projector(playing(), ProjectorFault::garbage);
    const Report report = lookAt(projector.address());
    QVERIFY(!report.power && report.name.empty());
    QVERIFY(std::ranges::find(report.unclear, "POWR") != report.unclear.end());
  }

  void namesObeyNoTerminal() {
    FakeProjectorState state = playing();
    state.name = "\x1b[2JLeft\n";
    FakeProjector projector(state);
    QCOMPARE(lookAt(projector.address()).name, std::string("\\x1b[2JLeft\\x0a"));
  }

  void stoppingEndsAWait() {
    FakeProjector projector(playing(), ProjectorFault::silent);
    StopRequest stop;
    SilentSink sink;
    Progress progress(sink, stop);
    std::thread user([&] {
      while (projector.connections() == 0) std::this_thread::yield();
      stop.ask(StopRequest::Kind::cancel);
    });
    QElapsedTimer took;
    took.start();
    bool cancelled = false;
    try {
      Session session(projector.address(), {std::chrono::minutes(5), std::chrono::minutes(5)}, progress);
    } catch (const Cancelled&) {
      cancelled = true;
    }
    user.join();
    QVERIFY(cancelled);
    QVERIFY2(took.elapsed() < longest, qPrintable(QString::number(took.elapsed())));
  }

  void ordersAreObeyedOrNot_data() {
    QTest::addColumn<QString>("power");
    QTest::addColumn<ProjectorFault>("fault");
    QTest::addColumn<int>("obedience");  // to close the shutter; -1: Error
    QTest::addColumn<QStringList>("orders");
    const auto row = [](const char* name, const char* power, ProjectorFault fault, int obedience,
                        QStringList orders) { QTest::newRow(name) << power << fault << obedience << orders; };
    const auto of = [](Obedience obedience) { return static_cast<int>(obedience); };
    row("on", "1", ProjectorFault::none, of(Obedience::done), {"AVMT 11"});
    row("in standby", "0", ProjectorFault::none, of(Obedience::notNow), {"AVMT 11"});
    row("no shutter", "1", ProjectorFault::noShutter, of(Obedience::cannot), {"AVMT 11", "AVMT 31"});
    row("with the sound only", "1", ProjectorFault::pictureWithSound, of(Obedience::done),
        {"AVMT 11", "AVMT 31"});
    row("a failure", "1", ProjectorFault::failure, -1, {});
    row("garbage", "1", ProjectorFault::garbage, of(Obedience::notNow), {"AVMT 11"});
  }
  void ordersAreObeyedOrNot() {
    QFETCH(QString, power);
    QFETCH(ProjectorFault, fault);
    QFETCH(int, obedience);
    QFETCH(QStringList, orders);
    FakeProjectorState state = playing();
    state.power = power.toLatin1();
    FakeProjector projector(state, fault);
    Progress quiet;
    Session session(projector.address(), {}, quiet);
    int found = -1;
    const std::string failure =
        sentenceOf([&] { found = static_cast<int>(closeShutter(session, true)); }, ErrorKind::device);
    QCOMPARE(found, obedience);
    QCOMPARE(failure.empty(), obedience >= 0);
    QCOMPARE(projector.orders(), orders);
  }

  /// Thousands of damaged answers: each look ends in a report or in a sentence, in time.
  void damagedAnswersEndInAReportOrASentence() {
    FakeProjector projector(playing());
    auto random = std::make_shared<Random>(std::initializer_list<std::uint64_t>{26, 4352});
    auto damaged = std::make_shared<std::atomic<int>>(0);
    projector.setMangle([random, damaged](const QByteArray& answer) {
      QByteArray text = answer;
      const auto at = static_cast<qsizetype>(random->below(static_cast<std::uint64_t>(text.size())));
      // Carriage returns stay: a line that lacks its own is one of the rows above, and waits.
      switch (random->below(6)) {
        case 0:
          // Mostly in the value: a command that is not the one asked for is waited out.
          text[at == text.size() - 1 || random->below(8) > 0 ? std::min<qsizetype>(7, text.size() - 2) : at] =
              static_cast<char>(random->below(256));
          break;
        case 1:
          text.remove(0, at);
          break;
        case 2:
          text.insert(at, QByteArray(static_cast<qsizetype>(random->below(200)),
                                     static_cast<char>(random->below(256))));
          break;
        case 3:
          text.prepend("%1NAME=late\r");
          break;
        case 4:
          text.insert(at, '\r');
          break;
        default:
          return answer;
      }
      ++*damaged;
      return text;
    });
    int reports = 0, sentences = 0;
    for (int i = 0; i < 400; ++i) {
      QElapsedTimer took;
      took.start();
      const std::string failure =
          sentenceOf([&] { lookAt(projector.address(), briefPatience); }, ErrorKind::device);
      failure.empty() ? ++reports : ++sentences;
      QVERIFY2(failure.find("wrong kind") == std::string::npos, failure.c_str());
      QVERIFY2(took.elapsed() < longest, qPrintable(QString::number(took.elapsed())));
    }
    QVERIFY2(*damaged > 3000, qPrintable(QString::number(*damaged)));
    QVERIFY2(reports > 50, qPrintable(QString("%1 reports, %2 sentences").arg(reports).arg(sentences)));
    // And it goes on as if nothing had been.
    projector.setMangle({});
    QCOMPARE(lookAt(projector.address()).name, std::string("Left"));
  }
};

QTEST_GUILESS_MAIN(TestPjlinkSession)
#include "test_pjlink_session.moc"
