// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/random.h"
#include "relucent/image/colour.h"

using namespace relucent;
using namespace relucent::image;

namespace {

/// Sharma, Wu & Dalal 2005, table 1: two colours and their difference, rounded to 4 digits.
struct Pair {
  Colour first, second;
  double difference;
};
const std::vector<Pair> sharmaPairs{{{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
                                    {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
                                    {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
                                    {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
                                    {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
                                    {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
                                    {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
                                    {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
                                    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
                                    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
                                    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
                                    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
                                    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
                                    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
                                    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
                                    {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
                                    {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
                                    {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
                                    {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
                                    {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
                                    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
                                    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
                                    {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
                                    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
                                    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                                    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
                                    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
                                    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
                                    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
                                    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
                                    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
                                    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
                                    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
                                    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};

}  // namespace

class TestColour : public QObject {
  Q_OBJECT

 private slots:
  void decodingUndoesEncoding() {
    // The two branches of IEC 61966-2-1 meet to about 1e-8 only: its constants are rounded.
    for (int i = 0; i <= 4096; ++i) {
      const double linear = i / 4096.0;
      QVERIFY(std::abs(srgbDecode(srgbEncode(linear)) - linear) < 1e-7);
      QCOMPARE(srgbEncode(-linear), -srgbEncode(linear));
    }
  }

  void encodingIsTheStandardOne_data() {
    QTest::addColumn<double>("linear");
    QTest::addColumn<double>("encoded");
    QTest::newRow("black") << 0.0 << 0.0;
    QTest::newRow("white") << 1.0 << 1.0;
    QTest::newRow("straight part") << 0.002 << 0.02584;
    QTest::newRow("18 % grey") << 0.18 << 0.4613561;
    QTest::newRow("middle") << 0.2140411 << 0.5;
  }
  void encodingIsTheStandardOne() {
    QFETCH(double, linear);
    QFETCH(double, encoded);
    QVERIFY(std::abs(srgbEncode(linear) - encoded) < 1e-6);
  }

  void encodingTwiceIsNotEncodingOnce() {
    const Image linear({1, 1}, 3, 0.18f);
    QVERIFY(srgbEncoded(srgbEncoded(linear)).at(0, 0, 0) > srgbEncoded(linear).at(0, 0, 0) + 0.2f);
  }

  void luminanceIsLinearAndOneForWhite() {
    QVERIFY(std::abs(luminance(Colour{1, 1, 1}) - 1.0) < 1e-15);
    Random random{7};
    for (int i = 0; i < 100; ++i) {
      const Colour a{random.uniform(), random.uniform(), random.uniform()};
      const Colour b{random.uniform(), random.uniform(), random.uniform()};
      const Colour sum{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
      QVERIFY(std::abs(luminance(sum) - luminance(a) - luminance(b)) < 1e-14);
      QCOMPARE(xyzFromLinearRgb(a)[1], luminance(a));
    }
  }

  void greyHasNoChroma() {
    for (double level : {0.0, 0.001, 0.18, 0.5, 1.0}) {
      const Colour lab = labFromXyz(xyzFromLinearRgb({level, level, level}));
      QVERIFY(std::abs(lab[1]) < 1e-10 && std::abs(lab[2]) < 1e-10);
    }
    QVERIFY(std::abs(labFromXyz(xyzFromLinearRgb({1, 1, 1}))[0] - 100.0) < 1e-10);
    // L* = 50 at Y = 18.4 %, by the definition of L*.
    QVERIFY(std::abs(labFromXyz(xyzFromLinearRgb({0.184187, 0.184187, 0.184187}))[0] - 50.0) < 1e-4);
  }

  void differenceAgreesWithThePublishedPairs() {
    QCOMPARE(sharmaPairs.size(), std::size_t{34});
    for (std::size_t i = 0; i < sharmaPairs.size(); ++i) {
      const auto& [first, second, expected] = sharmaPairs[i];
      const double seen = ciede2000(first, second);
      QVERIFY2(std::abs(seen - expected) <= 0.5e-4 + 1e-9,  // the table's rounding
               qPrintable(QString("pair %1: %2, published %3").arg(i + 1).arg(seen).arg(expected)));
      QVERIFY(std::abs(ciede2000(second, first) - seen) < 1e-9);
      QCOMPARE(ciede2000(first, first), 0.0);
    }
  }

  void viewedClampsAndDividesByWhite() {
    Image linear({2, 1}, 3, std::vector<float>{2.0f, 0.5f, 0.0f, 9.0f, -1.0f, 1.0f});
    const Image seen = viewed(linear, {2.0f, 1.0f, 4.0f});
    QCOMPARE(seen.at(0, 0, 0), 1.0f);
    QCOMPARE(seen.at(0, 0, 1), static_cast<float>(srgbEncode(0.5)));
    QCOMPARE(seen.at(0, 0, 2), 0.0f);
    QCOMPARE(seen.at(1, 0, 0), 1.0f);
    QCOMPARE(seen.at(1, 0, 1), 0.0f);
    QCOMPARE(seen.at(1, 0, 2), static_cast<float>(srgbEncode(0.25)));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, viewed(linear, {0.0f, 1.0f, 1.0f}));
  }

  void meanDifferenceCountsTheMask() {
    Image a({2, 1}, 3, 0.5f), b = a;
    b.at(1, 0, 0) = 0.7f;
    const std::vector<std::uint8_t> left{1, 0}, right{0, 1}, none{0, 0};
    QCOMPARE(meanDeltaE(a, b, left), 0.0);
    QVERIFY(meanDeltaE(a, b, right) > 1.0);
    QCOMPARE(meanDeltaE(a, b), meanDeltaE(a, b, right) / 2.0);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, meanDeltaE(a, b, none));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, meanDeltaE(a, Image({1, 2}, 3)));
  }

  void percentileIsWhatFewExceed() {
    // Of twenty pixels one may be worse than what 95 % do not exceed, two may not.
    Image a({20, 1}, 3, 0.5f), one = a;
    one.at(3, 0, 0) = 0.7f;
    Image two = one;
    two.at(11, 0, 0) = 0.6f;
    QCOMPARE(colourDifference(a, one).mean, meanDeltaE(a, one));
    QCOMPARE(colourDifference(a, one).percentile95, 0.0);
    const double lesser = colourDifference(a, two).percentile95;
    QVERIFY(lesser > 0.0 && lesser < 20.0 * colourDifference(a, one).mean);
    std::vector<std::uint8_t> only(20);
    only[3] = 1;
    QCOMPARE(colourDifference(a, two, only).percentile95, colourDifference(a, two, only).mean);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, colourDifference(a, two, std::vector<std::uint8_t>(20)));
  }
};

QTEST_APPLESS_MAIN(TestColour)
#include "test_colour.moc"
