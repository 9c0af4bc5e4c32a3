// SPDX-License-Identifier: MIT
// A show whose calibration is checked, and whose pictures are perfected, from outside. Runs on two screens,
// see tests/support/with-two-screens.
#include "output/show_photography.h"

#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>
#include <atomic>
#include <thread>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "output/show.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/stored_settings.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

namespace {

/// Photographs until it is let go on.
struct ScriptedPhotography : ShowPhotography {
  struct Script {
    std::atomic<bool> goesOn = false, fails = false;
    std::atomic<int> begun = 0;
    Message whyNot;
    std::filesystem::path picture;
  };
  std::shared_ptr<Script> script;
  explicit ScriptedPhotography(std::shared_ptr<Script> by) : script(std::move(by)) {}

  void work(Progress& progress) const {
    ++script->begun;
    progress.report(0.5);
    while (!script->goesOn) {
      progress.checkpoint();
      std::this_thread::yield();
    }
    if (script->fails)
      throw Error(ErrorKind::device, Message::plain("the camera is gone"), Message::plain("plug it in"));
  }
  Message whyNot() const override { return script->whyNot; }
  pipeline::VerifyResult check(Progress& progress) override {
    work(progress);
    pipeline::VerifyResult result;
    result.judgement = {acquisition::Verdict::remeasure, Message::plain("a chair has been moved")};
    return result;
  }
  pipeline::PerfectedImage perfect(const std::filesystem::path& picture, const Canvas&, const std::string&,
                                   Progress& progress) override {
    script->picture = picture;
    work(progress);
    pipeline::PerfectedImage image;
    image.kept = true;
    return image;
  }
  pipeline::NightRecord tend(const pipeline::NightSettings&, bool, Progress&) override { return {}; }
};

}  // namespace

