// SPDX-License-Identifier: MIT
#include "app/show_arguments.h"

#include <QDir>
#include <QtTest>

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::gui;

namespace {

std::string refusal(const QStringList& arguments) {
  try {
    parseShowArguments(QStringList{"relucent"} + arguments);
  } catch (const WrongArguments& error) {
    return error.what();
  }
  return {};
}

template <typename Command>
Command parsed(const QStringList& arguments) {
  return std::get<Command>(parseShowArguments(QStringList{"relucent"} + arguments));
}

}  // namespace

class TestShowArguments : public QObject {
  Q_OBJECT

 private slots:
  void everyOptionArrives() {
    ShowSettings settings = parsed<PlayShow>({"show",
                                              "venue",
                                              "--content",
                                              "a.png",
                                              "--schedule",
                                              "18:00-02:30",
                                              "--screen",
                                              "HDMI-1",
                                              "--screen",
                                              "DP-2",
                                              "--canvas",
                                              "1280x720",
                                              "--adaptive-range",
                                              "--backend",
                                              "cpu",
                                              "--log",
                                              "logs",
                                              "--osc",
                                              "7700",
                                              "--osc-address",
                                              "0.0.0.0",
                                              "--osc-feedback",
                                              "192.168.1.20:9000",
                                              "--camera-position",
                                              "-1,2.5",
                                              "--camera-position",
                                              "1,2.5,0.5"})
                                .settings;
    QVERIFY((settings.osc == NetworkPlace{QHostAddress("0.0.0.0"), 7700}));
    QVERIFY((settings.oscFeedback == NetworkPlace{QHostAddress("192.168.1.20"), 9000}));
    QVERIFY((settings.cameras == std::vector<compensation::Position>{{-1, 2.5, 0}, {1, 2.5, 0.5}}));
    QCOMPARE(settings.calibration, std::filesystem::path("venue"));
    QCOMPARE(settings.content.items.size(), qsizetype{1});
    QVERIFY((settings.hours == DailyHours{{18, 0}, {2, 30}}));
    QCOMPARE(settings.displays, (QStringList{"HDMI-1", "DP-2"}));
    QCOMPARE(settings.canvas.size, QSize(1280, 720));
    QVERIFY(settings.adaptiveRange);
    QCOMPARE(settings.backend, BackendChoice::cpu);
    QCOMPARE(settings.folder, QString("logs"));
  }

  void theDefaultsAreOff() {
    ShowSettings settings = parsed<PlayShow>({"show", "venue", "--content", "chart:grid"}).settings;
    QCOMPARE(settings.backend, BackendChoice::automatic);
    QVERIFY(!settings.adaptiveRange && !settings.brightness && !settings.hours &&
            settings.displays.isEmpty());
    QVERIFY(!settings.osc && !settings.oscFeedback && settings.cameras.empty() && !settings.watch);
    QVERIFY(!settings.fillsShadows);
    QCOMPARE(settings.content.items.front().path, QString("chart:grid"));
    QCOMPARE(settings.canvas.size, QSize(1920, 1080));
  }

