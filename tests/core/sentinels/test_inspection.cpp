// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/photography/bracket.h"
#include "relucent/sentinels/movement.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::photography;
using namespace relucent::rig;
using namespace relucent::sentinels;

namespace {

/// Blurred random dots: a view with detail everywhere, given as a function of place.
double brightness(double x, double y) {
  double sum = 0.0;
  for (int k = 0; k < 40; ++k) {
    Random random{7, static_cast<std::uint64_t>(k)};
    double dx = x - 70.0 * random.uniform(), dy = y - 50.0 * random.uniform();
    sum += std::exp(-0.5 * (dx * dx + dy * dy) / 6.0);
  }
  return sum;
}

Image movedView(double shiftX, double shiftY, double degrees) {
  Image image({64, 48}, 1);
  double angle = degrees * 3.14159265358979 / 180.0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      double dx = x - shiftX - 31.5, dy = y - shiftY - 23.5;
      image.at(x, y, 0) = static_cast<float>(brightness(31.5 + std::cos(angle) * dx + std::sin(angle) * dy,
                                                        23.5 - std::sin(angle) * dx + std::cos(angle) * dy));
    }
  return image;
}

Shot bracketOf(double second, double noise) {
  Shot shot;
  for (int k = 0; k < 2; ++k) {
    double seconds = k == 0 ? 0.1 : 0.02;
    RawFrame frame{Image({20, 20}, 3), 0, seconds};
    for (std::size_t i = 0; i < frame.signal.data().size(); ++i) {
      Random random{3, static_cast<std::uint64_t>(k), i};
      double light = 2.0 + 6.0 * static_cast<double>(i) / 1200.0;
      frame.signal.data()[i] =
          static_cast<float>(seconds * light * (k == 0 ? 1.0 : second) + noise * random.normal());
    }
    shot.frames.push_back({std::move(frame)});
  }
  return shot;
}

}  // namespace

class TestInspection : public QObject {
  Q_OBJECT

 private slots:
  void movementsAreFound_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("degrees");
    QTest::newRow("right") << 2.0 << 0.0 << 0.0;
    QTest::newRow("part of a pixel") << 0.6 << -0.4 << 0.0;
    QTest::newRow("up left") << -3.0 << -1.5 << 0.0;
    QTest::newRow("turned") << 0.0 << 0.0 << 3.0;
  }
  /// Phase correlation is good to some tenths of a pixel; over quarters half a view apart, to half a degree.
  void movementsAreFound() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, degrees);
    Movement movement = movementBetween(movedView(0, 0, 0), movedView(x, y, degrees));
    QString found = QString("%1, %2, %3 degrees").arg(movement.x).arg(movement.y).arg(movement.degrees);
    QVERIFY2(movement.explains, qPrintable(found));
    QVERIFY2(std::abs(movement.x - x) < 0.3 && std::abs(movement.y - y) < 0.3, qPrintable(found));
    QVERIFY2(std::abs(movement.degrees - degrees) < 1.0, qPrintable(found));
  }

  void severalPicturesTellAMovementFinely_data() { movementsAreFound_data(); }
  /// A tenth of a pixel, of pictures that are interpolated bilinearly, one of them half as bright as it was.
  void severalPicturesTellAMovementFinely() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, degrees);
    Image dimmed = movedView(x, y, degrees), mirrored = movedView(0, 0, 0);
    for (float& value : dimmed.data()) value *= 0.5f;
    const Movement movement =
        movementBetween({{movedView(0, 0, 0), movedView(x, y, degrees)}, {mirrored, dimmed}});
    QString found = QString("%1, %2, %3 degrees").arg(movement.x).arg(movement.y).arg(movement.degrees);
    QVERIFY2(movement.explains, qPrintable(found));
    QVERIFY2(std::abs(movement.x - x) < 0.1 && std::abs(movement.y - y) < 0.1, qPrintable(found));
    QVERIFY2(std::abs(movement.degrees - degrees) < 0.3, qPrintable(found));
    const Movement none = movementBetween({{movedView(0, 0, 0), movedView(0, 0, 0)}});
    QVERIFY(!none.explains && none.x == 0.0 && none.y == 0.0 && none.degrees == 0.0);
  }

  void whatIsNoMovementIsNotExplainedByOne() {
    Image before = movedView(0, 0, 0), after = before;
    for (int y = 10; y < 25; ++y)
      for (int x = 20; x < 35; ++x) after.at(x, y, 0) = 0.0f;
    QVERIFY(!movementBetween(before, after).explains);
    QVERIFY(!movementBetween(before, before).explains);
    QVERIFY(!movementBetween(Image({1, 1}, 1), Image({1, 1}, 1)).explains);
    QVERIFY(!movementBetween(Image({16, 16}, 1), Image({16, 16}, 1)).explains);
    QVERIFY_EXCEPTION_THROWN(movementBetween(before, Image({5, 5}, 1)), std::logic_error);
  }

  void exposuresThatContradictEachOther_data() {
    QTest::addColumn<double>("second");
    QTest::newRow("agreeing") << 1.0;
    QTest::newRow("brighter") << 1.05;
    QTest::newRow("darker") << 0.9;
  }
  void exposuresThatContradictEachOther() {
    QFETCH(double, second);
    CameraModel model;
    model.readNoise = 1e-3;
    model.gain = 0.0;
    double found = bracketContradiction(bracketOf(second, 1e-3), {model});
    QVERIFY2(std::abs(found - std::abs(second - 1.0)) < 0.01, qPrintable(QString::number(found)));
    if (second == 1.0) QCOMPARE(found, 0.0);
  }

  void oneExposureContradictsNothing() {
    Shot shot = bracketOf(1.0, 0.0);
    shot.frames.resize(1);
    QCOMPARE(bracketContradiction(shot, {CameraModel()}), 0.0);
  }
};

QTEST_APPLESS_MAIN(TestInspection)
#include "test_inspection.moc"
