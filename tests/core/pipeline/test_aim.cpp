// SPDX-License-Identifier: MIT
#include <QTest>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/pipeline/aim.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::pipeline;

namespace {

constexpr Size size{96, 72};

/// Blurred dots of many colours: a surface with detail everywhere, in full light, `gain` times as bright, its
/// picture `x`, `y` pixels further to the right and down.
Image view(double x, double y, double gain, std::uint64_t seed = 1) {
  Image image(size, 3);
  for (std::uint64_t dot = 0; dot < 90; ++dot) {
    Random random{seed, dot};
    const double centreX = x + 110.0 * random.uniform() - 7.0, centreY = y + 86.0 * random.uniform() - 7.0;
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

  void whatSaturatesMisleadsNobody() {
    const AimOffset offset = aimOffset(view(0, 0, 1.0), saturated(view(2.0, -1.0, 1.5), 0.9f), 0.9f);
    QVERIFY(offset.isRecognised);
    QVERIFY(std::abs(offset.movement.x - 2.0) < 0.3 && std::abs(offset.movement.y + 1.0) < 0.3);
  }

  /// Law: no direction is told where no movement explains what is seen.
  void anotherViewIsNotRecognised() {
    QVERIFY(!aimOffset(view(0, 0, 1.0), view(0, 0, 1.0, 5)).isRecognised);
    QVERIFY(!aimOffset(view(0, 0, 1.0), Image(size, 3)).isRecognised);
    QVERIFY_EXCEPTION_THROWN(aimOffset(view(0, 0, 1.0), Image({4, 4}, 3)), std::logic_error);
  }
};

QTEST_GUILESS_MAIN(TestAim)
#include "test_aim.moc"
