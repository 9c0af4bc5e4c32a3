// SPDX-License-Identifier: MIT
#include <QTest>
#include <cmath>
#include <numbers>

#include "relucent/base/random.h"
#include "relucent/image/resample.h"
#include "relucent/pipeline/aim.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::pipeline;

namespace {

constexpr Size size{96, 72};

/// Blurred dots of many colours: a surface with detail everywhere, in full light, `gain` times as bright, its
/// picture turned clockwise and `x`, `y` pixels further to the right and down.
Image view(double x, double y, double gain, std::uint64_t seed = 1, double degrees = 0.0) {
  Image image(size, 3);
  const double angle = degrees * std::numbers::pi / 180.0, cosine = std::cos(angle), sine = std::sin(angle);
  const double middleX = 0.5 * (size.width - 1), middleY = 0.5 * (size.height - 1);
  for (std::uint64_t dot = 0; dot < 90; ++dot) {
    Random random{seed, dot};
    const double fromX = 110.0 * random.uniform() - 7.0 - middleX,
                 fromY = 86.0 * random.uniform() - 7.0 - middleY;
    const double centreX = middleX + cosine * fromX - sine * fromY + x,
                 centreY = middleY + sine * fromX + cosine * fromY + y;
    const double light[] = {random.uniform(), random.uniform(), random.uniform()};
    for (int row = 0; row < size.height; ++row)
      for (int column = 0; column < size.width; ++column) {
        const double dx = column - centreX, dy = row - centreY;
        const double weight = gain * std::exp(-0.5 * (dx * dx + dy * dy) / 6.0);
        for (int c = 0; c < 3; ++c) image.at(column, row, c) += static_cast<float>(weight * light[c]);
      }
  }
  return image;
}

Image saturated(Image image, float most) {
  for (float& value : image.data()) value = std::min(value, most);
  return image;
}

}  // namespace

class TestAim : public QObject {
  Q_OBJECT

 private slots:
  void aViewThatStaysIsAtItsPlace() {
    const AimOffset offset = aimOffset(view(0, 0, 1.0), view(0, 0, 0.4));
    QVERIFY(offset.isRecognised);
    QVERIFY(std::hypot(offset.movement.x, offset.movement.y) < 0.05);
    QVERIFY(offset.apart < 1e-3);
    QVERIFY(std::abs(offset.gain - 0.4) < 1e-3);
  }

  void shiftsAreFoundInAnyUnits_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("gain");
    QTest::newRow("right") << 3.0 << 0.0 << 1.0;
    QTest::newRow("up") << 0.0 << -2.5 << 1.0;
    QTest::newRow("less than a pixel, darker") << 0.6 << 0.4 << 0.02;
    QTest::newRow("both, brighter") << -4.0 << 5.0 << 30.0;
  }
  void shiftsAreFoundInAnyUnits() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, gain);
    const AimOffset offset = aimOffset(view(0, 0, 1.0), view(x, y, gain));
    const QString found = QString("%1, %2").arg(offset.movement.x).arg(offset.movement.y);
    QVERIFY2(offset.isRecognised, qPrintable(found));
    QVERIFY2(std::abs(offset.movement.x - x) < 0.3 && std::abs(offset.movement.y - y) < 0.3,
             qPrintable(found));
  }

  /// A tripod that is kicked turns, too. Half of a pixel at the border is 0.6 degrees here; the difference of
  /// interpolated pictures is a tenth of that.
  void turnsAreFound_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("degrees");
    QTest::newRow("turned alone") << 0.0 << 0.0 << 0.6;
    QTest::newRow("anticlockwise") << 0.0 << 0.0 << -1.5;
    QTest::newRow("shifted and turned") << 2.0 << 2.0 << 1.0;
    QTest::newRow("on the way back") << 1.2 << 1.3 << 0.6;
  }
  void turnsAreFound() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, degrees);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const sentinels::Movement moved =
          aimOffset(view(0, 0, 1.0, seed), view(x, y, 1.7, seed, degrees)).movement;
      const QString found = QString("%1, %2, %3 degrees").arg(moved.x).arg(moved.y).arg(moved.degrees);
      QVERIFY2(moved.explains && std::abs(moved.degrees - degrees) < 0.1, qPrintable(found));
      QVERIFY2(std::abs(moved.x - x) < 0.1 && std::abs(moved.y - y) < 0.1, qPrintable(found));
    }
  }

  /// Law: pixels are those of the view, however few are compared. Twelve times as large, so that more than
  /// ten of its pixels are one of those compared, of which a hundredth is found.
  void largeViewsAreMeasuredInTheirOwnPixels() {
    constexpr int larger = 12;
    const Size large{larger * size.width, larger * size.height};
    const auto enlarged = [&](const Image& image) { return resized(image, large); };
    const AimOffset offset = aimOffset(enlarged(view(0, 0, 1.0)), enlarged(view(1.5, -0.5, 1.0)));
    const QString found = QString("%1, %2").arg(offset.movement.x).arg(offset.movement.y);
    QVERIFY2(std::abs(offset.movement.x - 1.5 * larger) < 0.3, qPrintable(found));
    QVERIFY2(std::abs(offset.movement.y + 0.5 * larger) < 0.3, qPrintable(found));
  }

  void whatSaturatesMisleadsNobody() {
    const AimOffset offset = aimOffset(view(0, 0, 1.0), saturated(view(2.0, -1.0, 1.5), 0.9f), 0.9f);
    QVERIFY(offset.isRecognised);
    QVERIFY(std::abs(offset.movement.x - 2.0) < 0.3 && std::abs(offset.movement.y + 1.0) < 0.3);
  }

  /// Law: no direction is told where no movement explains what is seen.
  /// Law: pixels of which nothing is known mislead nobody, though they be bright in one picture and dark in
  /// the other.
  void whatIsNotComparedMisleadsNobody() {
    Image expected = view(0, 0, 1.0), seen = view(1.0, 1.0, 1.5);
    std::vector<std::uint8_t> compared(size.count(), 1);
    for (int y = 20; y < 50; ++y)
      for (int x = 30; x < 60; ++x)
        for (int c = 0; c < 3; ++c) {
          expected.at(x, y, c) = 0.0f;
          seen.at(x, y, c) = 5.0f;
          compared[indexOf(size, {x, y})] = 0;
        }
    const auto movement =
        aimOffset(expected, seen, std::numeric_limits<float>::infinity(), compared).movement;
    QVERIFY(!aimOffset(expected, seen).movement.explains);
    QVERIFY(movement.explains);
    QVERIFY2(std::hypot(movement.x - 1.0, movement.y - 1.0) < 0.1,
             qPrintable(QString("%1, %2").arg(movement.x).arg(movement.y)));
  }

  void anotherViewIsNotRecognised() {
    QVERIFY(!aimOffset(view(0, 0, 1.0), view(0, 0, 1.0, 5)).isRecognised);
    QVERIFY(!aimOffset(view(0, 0, 1.0), Image(size, 3)).isRecognised);
    QVERIFY_EXCEPTION_THROWN(aimOffset(view(0, 0, 1.0), Image({4, 4}, 3)), std::logic_error);
  }
};

QTEST_GUILESS_MAIN(TestAim)
#include "test_aim.moc"
