// SPDX-License-Identifier: MIT
#include <QTest>
#include <sstream>

#include "relucent/base/random.h"
#include "relucent/cli/terminal_progress.h"
#include "relucent/cli/terminal_room.h"

using namespace relucent;
using namespace relucent::cli;

namespace {

TimeLeft::Moment moment(double seconds) {
  return TimeLeft::Moment(
      std::chrono::duration_cast<TimeLeft::Moment::duration>(std::chrono::duration<double>(seconds)));
}

}  // namespace

namespace {

/// A terminal of any width with a clock that the test turns.
struct FakeTerminal {
  std::ostringstream out;
  int width = 0;
  double now = 100.0;

  TerminalProgress::Terminal terminal() {
    return {&out, [this] { return width; }, [this] { return moment(now); }};
  }
  QByteArray text() const { return QByteArray::fromStdString(out.str()); }
};

}  // namespace

class TestTerminalProgress : public QObject {
  Q_OBJECT

 private slots:
  /// Law: whatever is shown, the line fits, and the percentage is there as soon as there is room for it.
  void theLineFitsEveryWidth() {
    Random random{7};
    for (int width = 0; width <= 200; ++width) {
      std::string stage(random.below(60), 's');
      std::string left = random.below(2) == 0 ? "" : "about 12 min left";
      double fraction = random.uniform();
      std::string line = barLine(stage, fraction, left, width);
      QVERIFY2(static_cast<int>(line.size()) <= std::max(0, width - 1), line.c_str());
      if (width > 5) QVERIFY2(line.find(" %") != std::string::npos, line.c_str());
    }
  }

  void theLineSaysEverythingWhenThereIsRoom() {
    QCOMPARE(barLine("acquisition", 0.5, "about 2 min left", 80),
             "acquisition  [" + std::string(19, '=') + std::string(20, ' ') + "]   50 %  about 2 min left");
    QCOMPARE(barLine("acquisition", 1.0, "", 20), std::string("acquisition  100 %"));
    QVERIFY(barLine("acquisition", 0.999, "", 80).find(" 99 %") != std::string::npos);
  }