  /// What is installed says the same again from any folder: paths begin at the root.
  void whatIsInstalledIsTheSameShow() {
    QStringList said{"show",     "my venue", "--content", "films/a.mp4", "--schedule",       "09:00-17:00",
                     "--screen", "HDMI-1",   "--canvas",  "640x480",     "--adaptive-range", "--loop",
                     "--log",    "logs",     "--backend", "opengl"};
    auto wanted = parsed<InstallShow>(said + QStringList{"--install-service"});
    QCOMPARE(wanted.start, Start::service);
    QVERIFY(wanted.arguments.contains(QDir::current().filePath("my venue")));
    ShowSettings first = parsed<PlayShow>(said).settings, again = parsed<PlayShow>(wanted.arguments).settings;
    QCOMPARE(again.calibration, std::filesystem::absolute(first.calibration));
    QVERIFY(again.content == first.content && again.hours == first.hours && again.displays == first.displays);
    QVERIFY(again.canvas.size == first.canvas.size && again.adaptiveRange &&
            again.backend == BackendChoice::openGl && again.folder == QDir::current().filePath("logs"));
    QCOMPARE(parsed<InstallShow>(said + QStringList{"--install-autostart"}).start, Start::autostart);
    QVERIFY(parsed<TextToPrint>({"show", "--osc", "7701", "--osc-template", "open-stage-control"})
                .text.contains("127.0.0.1:7701"));
    // Whoever adds it to the command line that he has.
    QVERIFY(parsed<TextToPrint>(
                {"show", "venue", "--content", "pictures", "--screen", "DUMMY1", "--osc-template", "csv"})
                .text.contains("/black"));
    QVERIFY(parsed<InstallShow>({"show", "v", "--content", "stream:rtsp://a/b", "--install-service"})
                .arguments.contains("stream:rtsp://a/b"));
    QVERIFY_THROWS_EXCEPTION(Error,
                             parseShowArguments({"relucent", "show", "v", "--content", "stream:file:///b"}));
    QVERIFY(parsed<InstallShow>({"show", "v", "--content", "screen:HDMI-1", "--install-service"})
                .arguments.contains("screen:HDMI-1"));
  }

  void setsAreSaidAndInstalled() {
    const QStringList said{"show",     "v",        "--content",  "chart:grid",
                           "--set",    "3. class", "--set-at",   "18:00=night=late",
                           "--set-at", "7:30=day", "--schedule", "06:00-23:00"};
    const auto wanted = parsed<InstallShow>(said + QStringList{"--install-service"});
    for (const ShowSettings& settings :
         {parsed<PlayShow>(said).settings, parsed<PlayShow>(wanted.arguments).settings}) {
      QCOMPARE(settings.set, std::string("3. class"));
      QVERIFY((settings.content.sets == QList<SetTime>{{{18, 0}, "night=late"}, {{7, 30}, "day"}}));
    }
    for (const char* wrong : {"18:00", "night", "25:00=night", "18:00=", "=night"})
      QVERIFY(refusal({"show", "v", "--content", "a", "--set-at", wrong}).find("write HH:MM=NAME") !=
              std::string::npos);
    QVERIFY(refusal({"show", "v", "--content", "a", "--set-at", "1:00=a", "--set-at", "01:00=b"})
                .find("two sets are to be shown from 01:00 on") != std::string::npos);
    QVERIFY(refusal({"show", "v", "--content", "a", "--set", " x"}).find("--set: the name of a set") !=
            std::string::npos);
  }

  void nightsAreSaidAndInstalled() {
    const QStringList said{
        "show",  "v",          "--content",   "chart:grid", "--night",
        "after", "--schedule", "09:00-18:00", "--alarm",    "/opt/call {sentence} \"$HOME\" 100%"};
    const auto wanted = parsed<InstallShow>(said + QStringList{"--install-service"});
    for (const ShowSettings& settings :
         {parsed<PlayShow>(said).settings, parsed<PlayShow>(wanted.arguments).settings}) {
      QVERIFY(settings.night == QTime(18, 0));
      QCOMPARE(settings.alarmCommand, std::string("/opt/call {sentence} \"$HOME\" 100%"));
    }
    QVERIFY(parsed<PlayShow>({"show", "v", "--content", "a", "--night", "3:00"}).settings.night ==
            QTime(3, 0));
  }

