// SPDX-License-Identifier: MIT
// Runs on two screens that can be unplugged, see tests/support/with-two-screens.
#include "output/show.h"
#include "relucent/base/message.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "support/sentences.h"
#include "support/stream_sender.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

class TestShow : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  int made_ = 0;
  std::string openedBy_;  // the set that the last renderer was made for
  bool broken_ = false, cannotBeMade_ = false;

  QString picture(const char* name, quint32 seed) {
    QString file = folder_->filePath(name);
    noise(projectorSize, seed).save(file);
    return file;
  }
  ShowSettings settings(const QStringList& files) {
    ShowSettings settings;
    settings.canvas = {projectorSize, Fit::fill};
    settings.folder = folder_->filePath("log");
    settings.content.fadeSeconds = 0.0;
    for (const QString& file : files) settings.content.items.append({file, 86400.0});
    return settings;
  }
  QDateTime wall_;
  std::chrono::nanoseconds slept_{0};
  std::function<void(const QString&)> warn_;
  std::unique_ptr<Show> showOf(const ShowSettings& settings, std::unique_ptr<WatchSource> watch = nullptr) {
    made_ = 0;
    MachineClock clock{[this] { return wall_; }, [this] { return slept_; }};
    return std::make_unique<Show>(
        settings,
        [this](const std::function<void(const QString&)>& warn, const std::string& set) {
          openedBy_ = set;
          warn_ = warn;
          if (cannotBeMade_)
            throw Error(ErrorKind::input, Message::plain("the calibration is gone"),
                        Message::plain("bring it back"));
          auto renderer = std::make_unique<ScriptedRenderer>();
          renderer->broken = broken_;
          ++made_;
          return renderer;
        },
        clock, nullptr, nullptr, std::move(watch));
  }
  QJsonObject health() {
    QFile file(folder_->filePath("log/health.json"));
    return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
  }
  QString log() {
    QFile file(folder_->filePath("log/show.log"));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
  }

 private slots:
  void init() {
    if (screenOn("DUMMY1") == nullptr) plug();
    folder_ = std::make_unique<QTemporaryDir>();
    broken_ = cannotBeMade_ = false;
    wall_ = QDateTime({2026, 5, 4}, {12, 0});
    slept_ = {};
  }

  void playsTellsItsHealthAndEndsBlack() {
    auto show = showOf(settings({picture("a.png", 3)}));
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(health()["state"].toString(), QString("playing"));
    QCOMPARE(health()["renderer"].toString(), QString("scripted"));
    QCOMPARE(health()["displays"].toArray().size(), 1);
    QVERIFY(health()["displays"][0]["shining"].toBool());
    show->stop();
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    QCOMPARE(health()["state"].toString(), QString("stopped"));
    QVERIFY(log().contains("playing 1 items on scripted") && log().contains("stopped"));
  }

  /// With OpenGL and without: see CMakeLists.txt. A show that begins again does not say it twice.
  void whatItDrawsWithIsTold() {
    bool hasOpenGl = qEnvironmentVariable("QT_XCB_GL_INTEGRATION") != "none";
    broken_ = true;
    auto show = showOf(settings({picture("a.png", 3)}));
    show->start();
    broken_ = false;
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(made_, 2);
    QCOMPARE(health()["displays"][0]["drawn_by"].toString(), QString(hasOpenGl ? "OpenGL" : "memory"));
    QCOMPARE(log().count("there is no OpenGL"), hasOpenGl ? 0 : 1);
  }

  /// The show goes on as if nobody had wanted to watch it.
  void aWatchThatCannotBeginDisturbsNoShow() {
    struct Nothing : WatchSource {
      pipeline::WatchingCamera read(Progress&) override {
        throw Error(ErrorKind::input, Message::plain("the calibration names no camera"),
                    Message::plain("name one"));
      }
      void open(pipeline::WatchingCamera&) override {}
    };
    ShowSettings wanted = settings({picture("a.png", 3)});
    auto plain = showOf(wanted);
    plain->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QVERIFY(!health().contains("watch"));
    plain.reset();
    wanted.watch.emplace();
    auto show = showOf(wanted, std::make_unique<Nothing>());
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QTRY_COMPARE(health()["watch"].toObject()["state"].toString(), QString("no calibration"));
    QVERIFY(health()["watch"].toObject()["problem"].toString().contains("names no camera"));
    QCOMPARE(log().count("nobody watches the show: the calibration names no camera"), 1);
    QCOMPARE(health()["state"].toString(), QString("playing"));
  }

  /// A password that somebody wrote into a list stays there.
  void aStreamIsWatchedAndItsPasswordKept() {
    test::HttpSender sender;
    const QString place = QString("127.0.0.1:%1").arg(sender.port());
    auto show = showOf(settings({"stream:http://user:secret@" + place + "/mjpeg?key=secret"}));
    show->start();
    const auto stream = [this] { return health()["streams"].toArray().at(0).toObject(); };
    QTRY_COMPARE(stream()["state"].toString(), QString("playing"));
    QCOMPARE(stream()["size"].toString(), QString("64x48"));
    QTRY_VERIFY(show->player().statistics().liveSeconds > 0.0);
    QVERIFY(show->player().statistics().liveSeconds < 5.0);
    show->look();
    QVERIFY(health()["live_milliseconds"].toDouble() > 0.0);
    sender.stop();
    QTRY_COMPARE(stream()["state"].toString(), QString("lost"));
    QVERIFY(sender.start());
    QTRY_COMPARE_WITH_TIMEOUT(stream()["state"].toString(), QString("playing"), 10'000);
    show->stop();
    QFile file(folder_->filePath("log/health.json"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString all = log() + QString::fromUtf8(file.readAll());
    for (const char* line : {"connecting to http://", "plays, 64x48", "is lost: ", "is back after"})
      QCOMPARE(log().count(line), 1);
    QVERIFY(all.contains(place) && !all.contains("secret"));
  }

  void whatTheRendererSaysStandsInTheLog() {
    auto show = showOf(settings({picture("a.png", 3)}));
    warn_("the card is gone");
    QVERIFY(log().contains("warning the card is gone"));
  }

  void aLostDisplayIsToldAndWaitedFor() {
    auto show = showOf(settings({picture("a.png", 3)}));
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    unplug();
    QTRY_VERIFY(!health()["displays"][0]["shining"].toBool());
    QVERIFY(log().contains("display lost: DUMMY1"));
    plug();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QTRY_VERIFY(health()["displays"][0]["shining"].toBool());
    QVERIFY(log().contains("display back: DUMMY1"));
  }

  void displaysThatSleepAreWokenAndItIsTold_data() { addWaysToSleep(); }
  void displaysThatSleepAreWokenAndItIsTold() {
    QFETCH(QStringList, sleep);
    if (QString why = whyNoSleep(sleep); !why.isEmpty()) QSKIP(qPrintable(why));
    const DisplayPower power;
    xset(sleep);
    auto show = showOf(settings({picture("a.png", 3)}));
    show->start();
    QVERIFY(power.state() == DisplayPower::State::awake);
    QCOMPARE(log().count("have been woken"), 1);
    show->look();
    QCOMPARE(log().count("have been woken"), 1);
    xset(sleep);
    show->look();
    QVERIFY(power.state() == DisplayPower::State::awake);
    QCOMPARE(log().count("have been woken"), 2);
  }

  void playsAtItsHoursAndIsBlackBetweenThem() {
    ShowSettings wanted = settings({picture("a.png", 3)});
    wanted.hours = DailyHours{{18, 0}, {2, 30}};
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    QCOMPARE(health()["state"].toString(), QString("resting"));
    QVERIFY(log().contains("black until 18:00") && health()["displays"][0]["shining"].toBool());
    for (int day = 0; day < 2; ++day) {
      wall_ = QDateTime({2026, 5, 4 + day}, {18, 0});
      show->look();
      QCOMPARE(health()["state"].toString(), QString("playing"));
      QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
      wall_ = QDateTime({2026, 5, 5 + day}, {2, 29, 59});
      show->look();
      QCOMPARE(health()["state"].toString(), QString("playing"));
      wall_ = QDateTime({2026, 5, 5 + day}, {2, 30});
      show->look();
      QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
      QCOMPARE(health()["state"].toString(), QString("resting"));
    }
  }

  /// The lid was closed in the evening and opened in the morning: told, and played on by the hour that it is.
  void survivesTheMachinesSleep() {
    ShowSettings wanted = settings({picture("a.png", 3)});
    wanted.hours = DailyHours{{9, 0}, {21, 0}};
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    slept_ = std::chrono::hours(12);
    wall_ = QDateTime({2026, 5, 5}, {0, 0});
    show->look();
    QVERIFY(log().contains("slept for 43200 s"));
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    wall_ = QDateTime({2026, 5, 5}, {9, 0});
    show->look();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(log().count("slept"), 1);
    // Set back by an hour: the clock on the wall rules.
    wall_ = QDateTime({2026, 5, 5}, {8, 0});
    show->look();
    QCOMPARE(health()["state"].toString(), QString("resting"));
  }

  void beginsAgainAfterAFailure() {
    broken_ = true;
    auto show = showOf(settings({picture("a.png", 3)}));
    show->start();
    QTRY_COMPARE(health()["state"].toString(), QString("failed"));
    QVERIFY(log().contains("the graphics card is gone"));
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    cannotBeMade_ = true;
    QTRY_VERIFY(log().contains("the calibration is gone"));
    broken_ = cannotBeMade_ = false;
    QTRY_VERIFY_WITH_TIMEOUT(seenOn("DUMMY1") == noise(projectorSize, 3), 20'000);
    QCOMPARE(health()["state"].toString(), QString("playing"));
  }

  /// By datagrams of another program, as a desk sends them.
  void isControlledByOsc() {
    ShowSettings wanted = settings({picture("a.png", 3), picture("b.png", 4)});
    wanted.osc = NetworkPlace{QHostAddress::LocalHost, 0};
    auto show = showOf(wanted);
    QVERIFY(log().contains("listening to OSC at 127.0.0.1:"));
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QUdpSocket desk;
    const auto send = [&](const OscMessage& message) {
      desk.writeDatagram(oscDatagram(message), show->osc()->host, show->osc()->port);
    };
    send({"/black", {1.0}});
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    QTRY_VERIFY(health()["black"].toBool());
    send({"/black", {0.0}});
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    send({"/item", {2.0}});
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 4));
    send({"/next", {}});
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    send({"/chart", {QString("white")}});
    QTRY_VERIFY(show->player().chart() == TestChart::white);
    send({"/chart", {QString("none")}});
    QTRY_VERIFY(!show->player().chart());
    send({"/pause", {}});
    QTRY_VERIFY(show->player().isFrozen());
    send({"/play", {}});
    QTRY_VERIFY(!show->player().isFrozen());
    send({"/compensation", {0.0}});
    QTRY_VERIFY(!show->player().isCompensated());
    send({"/brightness", {0.5}});
    QTRY_COMPARE(show->player().brightness(), 0.5);
    // It is not known where the cameras stand.
    for (int word = 0; word < 20; ++word) send({"/viewer", {1.0, 2.0, 3.0}});
    QTRY_VERIFY(log().contains("--camera-position"));
    send({"/black", {1.0}});
    QTRY_VERIFY(show->player().isBlack());
    QCOMPARE(log().count("/viewer"), 1);
  }

  /// What a desk has switched off stays off when the show has to begin again.
  void aFailureDoesNotUndoWhatADeskSaid() {
    ShowSettings wanted = settings({picture("a.png", 3)});
    wanted.osc = NetworkPlace{QHostAddress::LocalHost, 0};
    broken_ = true;
    auto show = showOf(wanted);
    show->player().setBlack(true);
    show->player().setBrightness(0.5);
    show->start();
    broken_ = false;
    QTRY_COMPARE(made_, 2);
    QVERIFY(show->player().isBlack());
    QCOMPARE(show->player().brightness(), 0.5);
  }

  void aTakenPortIsTriedAgain() {
    QUdpSocket other;
    QVERIFY(other.bind(QHostAddress::LocalHost, 0, QAbstractSocket::DontShareAddress));
    ShowSettings wanted = settings({picture("a.png", 3)});
    wanted.osc = NetworkPlace{QHostAddress::LocalHost, other.localPort()};
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    show->look();
    QVERIFY(!show->osc());
    QCOMPARE(log().count("OSC messages cannot be received"), 1);
    other.close();
    show->look();
    QVERIFY(show->osc() == wanted.osc);
  }

  void whatCannotBeReadIsNamed() {
    ShowSettings wanted = settings({folder_->filePath("gone.png"), picture("b.png", 4)});
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 4));
    show->stop();
    QCOMPARE(health()["skipped"].toInt(), 1);
    QVERIFY(log().contains("gone.png"));
  }

  /// Law: each loss of a file is told, and each return, however often.
  void whatIsLostAgainIsToldAgain() {
    ShowSettings wanted = settings({picture("a.png", 3), picture("b.png", 4)});
    for (PlaylistItem& item : wanted.content.items) item.seconds = 0.1;
    auto show = showOf(wanted);
    show->start();
    const auto told = [&](const char* what) {
      show->look();
      return log().count(what);
    };
    for (int time = 1; time <= 2; ++time) {
      QVERIFY(QFile::rename(folder_->filePath("b.png"), folder_->filePath("away.png")));
      QTRY_COMPARE(told("warning skipped: "), time);
      QCOMPARE(health()["skipped"].toInt(), 1);
      QVERIFY(QFile::rename(folder_->filePath("away.png"), folder_->filePath("b.png")));
      QTRY_COMPARE(told("no longer: "), time);
      QCOMPARE(health()["skipped"].toInt(), 0);
    }
  }

  void displaysAreChosenBySizeOrName() {
    QCOMPARE(displaysFor({projectorSize}, {}).front().connector, QString("DUMMY1"));
    QCOMPARE(displaysFor({projectorSize}, {"DUMMY0"}).front().connector,
             QString("DUMMY0"));  // named on purpose
    QCOMPARE(displaysFor({projectorSize}, {"HDMI-7"}).front().connector, QString("HDMI-7"));  // not there yet
    auto sentence = [](const std::vector<QSize>& sizes, const QStringList& named) {
      return sentenceOf([&] { displaysFor(sizes, named); }, ErrorKind::input);
    };
    QVERIFY(mentions(sentence({QSize(1920, 1200)}, {}), "1920x1200"));
    QVERIFY(mentions(sentence({QSize(1366, 768)}, {}), "operator's"));  // there, and not to be taken
    QVERIFY(mentions(sentence({projectorSize, projectorSize}, {}), "DUMMY1 (1024x768)"));
    QVERIFY(mentions(sentence({projectorSize, projectorSize}, {}),
                     "each of the 2 projectors needs a display of its own"));
    QVERIFY(mentions(sentence({projectorSize, projectorSize}, {}), "for projector 2"));
    QVERIFY(mentions(sentence({projectorSize}, {"A", "B"}), "2 displays are named for 1"));
  }
};

QTEST_MAIN(TestShow)
#include "test_show.moc"
