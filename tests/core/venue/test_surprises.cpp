// SPDX-License-Identifier: MIT
#include "relucent/venue/surprises.h"

#include <QTest>
#include <algorithm>
#include <memory>

using namespace relucent;
using namespace relucent::venue;

namespace {

SurpriseSettings all(std::uint64_t seed) {
  SurpriseSettings settings;
  settings.kinds = allValues<Surprise>();
  settings.seed = seed;
  settings.patterns = 300;
  return settings;
}

SurpriseSettings one(Surprise kind) {
  SurpriseSettings settings = all(7);
  settings.kinds = {kind};
  return settings;
}

}  // namespace

Q_DECLARE_METATYPE(Surprise)

class TestSurprises : public QObject {
  Q_OBJECT

 private slots:
  /// Law: moments are the seed's, within the span, each in a part of its own.
  void momentsAreRandomButSeeded() {
    std::vector<int> first;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const Surprises surprises(all(seed)), again(all(seed));
      std::vector<int> moments;
      for (Surprise kind : allValues<Surprise>()) {
        moments.push_back(surprises.momentOf(kind));
        QCOMPARE(again.momentOf(kind), moments.back());
      }
      first.push_back(moments.front());
      std::ranges::sort(moments);
      QVERIFY(moments.front() >= 50 && moments.back() < 150);
      QVERIFY(moments[0] < 84 && moments[1] >= 83 && moments[1] < 117 && moments[2] >= 116);
    }
    std::ranges::sort(first);
    QVERIFY2(first.back() - first.front() > 80, qPrintable(QString::number(first.back() - first.front())));
    // Not before there is something to compare with.
    SurpriseSettings small = all(1);
    small.patterns = 6;
    QVERIFY(Surprises(small).momentOf(Surprise::bump) >= 12);
  }

  void eachBeginsAtItsMomentAndLasts_data() {
    QTest::addColumn<Surprise>("kind");
    QTest::addColumn<FaultKind>("fault");
    QTest::newRow("bump") << Surprise::bump << FaultKind::shiftedCamera;
    QTest::newRow("room light") << Surprise::roomLight << FaultKind::ambient;
    QTest::newRow("unplugged") << Surprise::unplugged << FaultKind::unplugged;
  }
  void eachBeginsAtItsMomentAndLasts() {
    QFETCH(Surprise, kind);
    QFETCH(FaultKind, fault);
    Surprises surprises(one(kind));
    const int moment = surprises.momentOf(kind);
    QVERIFY(surprises.during({"linearization", moment}).empty());
    QVERIFY(surprises.during({"acquisition", moment - 1}).empty() && !surprises.hasHappened(kind));
    for (const rig::ShotId& shot :
         {rig::ShotId{"acquisition", moment}, {"acquisition", 0}, {"acquisition", 500}}) {
      const std::vector<DeviceFault> faults = surprises.during(shot);
      QCOMPARE(faults.size(), std::size_t{1});
      QCOMPARE(faults.front().kind, fault);
      QVERIFY(surprises.hasHappened(kind) && surprises.lasts(kind));
    }
  }

  /// Law: a bumped camera comes back by pushing alone, and stays there.
  void aBumpedCameraIsPushedBack() {
    Surprises surprises(one(Surprise::bump));
    const auto shift = [&](const char* stage) {
      const std::vector<DeviceFault> faults = surprises.during({stage, 1000});
      return faults.empty() ? 0.0 : faults.front().amount;
    };
    const double bumped = shift("acquisition");
    QVERIFY(bumped > 0.0);
    surprises.putRight();
    QCOMPARE(shift("acquisition"), bumped);
    double before = bumped;
    int looks = 0;
    for (; before > 0.0 && looks < 100; ++looks) {
      const double now = shift("nudge");
      QVERIFY(now <= before);
      before = now;
    }
    QVERIFY2(looks > 3 && looks < 100, qPrintable(QString::number(looks)));
    QCOMPARE(shift("acquisition"), 0.0);
    QVERIFY(surprises.hasHappened(Surprise::bump) && !surprises.lasts(Surprise::bump));
  }

  void aLightIsSwitchedOffWhenAskedTo() {
    Surprises surprises(one(Surprise::roomLight));
    QVERIFY(!surprises.during({"acquisition", 1000}).empty());
    surprises.putRight();
    QVERIFY(surprises.during({"acquisition", 1001}).empty() && !surprises.lasts(Surprise::roomLight));
  }

  void aCableIsPushedInAgain() {
    SurpriseSettings settings = one(Surprise::unplugged);
    settings.failures = 3;
    Surprises surprises(settings);
    for (int i = 0; i < 3; ++i) QVERIFY(!surprises.during({"acquisition", 1000}).empty());
    QVERIFY(surprises.during({"acquisition", 1000}).empty() && !surprises.lasts(Surprise::unplugged));
  }

  /// Law: wherever a rehearsal is interrupted, it goes on as if it had not been; each change is told once.
  void whatIsInterruptedGoesOn() {
    SurpriseSettings settings = all(3);
    settings.failures = 5;
    Surprises whole(settings);
    auto parts = std::make_unique<Surprises>(settings);
    SurprisesSoFar told;
    for (int number = 0; number < 400; ++number) {
      const rig::ShotId shot{number % 7 == 3 ? "nudge" : "acquisition", number};
      parts = std::make_unique<Surprises>(settings, parts->soFar());
      const SurprisesSoFar before = parts->soFar();
      int changes = 0;
      parts->tellChanges([&](const Surprises& now) {
        ++changes;
        told = now.soFar();
      });
      const std::vector<DeviceFault> wanted = whole.during(shot), found = parts->during(shot);
      QCOMPARE(found.size(), wanted.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        QCOMPARE(found[i].kind, wanted[i].kind);
        QCOMPARE(found[i].amount, wanted[i].amount);
      }
      if (number == 350) {
        whole.putRight();
        parts->putRight();
      }
      QCOMPARE(changes > 0, parts->soFar() != before);
      QVERIFY(changes == 0 || told == parts->soFar());
    }
    QVERIFY(whole.soFar() == parts->soFar());
    QCOMPARE(parts->soFar().over.size(), settings.kinds.size());
  }

  void withoutSurprisesNothingHappens() {
    Surprises none(SurpriseSettings{});
    QVERIFY(none.during({"acquisition", 1000}).empty());
    none.putRight();
  }
};

QTEST_APPLESS_MAIN(TestSurprises)
#include "test_surprises.moc"
