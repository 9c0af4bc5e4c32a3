// SPDX-License-Identifier: MIT
#include <QTest>
#include <cmath>

#include "relucent/charts/axis.h"

using namespace relucent::charts;

class TestAxis : public QObject {
  Q_OBJECT

 private slots:
  void axes_data() {
    QTest::addColumn<double>("low");
    QTest::addColumn<double>("high");
    QTest::addColumn<bool>("logarithmic");
    QTest::newRow("unit") << 0.0 << 1.0 << false;
    QTest::newRow("across zero") << -60.0 << 7.5 << false;
    QTest::newRow("small") << 1.0001 << 1.0002 << false;
    QTest::newRow("large") << 0.0 << 3.2e9 << false;
    QTest::newRow("decades") << 1e-6 << 1.0 << true;
    QTest::newRow("more than two decades") << 2.0 << 900.0 << true;
    QTest::newRow("less than two decades") << 130.0 << 8000.0 << true;
    QTest::newRow("part of a decade") << 0.02 << 0.07 << true;
  }

  void valueAndPlaceAreInverse_data() { axes_data(); }
  void valueAndPlaceAreInverse() {
    QFETCH(double, low);
    QFETCH(double, high);
    QFETCH(bool, logarithmic);
    Axis axis{low, high, logarithmic, {}};
    QVERIFY(std::abs(axis.place(low)) < 1e-9 && std::abs(axis.place(high) - 1.0) < 1e-9);
    for (double at : {-0.3, 0.0, 0.2, 0.5, 1.0, 1.4})
      // Rounding of value(), seen through the slope of place().
      QVERIFY(std::abs(axis.place(axis.value(at)) - at) < 1e-9);
  }

  void ticksAscendWithinTheAxis_data() { axes_data(); }
  void ticksAscendWithinTheAxis() {
    QFETCH(double, low);
    QFETCH(double, high);
    QFETCH(bool, logarithmic);
    Axis axis{low, high, logarithmic, {}};
    for (int count : {1, 2, 5, 12}) {
      std::vector<Tick> ticks = axis.ticks(count);
      QVERIFY(!ticks.empty() || count == 1);
      QVERIFY(ticks.size() <= static_cast<std::size_t>(count) + 1);
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        double place = axis.place(ticks[i].value);
        QVERIFY(place > -1e-6 && place < 1.0 + 1e-6);
        if (i == 0) continue;
        QVERIFY(ticks[i].value > ticks[i - 1].value);
        QVERIFY(englishTickText(axis, ticks[i]) != englishTickText(axis, ticks[i - 1]));
      }
    }
  }

  void anEmptyAxisHasNoTicks() {
    QVERIFY((Axis{1.0, 1.0}.ticks(5).empty()));
    QVERIFY((Axis{0.0, 1.0}.ticks(0).empty()));
  }

  void numbersWithinDecades() {
    const Axis axis{130.0, 8000.0, true, {}};
    QStringList numbers;
    for (const Tick& tick : axis.ticks(7)) numbers << QString::fromStdString(englishTickText(axis, tick));
    QCOMPARE(numbers, (QStringList{"200", "500", "1000", "2000", "5000"}));
    const Axis small{0.02, 0.07, true, {}};
    numbers.clear();
    for (const Tick& tick : small.ticks(7)) numbers << QString::fromStdString(englishTickText(small, tick));
    QCOMPARE(numbers, (QStringList{"0.02", "0.05"}));
  }

  void numbersAreRound() {
    std::vector<Tick> ticks = Axis{0.0, 1.0}.ticks(5);
    QStringList texts;
    for (const Tick& tick : ticks) texts << QString::fromStdString(englishTickText({}, tick));
    QCOMPARE(texts, QStringList({"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  }

  void powersOfTenAreRaised() {
    Axis axis{0.01, 1e12, true, {}};
    for (auto [value, text] :
         {std::pair(0.01, "10⁻²"), std::pair(1.0, "1"), std::pair(10.0, "10"), std::pair(1e12, "10¹²")})
      QCOMPARE(QString::fromStdString(englishTickText(axis, {value, 0})), QString::fromUtf8(text));
  }
};

QTEST_APPLESS_MAIN(TestAxis)
#include "test_axis.moc"
