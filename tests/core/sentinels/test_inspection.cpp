// SPDX-License-Identifier: MIT
#include <QtTest>
#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/photography/bracket.h"
#include "relucent/sentinels/inspection.h"
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

/// Two exposures of one pattern, between which the view may become another. `longest`: what the longer one
/// has of the brightest place, of full scale.
Shot twoExposures(const Image& before, const Image& after, double longest, bool isLongerFirst) {
  const float brightest = *std::ranges::max_element(before.data());
  Shot shot;
  for (bool isLonger : {isLongerFirst, !isLongerFirst}) {
    const Image& view = shot.frames.empty() ? before : after;
    const double seconds = isLonger ? 0.1 : 0.02;
    RawFrame frame{Image(view.size(), 3), 0, seconds};
    for (std::size_t i = 0; i < frame.signal.data().size(); ++i) {
      Random random{5, static_cast<std::uint64_t>(isLonger), i};
      const double light = static_cast<double>(view.data()[i / 3] / brightest);
      frame.signal.data()[i] =
          static_cast<float>(std::min(1.0, longest * light * seconds / 0.1 + 1e-3 * random.normal()));
    }
    shot.frames.push_back({std::move(frame)});
  }
  return shot;
}

Image scaled(Image view, double by) {
  for (float& value : view.data()) value *= static_cast<float>(by);
  return view;
}

/// What the projector lights at most: more on the right, and in the corner little.
float floodAt(Pixel at) {
  return at.x < 16 && at.y < 24 ? 0.1f : 0.5f + static_cast<float>(at.x) / 64.0f;
}

/// Of views of that size.
References referencesOf(const Size& size) {
  References references;
  references.cameras = Rasters(size);
  references.root.resize(1);
  for (std::size_t i = 0; i < size.count(); ++i) {
    transport::ColourBlock block = transport::ColourBlock::Zero();
    block.diagonal().setConstant(floodAt(pixelAt(size, i)) / 3.0f);
    references.root[0].push_back(block);
  }
  return references;
}

/// With light of a lamp that shines on the same surface, or one that is astray everywhere.
enum class RoomLight { surface, astray };
Image lit(Image view, double light, RoomLight way) {
  for (std::size_t i = 0; i < view.data().size(); ++i)
    view.data()[i] +=
        static_cast<float>(light) * (way == RoomLight::astray ? 1.0f : floodAt(pixelAt(view.size(), i)));
  return view;
}