  void workToComeIsSaidInRoundFigures() {
    WorkLeft work{2087, 433, 4312, 4154, 170.0, 490'000'000, 2'140'000'000};
    QCOMPARE(workSentence(work),
             std::string("About 2100 patterns to photograph (430 to 4300), 4200 photographs: about 3 min, "
                         "490 MB on disk, 2.1 GB of memory"));
    QCOMPARE(workSentence({}),
             std::string("About 0 patterns to photograph (0 to 0), 0 photographs: under a minute, "
                         "1 MB on disk, 1 MB of memory"));
  }

  /// Said once; the time left follows what is expected, and measures for itself when that has passed.
  void workToComeIsSaidOnce() {
    FakeTerminal fake;
    TerminalProgress progress(fake.terminal());
    progress.progressed(0.1, Message::plain("acquisition"));
    progress.expected({100, 50, 200, 200, 600.0, 0, 0});
    progress.expected({90, 50, 200, 200, 500.0, 0, 0});
    QCOMPARE(fake.text().count("About 100 patterns"), 1);
    QCOMPARE(fake.text().count("patterns to photograph"), 1);
    fake.now += 20.0;
    progress.progressed(0.3, Message::plain("level 2"));
    QVERIFY2(fake.text().contains("level 2, about 8 min left"), fake.text().constData());
    fake.now += 600.0;
    progress.progressed(0.5, Message::plain("level 3"));
    QVERIFY2(!fake.text().contains("level 3, about 8 min left"), fake.text().constData());
  }

  void atMostTenDrawingsASecond() {
    FakeTerminal fake;
    fake.width = 80;
    TerminalProgress progress(fake.terminal());
    for (int i = 0; i < 1000; ++i) {  // two seconds
      fake.now = 100.0 + 0.002 * i;
      progress.progressed(i / 1000.0, Message::plain("acquisition"));
    }
    qsizetype drawings = fake.text().count('\r');
    QVERIFY2(drawings >= 18 && drawings <= 21, QByteArray::number(drawings));
    QVERIFY(!fake.text().contains('\n'));
  }

  void theBarIsTakenAway() {
    FakeTerminal fake;
    fake.width = 80;
    {
      TerminalProgress progress(fake.terminal());
      progress.progressed(0.5, Message::plain("acquisition"));
    }
    QVERIFY(fake.text().endsWith("\r\x1b[K"));
  }

  void elsewhereItWritesPlainLines() {
    FakeTerminal fake;
    TerminalProgress progress(fake.terminal());
    for (int i = 0; i <= 1000; ++i) {
      fake.now += 0.01;
      progress.progressed(i / 1000.0, Message::plain(i < 500 ? "linearization" : "acquisition"));
    }
    QByteArray text = fake.text();
    QVERIFY2(!text.contains('\r') && !text.contains('\x1b'), text);
    QVERIFY2(text.contains("  0 %  linearization\n"), text);
    QVERIFY2(text.contains(" 50 %  acquisition"), text);
    // Every tenth, and one for the new stage that may fall between two tenths.
    QVERIFY2(text.count('\n') >= 11 && text.count('\n') <= 12, text);
  }

  /// Said once a pause, on a line of its own; and the time left stands still.
  void aFullDiskIsSaidOnce() {
    FakeTerminal fake;
    fake.width = 80;
    TerminalProgress progress(fake.terminal());
    progress.expected({100, 50, 200, 200, 600.0, 3'000'000'000, 0});
    progress.progressed(0.1, Message::plain("acquisition"));
    int sleeps = 0;
    TerminalRoom room(progress, [&](std::chrono::milliseconds) { ++sleeps; });
    for (int pause = 1; pause <= 2; ++pause) {
      for (int look = 0; look < 5; ++look) {
        QCOMPARE(room.wait({"venue", 12'000'000, 96'000'000}), calibration::RoomWaiter::Answer::look);
        fake.now += 1000.0;
      }
      room.over();
      QCOMPARE(fake.text().count("Paused: the disk of venue is full, 12 MB are free."), pause);
      QVERIFY2(fake.text().contains("Free at least 96 MB there (3.0 GB for all that is left)"), fake.text());
    }
    QCOMPARE(sleeps, 10);
    fake.out.str("");
    fake.now += 1.0;
    progress.progressed(0.11, Message::plain("acquisition"));
    QVERIFY2(fake.text().contains("about 10 min left"), fake.text());
  }

  void timeLeftIsThatOfASteadyRate_data() {
    QTest::addColumn<double>("total");
    QTest::addColumn<double>("at");
    QTest::addColumn<QByteArray>("sentence");
    QTest::newRow("too early to say") << 100.0 << 1.0 << QByteArray("");
    QTest::newRow("seconds, which nobody knows") << 60.0 << 25.0 << QByteArray("  under a minute left");
    QTest::newRow("minutes, rounded up") << 600.0 << 100.0 << QByteArray("about 9 min left");
    QTest::newRow("hours") << 7200.0 << 100.5 << QByteArray("about 1 h 59 min left");
  }
  void timeLeftIsThatOfASteadyRate() {
    QFETCH(double, total);
    QFETCH(double, at);
    QFETCH(QByteArray, sentence);
    FakeTerminal fake;
    fake.width = 80;
    TerminalProgress progress(fake.terminal());
    for (fake.now = 0.0; fake.now <= at; fake.now += 0.25) {
      fake.out.str("");
      progress.progressed(fake.now / total, Message::plain("work"));
    }
    QCOMPARE(QByteArray::fromStdString(fake.out.str()).contains("left"), !sentence.isEmpty());
    QVERIFY2(fake.text().contains(sentence), fake.text());
  }
};

QTEST_APPLESS_MAIN(TestTerminalProgress)
#include "test_terminal_progress.moc"
