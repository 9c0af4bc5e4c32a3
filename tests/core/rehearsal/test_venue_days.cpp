// SPDX-License-Identifier: MIT
// What a rehearsal of venue days is made of; the whole of it with the program:
// tests/system/test_rehearse_day.
#include "relucent/rehearsal/venue_days.h"

#include <QtTest>
#include <algorithm>
#include <set>

#include "relucent/base/error.h"
#include "relucent/pjlink/keeper.h"
#include "relucent/pjlink/switching_on.h"
#include "relucent/rehearsal/show_process.h"
#include "relucent/rehearsal/simulated_projector.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::rehearsal;
using pjlink::Power;

namespace {

constexpr double megabyte = 1 << 20;

/// So many days of one process, behind one day of another, that take the same each.
std::vector<RehearsedDay> evenDays(int count) {
  std::vector<RehearsedDay> days;
  for (int number = 1; number <= count; ++number) {
    RehearsedDay day;
    day.number = number;
    day.process = number == 1 ? 1 : 2;
    day.happened = {{Happening::opening, {}, 1.0}, {Happening::night, {}, 1.0}};
    day.use = {100 << 20, 60 << 20, 40, 12};
    day.logBytes = 1000;
    day.calibrationBytes = 5'000'000 + 300 * static_cast<std::uint64_t>(number);
    days.push_back(std::move(day));
  }
  // The first of everything, which is no growth.
  days.front().use = {50 << 20, 20 << 20, 30, 9};
  days[1].use = {70 << 20, 30 << 20, 36, 11};
  return days;
}

std::set<std::string> exceeded(const std::vector<RehearsedDay>& days,
                               const std::optional<platform::ProcessEnd>& end = platform::ProcessEnd()) {
  std::set<std::string> names;
  for (const Bound& bound : boundsOf(days, end))
    if (!bound.isHeld()) names.insert(std::string(nameOf(bound.what)));
  return names;
}

SimulatedProjector::Clock::time_point at(int milliseconds) {
  return SimulatedProjector::Clock::time_point(std::chrono::milliseconds(milliseconds));
}

}  // namespace

class TestVenueDays : public QObject {
  Q_OBJECT

 private slots:
  void daysThatAreEvenHoldTheirBounds() {
    for (int count : {2, 5, 30}) QVERIFY(exceeded(evenDays(count)).empty());
    const std::vector<Bound> few = boundsOf(evenDays(5), platform::ProcessEnd());
    QVERIFY(!std::ranges::find(few, Bounded::memory, &Bound::what)->found);
    const std::vector<Bound> enough = boundsOf(evenDays(30), platform::ProcessEnd());
    QCOMPARE(std::ranges::find(enough, Bounded::memory, &Bound::what)->found.value(), 0.0);
    QCOMPARE(std::ranges::find(enough, Bounded::calibration, &Bound::what)->found.value(), 300.0);
  }

  void whatGrowsIsFound_data() {
    QTest::addColumn<QString>("what");
    for (const char* what :
         {"memory", "handles", "threads", "calibration", "log", "happenings", "warnings", "end"})
      QTest::newRow(what) << what;
  }
  void whatGrowsIsFound() {
    QFETCH(QString, what);
    std::vector<RehearsedDay> days = evenDays(30);
    platform::ProcessEnd end;
    for (RehearsedDay& day : days) {
      // A handle a week, a quarter of a megabyte a day.
      if (what == "memory") day.use.residentBytes += static_cast<std::uint64_t>(0.25 * megabyte * day.number);
      if (what == "handles") day.use.handles += day.number / 7;
      if (what == "threads") day.use.threads += day.number / 7;
      if (what == "calibration") day.calibrationBytes += 5000ull * static_cast<std::uint64_t>(day.number);
    }
    if (what == "log") days[17].logBytes = 6 << 20;
    if (what == "happenings") days[17].happened.back().missed = "its night did not end";
    if (what == "warnings") days[17].unexpected.push_back("the lamp is off");
    if (what == "end") end = {true, 11};
    QCOMPARE(exceeded(days, end), std::set<std::string>{what.toStdString()});
  }

  void aShowThatEndedByItselfIsFound() {
    QCOMPARE(exceeded(evenDays(4), std::nullopt), std::set<std::string>{"end"});
  }

  /// Whatever the number of days: all that can happen does within thirty, one process lasts, and no power
  /// fails before there is a night to remember.
  void everythingHappensWithinThirtyDays() {
    std::set<Happening> seen;
    for (int day = 1; day <= 30; ++day) {
      const std::vector<Happening> today = happeningsOf(day, 30);
      const auto has = [&](Happening what) { return std::ranges::find(today, what) != today.end(); };
      seen.insert(today.begin(), today.end());
      QVERIFY(has(Happening::opening) && has(Happening::closing));
      QVERIFY(has(Happening::night) || has(Happening::unreadableStill));
      if (day > 10) QVERIFY(!has(Happening::powerFailure) && !has(Happening::powerFailureAtNight));
    }
    QCOMPARE(seen.size(), enumEntries<Happening>().size());
    const std::vector<Happening> first = happeningsOf(1, 1);
    QVERIFY(std::ranges::find(first, Happening::powerFailureAtNight) == first.end());
  }