/// A quarter of the view hidden.
Image covered(Image view) {
  for (int y = 12; y < 36; ++y)
    for (int x = 16; x < 48; ++x) view.at(x, y, 0) = 0.0f;
  return view;
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

Q_DECLARE_METATYPE(Image)
Q_DECLARE_METATYPE(AlarmKind)

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

  /// Law: what is left out says nothing. Half of a view that is too bright stands still in both
  /// pictures, and what is left moves all the same.
  void whatIsLeftOutDoesNotHoldAMovementBack_data() { movementsAreFound_data(); }
  void whatIsLeftOutDoesNotHoldAMovementBack() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, degrees);
    ViewPair views{movedView(0, 0, 0), movedView(x, y, degrees), {}};
    const Size size = views.first.size();
    views.compared.assign(size.count(), 1);
    std::size_t left = 0;
    for (std::size_t i = 0; i < size.count(); ++i) {
      const Pixel at = pixelAt(size, i);
      if (at.x > size.width / 4 && at.y < 2 * size.height / 3) views.compared[i] = 0;
      left += views.compared[i];
      if (views.compared[i] != 0) continue;
      views.first.data()[i] = views.now.data()[i] = 0.0f;
    }
    QVERIFY(2 * left < 1.1 * static_cast<double>(size.count()));
    const Movement movement = movementBetween({views});
    const QString found = QString("%1, %2, %3 degrees").arg(movement.x).arg(movement.y).arg(movement.degrees);
    QVERIFY2(movement.explains, qPrintable(found));
    QVERIFY2(std::abs(movement.x - x) < 0.1 && std::abs(movement.y - y) < 0.1, qPrintable(found));
    QVERIFY2(std::abs(movement.degrees - degrees) < 0.3, qPrintable(found));
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

  void evenLightContradictsNothing_data() {
    QTest::addColumn<double>("light");
    for (int k = 0; k < 9; ++k) QTest::addRow("%g of full scale", 0.09 + 0.0025 * k) << 0.09 + 0.0025 * k;
  }
  /// Law: of even light, as a room's is, no exposure says another than a shorter one, wherever it lies to
  /// what is bright enough to be compared: which pixels are compared does not depend on their noise.
  void evenLightContradictsNothing() {
    QFETCH(double, light);
    CameraModel model;
    model.readNoise = 1e-3;
    model.gain = 1e-4;
    for (double ratio : {3.0, 12.0, 32.0}) {
      Shot shot;
      for (double seconds : {0.8, 0.8 / ratio}) {
        RawFrame frame{Image({160, 120}, 3), 0, seconds};
        for (std::size_t i = 0; i < frame.signal.data().size(); ++i) {
          Random random{11, static_cast<std::uint64_t>(1e6 * seconds), i};
          const double signal = light * seconds / 0.8;
          frame.signal.data()[i] =
              static_cast<float>(signal + std::sqrt(linearVariance(model, signal)) * random.normal());
        }
        shot.frames.push_back({std::move(frame)});
      }
      const double apart = bracketContradiction(shot, {model});
      QVERIFY2(apart < 0.01, qPrintable(QString("%1 by exposures 1 : %2").arg(apart).arg(ratio)));
    }
  }

  void oneExposureContradictsNothing() {
    Shot shot = bracketOf(1.0, 0.0);
    shot.frames.resize(1);
    QCOMPARE(bracketContradiction(shot, {CameraModel()}), 0.0);
    QVERIFY(!contradictoryViews(shot, {CameraModel()}));
  }

  void whatExposuresDifferBy_data() {
    QTest::addColumn<Image>("before");
    QTest::addColumn<Image>("after");
    QTest::addColumn<AlarmKind>("kind");
    const Image still = movedView(0, 0, 0);
    QTest::newRow("brighter") << still << scaled(still, 1.04) << AlarmKind::flicker;
    QTest::newRow("much darker") << still << scaled(still, 0.7) << AlarmKind::flicker;
    QTest::newRow("moved") << still << movedView(2.0, -1.0, 0) << AlarmKind::moved;
    QTest::newRow("turned") << still << movedView(0, 0, 4.0) << AlarmKind::moved;
    QTest::newRow("moved, and brighter") << still << scaled(movedView(-2.0, 1.0, 0), 1.1) << AlarmKind::moved;
    QTest::newRow("hidden") << still << covered(still) << AlarmKind::unsteady;
    for (const auto& [name, way] :
         {std::pair("of the surface", RoomLight::surface), std::pair("astray", RoomLight::astray)})
      for (double light : {0.05, 0.5}) {
        const Image bright = lit(still, light, way);
        QTest::addRow("light came on, %s, %g", name, light) << still << bright << AlarmKind::ambientChanged;
        QTest::addRow("light went, %s, %g", name, light) << bright << still << AlarmKind::ambientChanged;
      }
  }
  /// Law: a change of the pattern's light is told as flicker, of the room's as that, and a movement as one,
  /// whatever the longer exposure saturates and whichever came first; what is none is told as perhaps both.
  void whatExposuresDifferBy() {
    QFETCH(Image, before);
    QFETCH(Image, after);
    QFETCH(AlarmKind, kind);
    const bool isBrighter = after.data().front() > before.data().front();
    CameraModel model;
    model.readNoise = 1e-3;
    model.gain = 0.0;
    for (double longest : {0.9, 1.6})
      for (bool isLongerFirst : {true, false}) {
        const Shot shot = twoExposures(before, after, longest, isLongerFirst);
        const auto views = contradictoryViews(shot, {model});
        // Where the longer one is dark nothing is compared.
        if (!views && kind == AlarmKind::unsteady && !isLongerFirst) continue;
        QVERIFY(views && views->isLongerFirst == isLongerFirst);
        const double apart = bracketContradiction(shot, {model});
        const Alarm alarm = inspectContradiction(apart, *views, referencesOf(before.size()));
        const std::string what = english(alarm.what);
        QVERIFY2(alarm.kind == kind, what.c_str());
        QVERIFY(!alarm.advice.empty() && !alarm.safe.empty());
        if (kind == AlarmKind::unsteady)
          QVERIFY(what.find("flickers") != std::string::npos && what.find("moved") != std::string::npos);
        if (kind == AlarmKind::ambientChanged)
          QCOMPARE(what.find("brighter") != std::string::npos, isBrighter);
      }
  }
  /// From the earlier photograph to the later one.
  void aMovementIsToldInItsDirection() {
    for (bool isLongerFirst : {true, false}) {
      const Shot shot = twoExposures(movedView(0, 0, 0), movedView(3.0, 0, 0), 0.9, isLongerFirst);
      const Alarm alarm = inspectContradiction(0.1, contradictoryViews(shot, {CameraModel()}).value(),
                                               referencesOf({64, 48}));
      QCOMPARE(alarm.kind, AlarmKind::moved);
      QVERIFY2(english(alarm.what).find("shifted by 3.") != std::string::npos ||
                   english(alarm.what).find("shifted by 2.") != std::string::npos,
               english(alarm.what).c_str());
      // Neither light that flickers nor a movement takes all of it. Where the longer one is dark, nothing of
      // it is bright enough to be compared: the whole photograph is dark then, see unlessDark().
      if (!isLongerFirst) continue;
      Image dark = movedView(0, 0, 0);
      for (float& value : dark.data()) value *= 1e-3f;
      const Shot covered = twoExposures(movedView(0, 0, 0), dark, 0.9, isLongerFirst);
      QCOMPARE(inspectContradiction(0.99, contradictoryViews(covered, {CameraModel()}).value(),
                                    referencesOf({64, 48}))
                   .kind,
               AlarmKind::coveredLens);
    }
  }
};

QTEST_APPLESS_MAIN(TestInspection)
#include "test_inspection.moc"
