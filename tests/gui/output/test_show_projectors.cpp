// SPDX-License-Identifier: MIT
// A show whose projectors are on the network, and its status page. Runs on two screens that can be unplugged,
// see tests/support/with-two-screens.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <QtTest>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "output/show.h"
#include "relucent/pipeline/stored_settings.h"
#include "support/fake_projector.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;
using relucent::test::ProjectorFault;

namespace {

// A projector is looked at again after three seconds while it does not do yet what is wanted.
constexpr int patience = 15'000;

FakeProjectorState playing() {
  FakeProjectorState state;
  state.power = "1";
  state.looksUntilWarm = 0;
  return state;
}

}  // namespace

class TestShowProjectors : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  QDateTime wall_;

  ShowSettings settings(const FakeProjector* projector) {
    const QString file = folder_->filePath("a.png");
    noise(projectorSize, 3).save(file);
    ShowSettings settings;
    settings.canvas = {projectorSize, Fit::fill};
    settings.folder = folder_->filePath("log");
    settings.content.fadeSeconds = 0.0;
    settings.content.items.append({file, 86400.0});
    if (projector != nullptr)
      settings.projectors.push_back(
          {"left", projector->address(), Size{projectorSize.width(), projectorSize.height()}});
    return settings;
  }
  std::unique_ptr<Show> showOf(const ShowSettings& settings) {
    MachineClock clock{[this] { return wall_; }, [] { return std::chrono::nanoseconds(0); }};
    return std::make_unique<Show>(
        settings,
        [](const std::function<void(const QString&)>&, const std::string&) {
          return std::make_unique<ScriptedRenderer>();
        },
        clock);
  }
  QJsonObject health() const {
    QFile file(folder_->filePath("log/health.json"));
    return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
  }
  QJsonObject projector() const { return health()["projectors"][0].toObject(); }
  QString log() const {
    QFile file(folder_->filePath("log/show.log"));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
  }

 private slots:
  void init() {
    if (screenOn("DUMMY1") == nullptr) plug();
    folder_ = std::make_unique<QTemporaryDir>();
    wall_ = QDateTime({2026, 5, 4}, {12, 0});
  }

  void whatTheProjectorsSayStandsInHealthAndLog() {
    FakeProjectorState state = playing();
    state.password = "secret";
    state.troubles = "100000";
    state.signal = "1920x1080";
    FakeProjector fake(state);
    auto show = showOf(settings(&fake));
    show->start();
    QTRY_COMPARE(projector()["power"].toString(), QString("on"));
    QCOMPARE(projector()["projector"].toString(), QString("left"));
    QCOMPARE(projector()["lamp_hours"].toArray(), QJsonArray{1234});
    QCOMPARE(projector()["shutter"].toString(), QString("open"));
    QCOMPARE(projector()["remarks"].toArray(), QJsonArray{"projector left warns: fan"});
    QVERIFY(log().contains("warning projector left warns: fan"));
    QVERIFY(log().contains("receives 1920x1080 pixels where 1024x768 are sent"));
    QVERIFY(!log().contains("secret") && !QJsonDocument(health()).toJson().contains("secret"));
    QCOMPARE(fake.orders(), QStringList());
  }

  void aProjectorThatDoesNotAnswerEndsNoShow() {
    FakeProjector fake(playing(), ProjectorFault::closesAtOnce);
    ShowSettings wanted = settings(&fake);
    wanted.switchesPower = wanted.closesShutter = true;
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QTRY_VERIFY(fake.connections() > 1);
    QCOMPARE(projector()["answers"].toBool(true), false);
    QVERIFY(projector()["problem"].toString().contains("closed the connection"));
    QCOMPARE(log().count("does not answer"), 1);
    QCOMPARE(health()["state"].toString(), QString("playing"));
    fake.setFault(ProjectorFault::none);
    QTRY_VERIFY_WITH_TIMEOUT(projector()["answers"].toBool(), patience);
    QVERIFY(log().contains("projector left answers again"));
  }

  void theShutterClosesWhileItIsBlack() {
    FakeProjector fake(playing());
    ShowSettings wanted = settings(&fake);
    wanted.closesShutter = true;
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    show->player().handleKey(Qt::Key_B);
    show->look();
    QTRY_COMPARE(fake.orders(), QStringList{"AVMT 11"});
    QTRY_COMPARE(projector()["shutter"].toString(), QString("closed"));
    show->player().handleKey(Qt::Key_B);
    QTRY_COMPARE(fake.orders(), (QStringList{"AVMT 11", "AVMT 10"}));
  }

  void powerFollowsTheHours() {
    FakeProjector fake(playing());
    ShowSettings wanted = settings(&fake);
    wanted.switchesPower = true;
    wanted.hours = DailyHours{{9, 0}, {18, 0}};
    auto show = showOf(wanted);
    show->start();
    QTRY_COMPARE(projector()["power"].toString(), QString("on"));
    wall_ = QDateTime({2026, 5, 4}, {18, 0});
    show->look();
    QTRY_VERIFY_WITH_TIMEOUT(projector()["power"].toString() == "standby", patience);
    wall_ = QDateTime({2026, 5, 5}, {9, 0});
    show->look();
    QTRY_VERIFY_WITH_TIMEOUT(projector()["power"].toString() == "on", patience);
    QCOMPARE(fake.orders(), (QStringList{"POWR 0", "POWR 1"}));
    QVERIFY(log().contains("projector left was switched off") &&
            log().contains("projector left was switched on"));
  }

  /// A screen goes with its projector: it is switched on, and waited for.
  void aScreenIsWaitedForUntilItsProjectorIsOn() {
    FakeProjectorState state = playing();
    state.power = "0";
    FakeProjector fake(state);
    unplug();
    ShowSettings wanted = settings(&fake);
    QVERIFY(
        mentions(sentenceOf([&] { showOf(wanted); }, ErrorKind::input), "no display beside the operator's"));
    wanted.switchesPower = true;
    wanted.osc = NetworkPlace{QHostAddress::LocalHost, 0};
    wanted.status = NetworkPlace{QHostAddress::LocalHost, 0};
    auto show = showOf(wanted);
    show->start();
    QCOMPARE(health()["state"].toString(), QString("failed"));
    // Whoever asks for something meanwhile gets an answer.
    QUdpSocket desk;
    for (const OscMessage& message :
         {OscMessage{"/black", {0.0}}, OscMessage{"/next", {}}, OscMessage{"/item", {1.0}},
          OscMessage{"/brightness", {1.0}}, OscMessage{"/compensation", {1.0}}, OscMessage{"/pause", {}},
          OscMessage{"/chart", {QString("none")}}, OscMessage{"/viewer", {1.0, 2.0}}})
      desk.writeDatagram(oscDatagram(message), show->osc()->host, show->osc()->port);
    QTRY_VERIFY(desk.hasPendingDatagrams());
    QTRY_COMPARE(fake.orders(), QStringList{"POWR 1"});
    plug();
    QTRY_VERIFY_WITH_TIMEOUT(health()["state"].toString() == "playing", patience);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
  }

  void wishes_data() {
    QTest::addColumn<int>("offAfter");  // minutes; 0: none
    QTest::addColumn<QList<int>>("minutes");
    QTest::addColumn<QString>("given");   // at each: p plays, b black meanwhile, r rests
    QTest::addColumn<QString>("wished");  // at each: 1 on, b on and black, 0 off
    QTest::newRow("hours") << 0 << QList<int>{0, 1, 2, 3} << "pbrp"
                           << "1b01";
    QTest::newRow("after ten minutes") << 10 << QList<int>{0, 1, 10, 11, 12} << "pbbbp"
                                       << "1bb01";
    QTest::newRow("after ten minutes of rest") << 10 << QList<int>{0, 5, 15, 16} << "prrp"
                                               << "1b01";
    QTest::newRow("brief black begins anew") << 10 << QList<int>{0, 6, 7, 14, 17} << "bpbbb"
                                             << "b1bb0";
    QTest::newRow("a clock set back") << 10 << QList<int>{20, 0, 9, 10} << "bbbb"
                                      << "bbb0";
  }
  void wishes() {
    QFETCH(int, offAfter);
    QFETCH(QList<int>, minutes);
    QFETCH(QString, given);
    QFETCH(QString, wished);
    ProjectorWishes wishes(offAfter > 0 ? std::optional(std::chrono::minutes(offAfter)) : std::nullopt);
    QString found;
    for (qsizetype i = 0; i < minutes.size(); ++i) {
      const pjlink::Wanted wanted =
          wishes.at(wall_.addSecs(60 * minutes[i]), given[i] != 'r', given[i] == 'b');
      found += !wanted.on ? '0' : wanted.black ? 'b' : '1';
    }
    QCOMPARE(found, wished);
  }

  void theStatusPageIsTheHealthFile() {
    FakeProjector fake(playing());
    ShowSettings wanted = settings(&fake);
    wanted.status = NetworkPlace{QHostAddress::LocalHost, 0};
    auto show = showOf(wanted);
    show->start();
    QVERIFY(log().contains("status page at http://127.0.0.1:"));
    QTRY_COMPARE(projector()["power"].toString(), QString("on"));
    QTcpSocket browser;
    browser.connectToHost(show->status()->host, show->status()->port);
    browser.write("GET /health.json HTTP/1.0\r\n\r\n");
    QTRY_COMPARE(browser.state(), QAbstractSocket::UnconnectedState);
    const QByteArray said = browser.readAll();
    const QJsonObject page = QJsonDocument::fromJson(said.mid(said.indexOf("\r\n\r\n"))).object();
    QCOMPARE(page.keys(), health().keys());
    QCOMPARE(page["projectors"], health()["projectors"]);
  }

  void aCalibrationKnowsItsProjectors() {
    pipeline::CommandRigSettings rig;
    rig.projectorCommand = "show {image}";
    rig.cameraCommand = "photograph {exposure} {output}";
    rig.projector = {1024, 768};
    pipeline::CalibrateSettings calibrated;
    calibrated.rig = rig;
    calibrated.network.addresses[0] = {"192.168.1.50", 4353, "secret"};
    const std::filesystem::path path = folder_->filePath("venue").toStdString();
    pipeline::createCalibration(path, calibrated);
    const std::vector<ShowProjector> found = showProjectorsOf(path);
    QCOMPARE(found.size(), std::size_t{1});
    QCOMPARE(found[0].label, std::string("1"));
    QVERIFY(found[0].address == calibrated.network.addresses[0]);
    QVERIFY((found[0].sent == Size{1024, 768}));
  }
};

QTEST_MAIN(TestShowProjectors)
#include "test_show_projectors.moc"