  void timesAreReadAsTheyAreWritten() {
    const ShowTime time =
        std::chrono::sys_days(std::chrono::year(2028) / 2 / 29) + std::chrono::seconds(86'399);
    QCOMPARE(textOf(time), std::string("2028-02-29T23:59:59"));
    QVERIFY(showTimeFrom(textOf(time)) == time);
    QVERIFY(showTimeFrom("2028-02-29T23:59:59Z") == time);
    for (const char* wrong : {"", "2028", "2027-02-29T10:00:00", "2028-02-29T25:00:00", "yesterday at 10:00"})
      QVERIFY(!showTimeFrom(wrong));
  }

  void healthIsRead() {
    const ShowHealth health = showHealthFrom(
        R"({"updated": "2026-05-04T09:10:00", "state": "playing", "item": 1, "skipped": 2, "alarm": "look",
            "projectors": [{"power": "on"}, {"answers": false}], "streams": [{"state": "lost"}],
            "night": {"next": "2026-05-04T20:00:00", "when": "2026-05-03T20:00:05"}, "more": []})");
    QCOMPARE(textOf(health.updated), std::string("2026-05-04T09:10:00"));
    QCOMPARE(health.power, (std::vector<std::string>{"on", ""}));
    QCOMPARE(health.streams, std::vector<std::string>{"lost"});
    QCOMPARE(textOf(health.night.value()), std::string("2026-05-03T20:00:05"));
    QCOMPARE(health.alarm, std::string("look"));
    QCOMPARE(health.skipped, 2);
    for (const char* wrong : {"", "{", "[]", R"({"updated": "now", "state": "", "item": 0, "skipped": 0})"})
      QVERIFY(!sentenceOf([&] { showHealthFrom(wrong); }, ErrorKind::format).empty());
  }

  void linesOfTheLogAreRead() {
    const LogLine told = logLineFrom(
        "2026-11-26T18:00:00+0000 info rehearsal 2026-05-04T09:00:00 projector 1 was switched on");
    QVERIFY(!told.isWarning);
    QCOMPARE(told.text, std::string("projector 1 was switched on"));
    QVERIFY(logLineFrom("2026-11-26T18:00:00+0000 warning rehearsal 2026-05-04T09:00:00 a b").isWarning);
    // What no show writes is never overlooked.
    const LogLine other = logLineFrom("double free or corruption (out)");
    QVERIFY(other.isWarning);
    QCOMPARE(other.text, std::string("double free or corruption (out)"));
  }

  void theProjectorWarmsUpAndCoolsDown() {
    using std::chrono::milliseconds;
    SimulatedProjector projector({milliseconds(400), milliseconds(300)});
    const auto said = [&](const char* line, int time) { return projector.answerTo(line, at(time)); };
    QCOMPARE(said("%1POWR ?", 0), std::string("%1POWR=0"));
    QCOMPARE(said("%1POWR 1", 0), std::string("%1POWR=OK"));
    QCOMPARE(said("%1POWR ?", 399), std::string("%1POWR=3"));
    QCOMPARE(said("%1POWR 0", 399), std::string("%1POWR=ERR3"));
    QCOMPARE(said("%1AVMT 11", 399), std::string("%1AVMT=ERR3"));
    QCOMPARE(said("%1POWR ?", 400), std::string("%1POWR=1"));
    QCOMPARE(said("%1POWR 0", 1000), std::string("%1POWR=OK"));
    QCOMPARE(said("%1POWR ?", 1299), std::string("%1POWR=2"));
    QCOMPARE(said("%1POWR ?", 1300), std::string("%1POWR=0"));
    QCOMPARE(said("%1POWR 1", 2000), std::string("%1POWR=OK"));
    projector.cutPower();
    QCOMPARE(said("%1POWR ?", 9000), std::string("%1POWR=0"));
    projector.setObeys(false);
    QCOMPARE(said("%1POWR 1", 9000), std::string("%1POWR=OK"));
    QCOMPARE(said("%1POWR ?", 9900), std::string("%1POWR=0"));
    QCOMPARE(projector.timesLit(), 2);
    QCOMPARE(said("%2IRES ?", 0), std::string("%2IRES=ERR1"));
    QCOMPARE(said("GET / HTTP/1.0", 0), std::string());
  }

  /// As those who look after projectors see it.
  void theProjectorSpeaksPjlink() {
    SimulatedProjector projector({std::chrono::milliseconds(20), std::chrono::milliseconds(20)});
    Progress quiet;
    pjlink::switchOn({{"left", projector.address()}}, {.interval = std::chrono::milliseconds(10)}, {}, quiet);
    QVERIFY(projector.power() == Power::on);
    projector.setLampHours(77);
    pjlink::Keeper keeper(projector.address(), {.label = "left", .switchesPower = true});
    const auto kept = [&](bool on) {
      return keeper.keep({on, false}, std::chrono::steady_clock::now(), quiet);
    };
    const pjlink::Kept well = kept(true);
    QVERIFY(well.report && well.warned.empty() && well.report->unclear.empty());
    QCOMPARE(well.report->lamps.front().hours, 77);
    const int port = projector.address().port;
    projector.vanish();
    QVERIFY(mentions(english(kept(true).problem), "does not answer"));
    projector.comeBack();
    QCOMPARE(projector.address().port, port);
    QVERIFY(kept(true).report.has_value());
    kept(false);
    QTRY_VERIFY(projector.power() == Power::off);
  }

  void settingsThatCannotBeAreNamed() {
    DaysSettings settings;
    QVERIFY(problems(settings).empty());
    settings.days = 0;
    settings.daySeconds = 0.1;
    QCOMPARE(problems(settings).size(), std::size_t{2});
  }

  void aProgramThatIsNotThereIsNamed() {
    const std::string sentence =
        sentenceOf([] { ShowProcess({"/nowhere/relucent", {}, {}, "/nowhere/log"}); }, ErrorKind::input);
    QVERIFY(mentions(sentence, "/nowhere/relucent") && mentions(sentence, "--program"));
  }
};

QTEST_GUILESS_MAIN(TestVenueDays)
#include "test_venue_days.moc"
