// SPDX-License-Identifier: MIT
#include "output/rehearsal_clock.h"

#include <QTemporaryDir>
#include <QtTest>
#include <random>

#include "output/show_settings.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/pipeline/stored_settings.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::gui;
using namespace std::chrono_literals;

class TestRehearsalClock : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::chrono::steady_clock::time_point real_{};

  QString file() const { return folder_.filePath("time"); }
  void write(const char* line) const { writeFileAtomically(file().toStdString(), line); }
  RehearsalClock clockAt(const char* line) {
    write(line);
    return RehearsalClock(file(), [this] { return real_; });
  }
  static QString text(const QDateTime& time) { return time.toString(Qt::ISODate); }

 private slots:
  void init() { real_ = {}; }

  void itPassesAsFastAsItSaysAndStandsStill() {
    const RehearsalClock clock = clockAt("2026-05-04T08:50 2026-05-04T18:10 3600\nmore\n");
    QCOMPARE(text(clock.now()), QString("2026-05-04T08:50:00"));
    real_ += 2s;
    QCOMPARE(text(clock.now()), QString("2026-05-04T10:50:00"));
    real_ += 500ms;
    QCOMPARE(text(clock.now()), QString("2026-05-04T11:20:00"));
    real_ += 24h * 365 * 200;
    QCOMPARE(text(clock.now()), QString("2026-05-04T18:10:00"));
  }

  void itFollowsItsFile() {
    RehearsalClock clock = clockAt("2026-05-04T08:50 2026-05-04T09:00 60");
    real_ += 5s;
    write("2026-05-04T08:55 2026-05-05T00:00 3600");
    clock.follow();
    QCOMPARE(text(clock.now()), QString("2026-05-04T08:55:00"));
    real_ += 1s;
    QCOMPARE(text(clock.now()), QString("2026-05-04T09:55:00"));
    for (const char* broken : {"", "soon", "2026-05-04T08:55 2026-05-05T00:00"}) {
      write(broken);
      clock.follow();
      QCOMPARE(clock.speed(), 3600.0);
    }
    QFile::remove(file());
    clock.follow();
    real_ += 1s;
    QCOMPARE(text(clock.now()), QString("2026-05-04T10:55:00"));
  }

  /// Law: whatever the file says, and whenever, time does not go back, and never passes its end.
  void itNeverGoesBack() {
    RehearsalClock clock = clockAt("2026-05-04T08:50 2026-05-04T09:00 60");
    std::mt19937 random(7);
    QDateTime before = clock.now();
    const QDateTime day({2026, 5, 4}, {0, 0});
    for (int step = 0; step < 300; ++step) {
      real_ += std::chrono::milliseconds(random() % 1000);
      if (random() % 3 == 0) {
        const QDateTime from = day.addSecs(random() % 86'400), until = from.addSecs(random() % 40'000);
        write(qPrintable(QString("%1 %2 %3").arg(text(from), text(until)).arg(1 + random() % 5000)));
        clock.follow();
        QCOMPARE(clock.now(), std::max(before, clock.now()));
        if (clock.now() < until) {
          real_ += 24h;
          QCOMPARE(clock.now(), until);
        }
      }
      QVERIFY(clock.now() >= before);
      before = clock.now();
    }
  }

  void plans_data() {
    QTest::addColumn<QString>("line");
    QTest::addColumn<bool>("isPlan");
    QTest::newRow("a day") << "2026-05-04T08:50 2026-05-04T18:10:30 60" << true;
    QTest::newRow("at once") << "2026-05-04T08:50 2026-05-04T08:50 1" << true;
    QTest::newRow("nothing") << "" << false;
    QTest::newRow("back") << "2026-05-04T08:50 2026-05-04T08:49 60" << false;
    QTest::newRow("slow") << "2026-05-04T08:50 2026-05-04T18:10 0.5" << false;
    QTest::newRow("no number") << "2026-05-04T08:50 2026-05-04T18:10 nan" << false;
    QTest::newRow("endless") << "2026-05-04T08:50 2026-05-04T18:10 inf" << false;
    QTest::newRow("no date") << "08:50 18:10 60" << false;
    QTest::newRow("more") << "2026-05-04T08:50 2026-05-04T18:10 60 fast" << false;
  }
  void plans() {
    QFETCH(QString, line);
    QFETCH(bool, isPlan);
    QCOMPARE(rehearsalPlanFrom(line).has_value(), isPlan);
    write(qPrintable(line));
    QCOMPARE(sentenceOf([&] { RehearsalClock clock(file()); }, ErrorKind::format).empty(), isPlan);
  }

  void aFileThatIsNotThereIsNamed() {
    const std::string name = folder_.filePath("none").toStdString();
    QVERIFY(mentions(
        sentenceOf([&] { MachineClock::rehearsed(QString::fromStdString(name)); }, ErrorKind::disk), name));
  }

  /// Real lamps are not switched on and off thirty times within minutes.
  void onlySimulatedVenuesAreRehearsed() {
    write("2026-05-04T08:50 2026-05-04T18:10 60");
    pipeline::CommandRigSettings real;
    real.projectorCommand = "show {image}";
    real.cameraCommand = "photograph {exposure} {output}";
    real.projector = {1024, 768};
    pipeline::CalibrateSettings measured;
    ShowSettings settings;
    settings.rehearsal = file();
    const std::filesystem::path root = folder_.path().toStdString();
    measured.rig = real;
    settings.calibration = root / "real";
    pipeline::createCalibration(settings.calibration, measured);
    QVERIFY(mentions(sentenceOf([&] { clockOf(settings); }, ErrorKind::input), "real devices"));
    settings.rehearsal.clear();
    QVERIFY(!clockOf(settings).rehearsal);
    settings.rehearsal = file();
    measured.rig = venue::VenueSettings();
    settings.calibration = root / "simulated";
    pipeline::createCalibration(settings.calibration, measured);
    QVERIFY(clockOf(settings).rehearsal != nullptr);
  }

  /// A show that is none of a rehearsal waits as it always did.
  void onlyARehearsalIsInHaste() {
    QCOMPARE(MachineClock().pause(60s), 60'000ms);
    write("2026-05-04T08:50 2026-05-04T18:10 60");
    const MachineClock clock = MachineClock::rehearsed(file());
    QCOMPARE(clock.pause(60s), 500ms);
    QCOMPARE(clock.pause(1ms), 1ms);
    QCOMPARE(text(clock.wall()), QString("2026-05-04T08:50:00"));
  }
};

QTEST_GUILESS_MAIN(TestRehearsalClock)
#include "test_rehearsal_clock.moc"