  void controlsOfWhatIsInstalledAreTheSame() {
    const QStringList said{"show",
                           "v",
                           "--content",
                           "chart:grid",
                           "--osc",
                           "7700",
                           "--osc-feedback",
                           "[::1]:9000",
                           "--camera-position",
                           "0,1",
                           "--camera-position",
                           "2,1"};
    const auto wanted = parsed<InstallShow>(said + QStringList{"--install-service"});
    const ShowSettings first = parsed<PlayShow>(said).settings,
                       again = parsed<PlayShow>(wanted.arguments).settings;
    QVERIFY(again.osc == first.osc && again.oscFeedback == first.oscFeedback &&
            again.cameras == first.cameras);
    // Nobody else hears it unless told so.
    QVERIFY((again.osc == NetworkPlace{QHostAddress(QHostAddress::LocalHost), 7700}) && again.oscFeedback);
  }

  void projectorsAndStatusAreSaidAndInstalled() {
    const QStringList said{"show",
                           "v",
                           "--content",
                           "chart:grid",
                           "--status",
                           "8080",
                           "--switch-projectors",
                           "--power-off-after",
                           "10",
                           "--close-shutter",
                           "--watch",
                           "2",
                           "--fill-shadows"};
    const auto wanted = parsed<InstallShow>(said + QStringList{"--install-service"});
    for (const ShowSettings& settings :
         {parsed<PlayShow>(said).settings, parsed<PlayShow>(wanted.arguments).settings}) {
      // Nobody else sees it unless told so.
      QVERIFY((settings.status == NetworkPlace{QHostAddress(QHostAddress::LocalHost), 8080}));
      QVERIFY(settings.switchesPower && settings.closesShutter);
      QVERIFY(settings.powerOffAfter == std::chrono::minutes(10));
      QVERIFY((settings.watch == pipeline::WatchSettings{1, {}}) && settings.fillsShadows);
    }
    const ShowSettings usual = parsed<PlayShow>({"show", "v", "--content", "chart:grid"}).settings;
    QVERIFY(!usual.status && !usual.switchesPower && !usual.closesShutter && !usual.powerOffAfter);
  }

  void wrongProjectorsAndStatus_data() {
    QTest::addColumn<QStringList>("more");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("no port") << QStringList{"--status", "http"} << "the port of --status must be 1 to 65535";
    QTest::newRow("no number") << QStringList{"--status", "80", "--status-address", "here"}
                               << "must be a number";
    QTest::newRow("address alone") << QStringList{"--status-address", "0.0.0.0"} << "needs --status PORT";
    QTest::newRow("off after what") << QStringList{"--power-off-after", "10"} << "needs --switch-projectors";
    QTest::newRow("shadows that nobody sees") << QStringList{"--fill-shadows"} << "say which, as --watch 1";
    QTest::newRow("no camera") << QStringList{"--watch", "0"} << "is no camera";
    QTest::newRow("camera without a kind") << QStringList{"--watch", "webcam"} << "is no camera";
    QTest::newRow("off at once") << QStringList{"--switch-projectors", "--power-off-after", "0"}
                                 << "1 to 1440 minutes";
  }
  void wrongProjectorsAndStatus() {
    QFETCH(QStringList, more);
    QFETCH(QString, sentence);
    try {
      parseShowArguments(QStringList{"relucent", "show", "v", "--content", "chart:grid"} + more);
      QFAIL("it was understood");
    } catch (const WrongArguments& error) {
      QVERIFY2(QString(error.what()).contains(sentence), error.what());
    }
  }

  void aCameraMayWatchFromAnotherPlace() {
    const ShowSettings settings =
        parsed<PlayShow>({"show", "v", "--content", "chart:grid", "--watch", "v4l2:/dev/video1"}).settings;
    QVERIFY((settings.watch == pipeline::WatchSettings{0, "v4l2:/dev/video1"}));
  }

  void itsWhiteIsTheSame() {
    const QStringList said{"show", "v", "--content", "chart:grid", "--brightness", "region"};
    const auto wanted = parsed<InstallShow>(said + QStringList{"--install-service"});
    QVERIFY(parsed<PlayShow>(said).settings.brightness == compensation::Brightness::region);
    QVERIFY(parsed<PlayShow>(wanted.arguments).settings.brightness == compensation::Brightness::region);
  }

