// SPDX-License-Identifier: MIT
// A show whose venue is tended at night. Runs on two screens, see tests/support/with-two-screens.
#include "output/show_nights.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>
#include <atomic>
#include <thread>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "output/show.h"
#include "relucent/base/file.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/stored_settings.h"
#include "remote/status_page.h"
#include "support/fake_projector.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;

namespace {

constexpr int patience = 15'000;

/// Tends until it is let go on, and leaves a line in the history.
struct ScriptedNights : ShowPhotography {
  struct Script {
    std::atomic<bool> goesOn = false;
    std::atomic<int> begun = 0;
    std::filesystem::path calibration;
    pipeline::NightRecord night;
    std::function<void()> meanwhile = [] {};
    Message whyNot;
    pipeline::NightSettings work;
    bool switchesOn = false;
  };
  std::shared_ptr<Script> script;
  explicit ScriptedNights(std::shared_ptr<Script> by) : script(std::move(by)) {}

  Message whyNot() const override { return script->whyNot; }
  pipeline::VerifyResult check(Progress&) override { return {}; }
  pipeline::PerfectedImage perfect(const std::filesystem::path&, const Canvas&, const std::string&,
                                   Progress&) override {
    return {};
  }
  pipeline::NightRecord tend(const pipeline::NightSettings& work, bool switchesOn,
                             Progress& progress) override {
    script->work = work;
    script->switchesOn = switchesOn;
    ++script->begun;
    while (!script->goesOn) {
      progress.checkpoint();
      std::this_thread::yield();
    }
    script->meanwhile();
    pipeline::NightRecord night = script->night;
    pipeline::closeNight(script->calibration, night, work.alarmCommand);
    return night;
  }
};

}  // namespace

