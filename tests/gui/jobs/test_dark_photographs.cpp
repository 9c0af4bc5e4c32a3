// SPDX-License-Identifier: MIT
// Whether a lens is covered, on photographs by a camera of one's own.
#include "jobs/dark_photographs.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

constexpr Size view{40, 30};

struct Venue {
  double gamma = 2.2;  // of the projector
  double black = 0.0;  // light of the room and of black projectors, of full
  double noise = 0.002;
  bool isLinear = true;  // the camera
  Random random{11};

  /// A mosaic: half of it at `drive`, the rest dark.
  Image mosaic(double drive) {
    Image pattern(view, 3, 0.0f);
    for (float& value : pattern.data())
      if (random.uniform() < 0.5) value = static_cast<float>(drive);
    return pattern;
  }
  /// Of full light, one second is enough for half the range.
  RawFrame photograph(const std::vector<Image>& patterns, double seconds, double transmitted = 1.0) {
    RawFrame frame{Image(view, 3, 0.0f), 12, seconds};
    for (std::size_t i = 0; i < frame.signal.data().size(); ++i) {
      double light = black;
      for (const Image& pattern : patterns) light += std::pow(static_cast<double>(pattern.data()[i]), gamma);
      double signal = 0.5 * transmitted * seconds * light;
      if (!isLinear) signal = std::pow(std::min(1.0, signal), 1.0 / 2.2);
      frame.signal.data()[i] = static_cast<float>(std::clamp(signal + noise * random.normal(), 0.0, 1.0));
    }
    return frame;
  }
};

}  // namespace

class TestDarkPhotographs : public QObject {
  Q_OBJECT

 private slots:
  /// Law: levels from the highest down, with exposures that suit them, are never dark, whatever the
  /// projector's curve, the room and the camera; a cover over the lens is, from its second photograph on,
  /// and no longer than it lasts.
  void onlyACoveredLensIsDark_data() {
    QTest::addColumn<double>("gamma");
    QTest::addColumn<double>("black");
    QTest::addColumn<bool>("isLinear");
    for (double gamma : {1.8, 2.2, 2.8})
      for (double black : {0.0, 0.02})
        for (bool isLinear : {true, false})
          QTest::addRow("gamma %.1f, black %.2f, %s", gamma, black, isLinear ? "linear" : "a curve")
              << gamma << black << isLinear;
  }
  void onlyACoveredLensIsDark() {
    QFETCH(double, gamma);
    QFETCH(double, black);
    QFETCH(bool, isLinear);
    Venue venue{.gamma = gamma, .black = black, .isLinear = isLinear};
    for (int coveredFrom : {1000, 5, 12, 20}) {
      DarkPhotographs photographs;
      int told = 0;
      for (int level = 32; level >= 4; --level) {
        const int shot = 32 - level;
        const bool isCovered = shot >= coveredFrom && shot < coveredFrom + 4;
        const std::vector<Image> patterns{venue.mosaic(level / 32.0)};
        // Dim levels have long exposures besides.
        for (double seconds : level < 14 ? std::vector{16.0, 4.0} : std::vector{1.0}) {
          photographs.add(0, patterns, venue.photograph(patterns, seconds, isCovered ? 0.0 : 1.0));
          if (photographs.last()) ++told;
          QVERIFY2(isCovered || !photographs.last(), qPrintable(QString::number(shot)));
        }
        if (isCovered && shot > coveredFrom) QVERIFY(photographs.last());
      }
      QCOMPARE(told > 0, coveredFrom < 1000);
    }
  }

  /// Law: a camera that does not see one of the projectors misses nothing.
  void whatACameraNeverSawIsNotMissed() {
    Venue venue;
    DarkPhotographs photographs;
    const Image dark(view, 3, 0.0f);
    for (int shot = 0; shot < 12; ++shot) {
      const Image seen = venue.mosaic(1.0);
      photographs.add(0, {seen, dark}, venue.photograph({seen}, 1.0));
      photographs.add(1, {seen, dark}, venue.photograph({seen}, 1.0));
    }
    for (int shot = 0; shot < 12; ++shot) {
      const Image unseen = venue.mosaic(1.0);
      photographs.add(0, {dark, unseen}, venue.photograph({dark}, 1.0));
      photographs.add(1, {dark, unseen}, venue.photograph({unseen}, 1.0));
      QVERIFY(!photographs.last());
    }
  }

  void blackSaysNothing() {
    Venue venue;
    DarkPhotographs photographs;
    for (int shot = 0; shot < 6; ++shot) {
      const Image pattern = venue.mosaic(1.0);
      photographs.add(0, {pattern}, venue.photograph({pattern}, 1.0));
    }
    const Image dark(view, 3, 0.0f);
    for (int shot = 0; shot < 6; ++shot) photographs.add(0, {dark}, venue.photograph({dark}, 1.0));
    QVERIFY(!photographs.last());
    photographs.add(0, {}, {});
    QVERIFY(!photographs.last());
  }

  void whatIsForgottenIsNotCompared() {
    Venue venue;
    DarkPhotographs photographs;
    const std::vector<Image> patterns{venue.mosaic(1.0)};
    for (int shot = 0; shot < 6; ++shot) photographs.add(0, patterns, venue.photograph(patterns, 1.0));
    for (int shot = 0; shot < 2; ++shot) photographs.add(0, patterns, venue.photograph(patterns, 1.0, 0.0));
    QVERIFY(photographs.last());
    photographs.forget();
    QVERIFY(!photographs.last());
    photographs.add(0, patterns, venue.photograph(patterns, 1.0, 0.0));
    QVERIFY(!photographs.last());
  }
};

QTEST_APPLESS_MAIN(TestDarkPhotographs)
#include "test_dark_photographs.moc"