  void isTakenAwayWithoutSayingWhat() {
    QCOMPARE(parsed<UninstallShow>({"show", "--remove-service"}).start, Start::service);
    QCOMPARE(parsed<UninstallShow>({"show", "--remove-autostart"}).start, Start::autostart);
  }

  void helpNamesEveryOption() {
    QString help = parsed<TextToPrint>({"--help"}).text;
    for (const char* option :
         {"--content", "--loop", "--schedule", "--screen", "--canvas", "--adaptive-range", "--brightness",
          "--backend", "--log", "--osc", "--osc-address", "--osc-feedback", "--camera-position",
          "--install-service", "--install-autostart", "--remove-service"})
      QVERIFY2(help.contains(option), option);
  }

  void wrongOnesAreNamed_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("part");
    QStringList right{"show", "venue", "--content", "a.png"};
    QTest::newRow("nothing") << QStringList{} << "usage";
    QTest::newRow("another command") << QStringList{"play", "venue"} << "usage";
    QTest::newRow("two venues") << right + QStringList{"other"} << "usage";
    QTest::newRow("no such controller")
        << QStringList{"show", "--osc-template", "abacus"} << "open-stage-control";
    QTest::newRow("no content") << QStringList{"show", "venue"} << "--content";
    QTest::newRow("unknown option") << right + QStringList{"--fast"} << "fast";
    QTest::newRow("no size") << right + QStringList{"--canvas", "7x7"} << "WIDTHxHEIGHT";
    QTest::newRow("no backend") << right + QStringList{"--backend", "fast"} << "automatic";
    QTest::newRow("no brightness") << right + QStringList{"--brightness", "bright"} << "picture or region";
    QTest::newRow("two brightnesses")
        << right + QStringList{"--brightness", "even", "--adaptive-range"} << "one of them";
    QTest::newRow("no hours") << right + QStringList{"--schedule", "9-5"} << "HH:MM-HH:MM";
    QTest::newRow("no port") << right + QStringList{"--osc", "0"} << "1 to 65535";
    QTest::newRow("no number") << right + QStringList{"--osc", "desk"} << "1 to 65535";
    QTest::newRow("no address") << right + QStringList{"--osc", "7700", "--osc-address", "here"}
                                << "127.0.0.1";
    QTest::newRow("no feedback") << right + QStringList{"--osc", "7700", "--osc-feedback", "desk:1"}
                                 << "HOST:PORT";
    QTest::newRow("feedback alone") << right + QStringList{"--osc-feedback", "127.0.0.1:1"} << "--osc PORT";
    QTest::newRow("no position") << right + QStringList{"--camera-position", "1"} << "x,y or x,y,z";
    QTest::newRow("an endless one") << right + QStringList{"--camera-position", "1,inf"} << "x,y or x,y,z";
    QTest::newRow("no night") << right + QStringList{"--night", "late"} << "HH:MM";
    QTest::newRow("a night after no hours") << right + QStringList{"--night", "after"} << "--schedule";
    QTest::newRow("a night within the hours")
        << right + QStringList{"--schedule", "09:00-18:00", "--night", "17:59"} << "outside the hours";
    QTest::newRow("an alarm without nights") << right + QStringList{"--alarm", "./call.sh"} << "--night";
    QTest::newRow("a rehearsal to install")
        << right + QStringList{"--rehearse-time", "time", "--install-service"} << "real time";
    QTest::newRow("no time between") << right + QStringList{"--schedule", "09:00-09:00"} << "HH:MM-HH:MM";
  }
  void wrongOnesAreNamed() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, part);
    std::string said = refusal(arguments);
    QVERIFY2(said.find(part.toStdString()) != std::string::npos, said.c_str());
  }
};

QTEST_GUILESS_MAIN(TestShowArguments)
#include "test_show_arguments.moc"
