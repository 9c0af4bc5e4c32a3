// SPDX-License-Identifier: MIT
// Sets of a calibration in a show: by the time of the day, by items, by OSC. Runs on two screens, see
// tests/support/with-two-screens.
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QUdpSocket>
#include <QtTest>
#include <algorithm>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "output/show.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stored_settings.h"
#include "remote/osc_message.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

class TestShowSets : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  QStringList opened_;  // sets that renderers were made for
  ScriptedRenderer* renderer_ = nullptr;
  QDateTime wall_;
  QUdpSocket desk_;

  QString picture(const char* name, quint32 seed) {
    const QString file = folder_->filePath(name);
    noise(projectorSize, seed).save(file);
    return file;
  }
  ShowSettings settings() {
    ShowSettings settings;
    settings.calibration = folder_->filePath("venue").toStdString();
    settings.canvas = {projectorSize, Fit::fill};
    settings.folder = folder_->filePath("log");
    settings.content.fadeSeconds = 0.0;
    settings.content.items = {{picture("a.png", 3), 86400.0}};
    settings.osc = NetworkPlace{QHostAddress::LocalHost, 0};
    return settings;
  }
  std::unique_ptr<Show> showOf(const ShowSettings& settings) {
    opened_.clear();
    MachineClock clock{[this] { return wall_; }, [] { return std::chrono::nanoseconds(0); }};
    auto show = std::make_unique<Show>(
        settings,
        [this](const std::function<void(const QString&)>&, const std::string& set) {
          opened_.append(QString::fromStdString(set));
          auto renderer = std::make_unique<ScriptedRenderer>();
          renderer_ = renderer.get();
          return renderer;
        },
        clock);
    show->start();
    return show;
  }
  QJsonObject health() {
    QFile file(folder_->filePath("log/health.json"));
    return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
  }
  QString plays() { return health()["set"].toString(); }
  QString log() {
    QFile file(folder_->filePath("log/show.log"));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
  }
  void send(const Show& show, const OscMessage& message) {
    desk_.writeDatagram(oscDatagram(message), show.osc()->host, show.osc()->port);
  }
  QStringList told_;
  void listen() {
    while (desk_.hasPendingDatagrams()) {
      QByteArray datagram(desk_.pendingDatagramSize(), '\0');
      desk_.readDatagram(datagram.data(), datagram.size());
      for (const OscMessage& message : oscMessages(datagram).value_or(std::vector<OscMessage>())) {
        QString line = message.address;
        for (const OscArgument& argument : message.arguments)
          if (const auto* text = std::get_if<QString>(&argument)) line += ' ' + *text;
        told_.append(line);
      }
    }
  }
  /// Whether the desk was told something that begins so, at last.
  bool isTold(const QString& what) {
    return QTest::qWaitFor([&] {
      listen();
      return std::ranges::any_of(told_, [&](const QString& line) { return line.startsWith(what); });
    });
  }

 private slots:
  void initTestCase() { QVERIFY(desk_.bind(QHostAddress::LocalHost, 0)); }
  void init() {
    if (screenOn("DUMMY1") == nullptr) plug();
    folder_ = std::make_unique<QTemporaryDir>();
    told_.clear();
    wall_ = QDateTime({2026, 5, 4}, {12, 0});
    pipeline::CalibrateSettings venue;
    venue.rig = venue::VenueSettings{};
    auto folder = pipeline::createCalibration(folder_->filePath("venue").toStdString(), venue);
    for (const char* name : {"day", "night"}) pipeline::saveSet(folder, name);
  }

  void itBeginsByTheOneThatIsSaid_data() {
    QTest::addColumn<QString>("said");
    QTest::addColumn<bool>("timed");
    QTest::addColumn<QString>("opened");
    QTest::addColumn<QString>("name");
    QTest::newRow("the one in use") << "" << false << ""
                                    << "night";
    QTest::newRow("said") << "day" << false << "day"
                          << "day";
    QTest::newRow("by the time") << "" << true << "day"
                                 << "day";
    QTest::newRow("said, whatever the time says") << "night" << true << "night"
                                                  << "night";
  }
  void itBeginsByTheOneThatIsSaid() {
    QFETCH(QString, said);
    QFETCH(bool, timed);
    QFETCH(QString, opened);
    QFETCH(QString, name);
    ShowSettings wanted = settings();
    wanted.set = said.toStdString();
    if (timed) wanted.content.sets = {{{18, 0}, "night"}, {{8, 0}, "day"}};
    auto show = showOf(wanted);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(opened_, QStringList{opened});
    show->look();
    QCOMPARE(plays(), name);
    QCOMPARE(renderer_->prepared.load(), 0);
  }

  /// Prepared in the minute before, shown when it is time, and left alone until the next time.
  void theTimeOfTheDayChangesIt() {
    ShowSettings wanted = settings();
    wanted.content.sets = {{{18, 0}, "night"}, {{8, 0}, "day"}};
    auto show = showOf(wanted);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    wall_ = QDateTime({2026, 5, 4}, {17, 59, 20});
    show->look();
    QTRY_COMPARE(renderer_->prepared.load(), 1);
    QCOMPARE(plays(), QString("day"));
    wall_ = QDateTime({2026, 5, 4}, {18, 0});
    show->look();
    QTRY_COMPARE(plays(), QString("night"));
    QVERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(opened_.size(), 1);  // nothing was opened again
    send(*show, {"/set", {QString("day")}});
    QTRY_COMPARE(plays(), QString("day"));
    const qsizetype asked = log().count("preparing set night");
    show->look();
    QCOMPARE(log().count("preparing set night"), asked);
    QCOMPARE(plays(), QString("day"));
    wall_ = QDateTime({2026, 5, 5}, {8, 0});
    show->look();
    wall_ = QDateTime({2026, 5, 5}, {18, 0});
    show->look();
    QTRY_COMPARE(plays(), QString("night"));
  }

  void oscChangesIt() {
    ShowSettings wanted = settings();
    wanted.oscFeedback = NetworkPlace{QHostAddress::LocalHost, desk_.localPort()};
    auto show = showOf(wanted);
    QVERIFY(isTold("/set night"));
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    told_.clear();
    send(*show, {"/set", {QString("day")}});
    QVERIFY(isTold("/set/begun"));
    QVERIFY(isTold("/set/done shown day") && isTold("/set day"));
    QTRY_COMPARE(plays(), QString("day"));
    // Once more: done already.
    told_.clear();
    send(*show, {"/set", {QString("day")}});
    QVERIFY(isTold("/set/done shown day"));
    send(*show, {"/set", {QString("dusk")}});
    QVERIFY(isTold("/error /set"));
    QVERIFY(told_.filter("/error").first().contains("there is no set 'dusk'; choose one of day, night"));
    QCOMPARE(plays(), QString("day"));
    QVERIFY(log().contains("playing set day"));
  }

  /// One that is gone when it is its turn is a line of the log; a show that fails begins again by what it
  /// had.
  void whatCannotBeShownIsTold() {
    ShowSettings wanted = settings();
    wanted.content.sets = {{{18, 0}, "gone"}, {{8, 0}, "day"}};
    auto show = showOf(wanted);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    wall_ = QDateTime({2026, 5, 4}, {18, 0});
    show->look();
    QTRY_VERIFY(log().contains("there is no set 'gone'"));
    show->look();
    QCOMPARE(plays(), QString("day"));
    QCOMPARE(log().count("there is no set 'gone'"), 1);
    send(*show, {"/set", {QString("night")}});
    QTRY_COMPARE(plays(), QString("night"));
    renderer_->broken = true;
    show->player().setCompensated(false);
    QTRY_COMPARE_WITH_TIMEOUT(opened_.size(), 2, 10000);
    QCOMPARE(opened_.back(), QString("night"));
  }

  void itemsChangeIt() {
    ShowSettings wanted = settings();
    wanted.content.items = {{picture("a.png", 3), 86400.0}, {picture("b.png", 4), 86400.0, 25.0, "day"}};
    auto show = showOf(wanted);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QTRY_COMPARE(renderer_->prepared.load(), 1);  // of the next one, ahead
    QCOMPARE(plays(), QString("night"));
    send(*show, {"/next", {}});
    QTRY_COMPARE(plays(), QString("day"));
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 4));
    QCOMPARE(renderer_->prepared.load(), 1);
    send(*show, {"/next", {}});
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(plays(), QString("day"));  // it names none: as before
  }
};

QTEST_MAIN(TestShowSets)
#include "test_show_sets.moc"