class TestShowPhotography : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  std::shared_ptr<ScriptedPhotography::Script> script_;
  QUdpSocket desk_;
  std::vector<OscMessage> heard_;

  std::unique_ptr<Show> showOf(const QStringList& items) {
    noise(projectorSize, 3).save(folder_->filePath("a.png"));
    ShowSettings settings;
    settings.canvas = {projectorSize, Fit::fill};
    settings.folder = folder_->filePath("log");
    settings.content.fadeSeconds = 0.0;
    settings.osc = NetworkPlace{QHostAddress::LocalHost, 0};
    for (const QString& item : items) settings.content.items.append({item, 86400.0});
    return std::make_unique<Show>(
        settings,
        [](const std::function<void(const QString&)>&, const std::string&) {
          return std::make_unique<ScriptedRenderer>();
        },
        MachineClock(), nullptr, std::make_unique<ScriptedPhotography>(script_));
  }
  QString state() const {
    QFile file(folder_->filePath("log/health.json"));
    return file.open(QIODevice::ReadOnly)
               ? QJsonDocument::fromJson(file.readAll()).object()["state"].toString()
               : QString();
  }
  void send(const Show& show, const char* address) {
    desk_.writeDatagram(oscDatagram({address, {}}), show.osc()->host, show.osc()->port);
  }
  /// What the desk was told at an address, so far; none: nothing.
  std::optional<OscMessage> heard(const char* address) {
    while (desk_.hasPendingDatagrams()) {
      QByteArray datagram(static_cast<qsizetype>(desk_.pendingDatagramSize()), Qt::Uninitialized);
      desk_.readDatagram(datagram.data(), datagram.size());
      const std::vector<OscMessage> messages = oscMessages(datagram).value_or(std::vector<OscMessage>());
      for (const OscMessage& message : messages) heard_.push_back(message);
    }
    const auto found = std::ranges::find(heard_, QString(address), &OscMessage::address);
    return found != heard_.end() ? std::optional(*found) : std::nullopt;
  }

 private slots:
  void init() {
    if (screenOn("DUMMY1") == nullptr) plug();
    folder_ = std::make_unique<QTemporaryDir>();
    script_ = std::make_shared<ScriptedPhotography::Script>();
    heard_.clear();
  }

  void theShowMakesWayAndGoesOn_data() {
    QTest::addColumn<QByteArray>("work");
    QTest::addColumn<bool>("fails");
    QTest::addColumn<QString>("verdict");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("check") << QByteArray("check") << false << "remeasure"
                           << "a chair has been moved.";
    QTest::newRow("perfect") << QByteArray("perfect") << false << "better"
                             << "the picture is better than it was, and shown so.";
    QTest::newRow("fails") << QByteArray("check") << true << "failed"
                           << "The camera is gone. Plug it in.";
  }
  void theShowMakesWayAndGoesOn() {
    QFETCH(QByteArray, work);
    QFETCH(bool, fails);
    QFETCH(QString, verdict);
    QFETCH(QString, sentence);
    script_->fails = fails;
    auto show = showOf({folder_->filePath("a.png")});
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    send(*show, "/" + work);
    QTRY_VERIFY(heard("/" + work + "/begun"));
    QTRY_VERIFY(heard("/" + work + "/progress"));
    QCOMPARE(state(), QString("photographing"));
    QVERIFY(seenOn("DUMMY1") != noise(projectorSize, 3));
    // Whoever looks after it meanwhile leaves it to the camera, and nobody begins twice.
    show->look();
    QCOMPARE(state(), QString("photographing"));
    send(*show, "/check");
    QTRY_VERIFY(heard("/error"));
    script_->goesOn = true;
    QTRY_VERIFY(heard("/" + work + "/done"));
    QCOMPARE(std::get<QString>(heard("/" + work + "/done")->arguments.at(0)), verdict);
    QCOMPARE(std::get<QString>(heard("/" + work + "/done")->arguments.at(1)), sentence);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(state(), QString("playing"));
    QCOMPARE(script_->begun.load(), 1);
    if (work == "perfect")
      QCOMPARE(QString::fromStdString(script_->picture.string()), folder_->filePath("a.png"));
  }

  void whatCannotBeIsAnswered_data() {
    QTest::addColumn<QByteArray>("work");
    QTest::addColumn<QString>("item");
    QTest::addColumn<bool>("black");
    QTest::addColumn<bool>("hasCamera");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("no camera") << QByteArray("check") << "a.png" << false << false << "no camera";
    QTest::newRow("no still picture")
        << QByteArray("perfect") << "chart:grid" << false << true << "no still picture";
    QTest::newRow("black") << QByteArray("check") << "a.png" << true << true << "the picture is black";
  }
  void whatCannotBeIsAnswered() {
    QFETCH(QByteArray, work);
    QFETCH(QString, item);
    QFETCH(bool, black);
    QFETCH(bool, hasCamera);
    QFETCH(QString, sentence);
    if (!hasCamera) script_->whyNot = Message::plain("this show has no camera");
    auto show = showOf({item.contains(':') ? item : folder_->filePath(item)});
    show->start();
    QTRY_VERIFY(show->player().statistics().frames > 0);
    show->player().setBlack(black);
    send(*show, "/" + work);
    QTRY_VERIFY(heard("/error"));
    const QString said = std::get<QString>(heard("/error")->arguments.at(1));
    QVERIFY2(said.contains(sentence), qPrintable(said));
    QCOMPARE(script_->begun.load(), 0);
    QCOMPARE(state(), QString("playing"));
  }

  void endingAShowEndsItsPhotographs() {
    auto show = showOf({folder_->filePath("a.png")});
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    send(*show, "/check");
    QTRY_COMPARE(script_->begun.load(), 1);
    show->stop();
    QCOMPARE(state(), QString("stopped"));
    QTest::qWait(0);
    QVERIFY(!heard("/check/done"));
  }

  /// By the devices of a calibration: a simulated one's see what they saw.
  void aSimulatedVenueIsStillGood() {
    venue::VenueSettings venue;
    venue.name = "plain";
    venue.projector = {24, 18};
    venue.camera = {20, 16};
    venue.pathsPerPixel = 16;
    pipeline::CalibrateSettings settings;
    settings.rig = venue;
    settings.linearization.levels = 5;
    const std::filesystem::path path = folder_->filePath("venue").toStdString();
    Progress quiet;
    pipeline::calibrate(path, settings, {}, quiet);
    const std::unique_ptr<ShowPhotography> photography = photographyOf(path, {});
    QVERIFY(photography->whyNot().empty());
    QVERIFY(photography->check(quiet).judgement.verdict == acquisition::Verdict::stillGood);
    noise({24, 18}, 3).save(folder_->filePath("b.png"));
    const pipeline::PerfectedImage image =
        photography->perfect(folder_->filePath("b.png").toStdString(), {{24, 18}, Fit::fill}, {}, quiet);
    QVERIFY2(image.failure.empty(), english(image.failure).c_str());
    QVERIFY(image.photographs > 0);
    pipeline::NightSettings night;
    night.images = {folder_->filePath("b.png").toStdString()};
    night.canvas.size = {24, 18};
    const pipeline::NightRecord tended = photography->tend(night, false, quiet);
    QVERIFY2(!isAlarm(tended), english(tended.alarm).c_str());
    QVERIFY(tended.repair == pipeline::RepairEnd::nothingToDo && tended.measured);
    QCOMPARE(pipeline::nightsOf(path).size(), 1);
  }

  void rigsWithoutACameraSaySo_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("a screen without a camera") << 0 << "has no camera";
    QTest::newRow("commands") << 1 << "shows pictures by a command of its own";
    QTest::newRow("a recording") << 2 << "has no camera";
  }
  void rigsWithoutACameraSaySo() {
    QFETCH(int, kind);
    QFETCH(QString, sentence);
    pipeline::CalibrateSettings settings;
    if (kind == 0) settings.rig = pipeline::ScreenRigSettings{{"DUMMY1", {}, {}, {}}, {1024, 768}};
    if (kind == 1)
      settings.rig =
          pipeline::CommandRigSettings{"show {image}", "photograph {exposure} {output}", {64, 48}, {}};
    if (kind == 2) settings.rig = pipeline::ReplayRigSettings{"recording"};
    const std::filesystem::path path = folder_->filePath("venue").toStdString();
    pipeline::createCalibration(path, settings);
    QVERIFY(mentions(english(photographyOf(path, {})->whyNot()), sentence.toStdString()));
    QVERIFY(mentions(english(photographyOf(path / "gone", {})->whyNot()), "gone"));
  }
};

QTEST_MAIN(TestShowPhotography)
#include "test_show_photography.moc"
