// SPDX-License-Identifier: MIT
#include "relucent/linearization/ramp_preview.h"

#include <QtTest>
#include <cmath>
#include <limits>

using namespace relucent;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::rig;

namespace {

Image even(float red, float green, float blue) {
  Image pattern({4, 3}, 3);
  for (std::size_t i = 0; i < pattern.pixels(); ++i) {
    pattern.pixel(i)[0] = red;
    pattern.pixel(i)[1] = green;
    pattern.pixel(i)[2] = blue;
  }
  return pattern;
}

RawFrame lit(float signal, double seconds = 0.5) {
  return {Image({2, 2}, 3, signal), 12, seconds};
}

}  // namespace

class TestRampPreview : public QObject {
  Q_OBJECT

 private slots:
  void levelsAreRelativeToTheBrightestLessBlack() {
    RampPreview preview;
    preview.add(even(0, 0, 0), lit(0.1f));
    preview.add(even(1, 0, 0), lit(0.5f));
    preview.add(even(0.5f, 0, 0), lit(0.2f));
    preview.add(even(0, 0, 1), lit(0.3f, 0.25));  // twice as much per second
    auto curves = preview.curves();
    QVERIFY(std::abs(curves[0].at(0.5) - 0.25) < 1e-6);
    QCOMPARE(curves[0].at(1.0), 1.0);
    QCOMPARE(curves[2].at(1.0), 1.0);
    QCOMPARE(curves[2].at(0.0), 0.0);
    QVERIFY(curves[1].empty());
  }

  void whatTellsNothingChangesNothing_data() {
    QTest::addColumn<float>("signal");
    QTest::addColumn<double>("seconds");
    QTest::addColumn<bool>("single");
    QTest::newRow("saturated") << 1.0f << 0.5 << true;
    QTest::newRow("no exposure") << 0.5f << 0.0 << true;
    QTest::newRow("two channels") << 0.5f << 0.5 << false;
  }
  void whatTellsNothingChangesNothing() {
    QFETCH(float, signal);
    QFETCH(double, seconds);
    QFETCH(bool, single);
    RampPreview preview;
    preview.add(even(0, 0, 0), lit(0.1f));
    preview.add(even(1, single ? 0.0f : 0.5f, 0), lit(signal, seconds));
    Image uneven = even(0, 1, 0);
    uneven.at(1, 1, 1) = 0.5f;
    preview.add(uneven, lit(0.4f));
    preview.add(Image(), lit(0.4f));
    for (const auto& curve : preview.curves()) QVERIFY(curve.empty());
  }

  void nothingBeforeBlack() {
    RampPreview preview;
    preview.add(even(1, 0, 0), lit(0.5f));
    for (const auto& curve : preview.curves()) QVERIFY(curve.empty());
  }
};

QTEST_GUILESS_MAIN(TestRampPreview)
#include "test_ramp_preview.moc"