class TestShowNights : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  std::shared_ptr<ScriptedNights::Script> script_;
  QDateTime wall_;
  int made_ = 0;
  ScriptedRenderer* renderer_ = nullptr;

  std::filesystem::path calibration() const { return folder_->filePath("venue").toStdString(); }
  ShowSettings settings() {
    noise(projectorSize, 3).save(folder_->filePath("a.png"));
    ShowSettings settings;
    settings.calibration = calibration();
    settings.canvas = {projectorSize, Fit::fill};
    settings.folder = folder_->filePath("log");
    settings.content.fadeSeconds = 0.0;
    settings.content.items.append({folder_->filePath("a.png"), 86400.0});
    settings.content.items.append({"chart:grid", 10.0});
    settings.hours = DailyHours{{9, 0}, {18, 0}};
    settings.night = QTime(18, 0);
    return settings;
  }
  std::unique_ptr<Show> showOf(const ShowSettings& settings) {
    MachineClock clock{[this] { return wall_; }, [] { return std::chrono::nanoseconds(0); }};
    return std::make_unique<Show>(
        settings,
        [this](const std::function<void(const QString&)>&, const std::string&) {
          ++made_;
          auto renderer = std::make_unique<ScriptedRenderer>();
          renderer_ = renderer.get();
          return renderer;
        },
        clock, nullptr, std::make_unique<ScriptedNights>(script_));
  }
  QJsonObject health() const {
    QFile file(folder_->filePath("log/health.json"));
    return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
  }
  QJsonObject night() const { return health()["night"].toObject(); }
  QString state() const { return health()["state"].toString(); }
  std::vector<pipeline::NightRecord> nights() const { return pipeline::nightsOf(calibration()); }
  void addNightAt(const char* when) {
    pipeline::NightRecord night;
    night.when = when;
    night.repair = pipeline::RepairEnd::nothingToDo;
    pipeline::addNight(calibration(), night);
  }
  static QDateTime time(int day, int hour, int minute = 0) { return {{2026, 5, day}, {hour, minute}}; }

 private slots:
  void init() {
    if (screenOn("DUMMY1") == nullptr) plug();
    folder_ = std::make_unique<QTemporaryDir>();
    QDir(folder_->path()).mkdir("venue");
    script_ = std::make_shared<ScriptedNights::Script>();
    script_->calibration = calibration();
    script_->night.when = "2026-05-04T18:00:00Z";
    script_->night.repair = pipeline::RepairEnd::repaired;
    script_->night.measured = script_->night.predicted = pipeline::PictureError{30.0, 1.5};
    wall_ = time(4, 12);
    made_ = 0;
  }

  /// Law: within the hours nothing is photographed; when they end the venue is tended once, and the show is
  /// black again until the next day.
  void theVenueIsTendedAfterTheHours() {
    auto show = showOf(settings());
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    wall_ = time(4, 17, 59);
    show->look();
    QCOMPARE(state(), QString("playing"));
    QCOMPARE(night()["next"].toString(), QString("2026-05-04T18:00:00"));
    wall_ = time(4, 18);
    show->look();
    QCOMPARE(state(), QString("photographing"));
    QTRY_COMPARE(script_->begun.load(), 1);
    QTRY_VERIFY(seenOn("DUMMY1") != noise(projectorSize, 3));
    QCOMPARE(script_->work.images.size(), 1);  // of the playlist, the stills
    QVERIFY((script_->work.canvas.size == Size{projectorSize.width(), projectorSize.height()}));
    wall_ = time(4, 18, 20);
    show->look();
    QCOMPARE(state(), QString("photographing"));
    script_->goesOn = true;
    QTRY_COMPARE(state(), QString("resting"));
    QCOMPARE(nights().size(), 1);
    QCOMPARE(night()["delta_e"].toDouble(), 1.5);
    QVERIFY(!health().contains("alarm"));
    for (int minute : {21, 59}) {
      wall_ = time(4, 18, minute);
      show->look();
    }
    QCOMPARE(script_->begun.load(), 1);
    wall_ = time(5, 9);
    show->look();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    wall_ = time(5, 18);
    show->look();
    QTRY_COMPARE(script_->begun.load(), 2);
  }

  void aShowWithoutHoursPlaysOn() {
    ShowSettings wanted = settings();
    wanted.hours.reset();
    wanted.night = QTime(3, 0);
    script_->goesOn = true;
    wall_ = time(4, 2, 50);
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    show->look();
    QCOMPARE(state(), QString("playing"));
    wall_ = time(4, 3, 1);
    show->look();
    QTRY_COMPARE(nights().size(), 1);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(state(), QString("playing"));
  }

  /// Law: the audience has its show at its hour, whatever the night was doing, and is told why it was not
  /// done.
  void theHoursEndTheNight() {
    ShowSettings wanted = settings();
    wanted.night = QTime(8, 30);
    wall_ = time(4, 8);
    auto show = showOf(wanted);
    show->start();
    wall_ = time(4, 8, 31);
    show->look();
    QTRY_COMPARE(script_->begun.load(), 1);
    wall_ = time(4, 9);
    show->look();
    QTRY_COMPARE(state(), QString("playing"));
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(nights().size(), 1);
    QCOMPARE(nights().front().skipped.id(), std::string("night.hours-began"));
    QVERIFY(night()["outcome"].toString().contains("hours began"));
    QVERIFY(!health().contains("alarm"));
    show->look();
    QCOMPARE(nights().size(), 1);
  }

  void nightsThatCouldNotBeAreTold_data() {
    QTest::addColumn<bool>("history");
    QTest::addColumn<QDateTime>("started");
    QTest::addColumn<int>("begun");
    QTest::addColumn<int>("skipped");
    // The night's time is 03:00.
    QTest::newRow("the first one is to come") << false << time(4, 3, 30) << 0 << 0;
    QTest::newRow("gone on with after a power cut") << true << time(4, 3, 30) << 1 << 0;
    QTest::newRow("the computer was off") << true << time(4, 7) << 0 << 1;
    QTest::newRow("for days") << true << time(9, 7) << 0 << 1;
  }
  void nightsThatCouldNotBeAreTold() {
    QFETCH(bool, history);
    QFETCH(QDateTime, started);
    QFETCH(int, begun);
    QFETCH(int, skipped);
    if (history) addNightAt("2026-05-03T01:20:00Z");
    ShowSettings wanted = settings();
    wanted.night = QTime(3, 0);
    wall_ = started;
    script_->goesOn = true;
    auto show = showOf(wanted);
    show->start();
    for (int look = 0; look < 3; ++look) {
      show->look();
      QTRY_COMPARE(state(), QString("resting"));
    }
    QCOMPARE(script_->begun.load(), begun);
    QCOMPARE(static_cast<int>(nights().size()), int(history) + begun + skipped);
    QCOMPARE(!nights().empty() && !nights().back().skipped.empty(), skipped == 1);
  }

  /// The same alarm calls once, and stands in the health file until a night is well.
  void anAlarmIsToldByHealthAndCommand() {
    ShowSettings wanted = settings();
    const QString calls = folder_->filePath("calls");
    wanted.alarmCommand = "echo {sentence} >>" + calls.toStdString();
    wanted.status = NetworkPlace{QHostAddress::LocalHost, 0};
    script_->goesOn = true;
    script_->night.alarm = Message::plain("the lamp is <off>");
    auto show = showOf(wanted);
    show->start();
    const auto tendedOn = [&](int day) {
      wall_ = time(day, 18);
      show->look();
      QTRY_COMPARE(script_->begun.load(), day - 3);
      QTRY_COMPARE(state(), QString("resting"));
    };
    tendedOn(4);
    tendedOn(5);
    QCOMPARE(health()["alarm"].toString(), QString("the lamp is <off>."));
    QCOMPARE(QString::fromStdString(readFile(calls.toStdString())), QString("the lamp is <off>.\n"));
    const QString page = QString::fromUtf8(StatusPage::html(health()));
    QVERIFY(page.contains("role=\"alert\"") && page.contains("the lamp is &lt;off&gt;."));
    // Another show of this venue knows of it.
    show.reset();
    show = showOf(wanted);
    show->start();
    QCOMPARE(health()["alarm"].toString(), QString("the lamp is <off>."));
    script_->night.alarm = {};
    tendedOn(6);
    QVERIFY(!health().contains("alarm"));
    QVERIFY(!StatusPage::html(health()).contains("role=\"alert\""));
  }

  void aShowWithoutACameraSaysSo() {
    ShowSettings wanted = settings();
    wanted.alarmCommand = "echo {sentence} >" + folder_->filePath("calls").toStdString();
    script_->whyNot = Message::plain("this show has no camera");
    auto show = showOf(wanted);
    show->start();
    wall_ = time(4, 18);
    show->look();
    QCOMPARE(state(), QString("resting"));
    QCOMPARE(health()["alarm"].toString(), QString("this show has no camera."));
    QVERIFY(QFile::exists(folder_->filePath("calls")));
    show->look();
    QCOMPARE(nights().size(), 1);
  }

  void endingAShowEndsItsNight() {
    auto show = showOf(settings());
    show->start();
    wall_ = time(4, 18);
    show->look();
    QTRY_COMPARE(script_->begun.load(), 1);
    show->stop();
    QCOMPARE(state(), QString("stopped"));
    QVERIFY(nights().empty());
  }

  /// Projectors that are off outside the hours are on for the night, and off after it.
  void projectorsAreOnForTheNight() {
    FakeProjectorState standby;
    standby.power = "0";
    standby.looksUntilWarm = 0;
    FakeProjector projector(standby);
    ShowSettings wanted = settings();
    wanted.switchesPower = true;
    wanted.projectors.push_back({"left", projector.address(), Size{1024, 768}});
    wanted.night = QTime(20, 0);
    wall_ = time(4, 19);
    auto show = showOf(wanted);
    show->start();
    const auto power = [&] {
      show->look();
      return health()["projectors"].toArray().at(0).toObject()["power"].toString();
    };
    QTRY_COMPARE_WITH_TIMEOUT(power(), QString("standby"), patience);
    wall_ = time(4, 20);
    QTRY_COMPARE_WITH_TIMEOUT(power(), QString("on"), patience);
    QTRY_COMPARE(script_->begun.load(), 1);
    QVERIFY(script_->switchesOn);
    script_->goesOn = true;
    QTRY_COMPARE_WITH_TIMEOUT(power(), QString("standby"), patience);
  }

  /// What a night made better is shown without being started again: another correction by another renderer, a
  /// perfected picture by looking for it again, also where it stands.
  void theShowTakesUpWhatBecameBetter() {
    pipeline::CalibrateSettings measuring;
    venue::VenueSettings venue;
    venue.name = "plain";
    venue.projector = {24, 18};
    venue.camera = {20, 16};
    venue.pathsPerPixel = 16;
    measuring.rig = venue;
    measuring.linearization.levels = 5;
    QDir(folder_->path()).rmdir("venue");
    Progress quiet;
    pipeline::calibrate(calibration(), measuring, {}, quiet);
    ShowSettings wanted = settings();
    wanted.content.items.removeLast();
    script_->goesOn = true;
    auto show = showOf(wanted);
    show->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QTRY_VERIFY(renderer_->thorough);
    const int rendered = renderer_->rendered;
    QTest::qWait(0);
    // Somebody perfects the picture that stands.
    pipeline::PerfectedPicture picture;
    picture.key = "0123456789abcdef";
    picture.folder = calibration();
    const Rasters projectors(Size{24, 18});
    savePerfected(picture, ProjectorStack(3 * projectors.count()), projectors);
    show->look();
    QTRY_VERIFY(renderer_->edition == 1);
    QVERIFY(renderer_->rendered > rendered);
    QCOMPARE(made_, 1);
    // A night changes what pictures follow from.
    script_->meanwhile = [this] {
      auto folder =
          calibration::CalibrationFolder::open(calibration(), calibration::CalibrationFolder::Access::write);
      pipeline::CalibrateSettings changed = pipeline::settingsOf(folder);
      changed.content.reachablePercentile = 30.0;
      pipeline::changeSettings(folder, changed);
    };
    wall_ = time(4, 18);
    show->look();
    QTRY_COMPARE(made_, 2);
    QCOMPARE(state(), QString("resting"));
    wall_ = time(5, 9);
    show->look();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QCOMPARE(made_, 2);
  }
};

QTEST_MAIN(TestShowNights)
#include "test_show_nights.moc"
