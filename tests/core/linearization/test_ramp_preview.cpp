// SPDX-License-Identifier: MIT
#include "relucent/linearization/ramp_preview.h"

#include <QtTest>
#include <cmath>

#include "relucent/linearization/mosaic.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::rig;

namespace {

constexpr Size size{40, 30};

/// A camera that sees every projector pixel, its neighbours and a little of everything, in mixed colours.
RawFrame photographOf(const Image& pattern, double seconds = 0.5) {
  Image light(size, 3);
  std::array<double, 3> mean{};
  for (std::size_t i = 0; i < pattern.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      double drive = static_cast<double>(pattern.pixel(i)[c]);
      light.pixel(i)[c] = static_cast<float>(drive * drive);
      mean[c] += drive * drive / static_cast<double>(size.count());
    }
  RawFrame frame{Image(size, 3), 0, seconds};
  for (std::size_t i = 0; i < light.pixels(); ++i) {
    const auto here = light.pixel(i), beside = light.pixel((i + 1) % light.pixels());
    for (std::size_t c = 0; c < 3; ++c) {
      double direct = 0.6 * here[c] + 0.2 * here[(c + 1) % 3] + 0.2 * beside[c] + 0.3 * mean[c];
      frame.signal.pixel(i)[c] = static_cast<float>(seconds * (0.01 + 0.8 * direct));
    }
  }
  return frame;
}

MosaicDrive lightAlone(std::size_t light) {
  MosaicDrive drive{};
  drive[light] = 1.0;
  return drive;
}

const MosaicDrive levels{0.25, 0.5, 1.0, 0.5, 0.75, 0.25, 0.125, 1.0, 0.5};

}  // namespace

class TestRampPreview : public QObject {
  Q_OBJECT

 private slots:
  void aMosaicShowsItsLevels() {
    const Mosaic mosaic(size, Random{3}, false);
    RampPreview preview;
    preview.add({Image(size, 3)}, photographOf(Image(size, 3)));
    for (std::size_t q = 0; q < mosaicLights; ++q) {
      const Image pattern = mosaic.pattern(lightAlone(q));
      preview.add({pattern}, photographOf(pattern));
      for (const auto& curve : preview.curves()) QVERIFY(curve.empty());
    }
    // Other exposures are as good.
    preview.add({mosaic.pattern(levels)}, photographOf(mosaic.pattern(levels), 0.25));
    const auto curves = preview.curves();
    for (std::size_t q = 0; q < mosaicLights; ++q)
      QVERIFY(std::abs(curves[q % 3].at(levels[q]) - levels[q] * levels[q]) < 1e-4);
    for (const auto& curve : curves) {
      QCOMPARE(curve.at(0.0), 0.0);
      QCOMPARE(curve.at(1.0), 1.0);
    }
  }

  /// Two pictures in the same place: what each shows is told by their dark cells.
  void mosaicsOfTwoProjectorsAreToldApart_data() {
    QTest::addColumn<int>("groups");
    for (int groups : {3, 2}) QTest::addRow("%d groups", groups) << groups;
  }
  void mosaicsOfTwoProjectorsAreToldApart() {
    QFETCH(int, groups);
    const auto count = static_cast<std::size_t>(groups);
    const std::array<Mosaic, 2> mosaics{Mosaic(size, Random{3}, true, count),
                                        Mosaic(size, Random{4}, true, count)};
    const std::array<MosaicDrive, 2> drives{levels, {0.75, 0.125, 0.5, 0.25, 1.0, 0.375, 0.5, 0.625, 0.75}};
    auto photographOfBoth = [](const Image& first, const Image& second) {
      RawFrame frame = photographOf(first);
      const RawFrame other = photographOf(second), none = photographOf(Image(size, 3));
      for (std::size_t i = 0; i < frame.signal.data().size(); ++i)
        frame.signal.data()[i] += 0.25f * (other.signal.data()[i] - none.signal.data()[i]);
      return frame;
    };
    const Image black(size, 3);
    RampPreview preview;
    preview.add({black, black}, photographOf(black));
    for (std::size_t q = 0; q < 3 * count; ++q) {
      const Image first = mosaics[0].pattern(lightAlone(q)), second = mosaics[1].pattern(lightAlone(q));
      preview.add({first, black}, photographOfBoth(first, black));
      preview.add({black, second}, photographOfBoth(black, second));
    }
    const Image first = mosaics[0].pattern(drives[0]), second = mosaics[1].pattern(drives[1]);
    preview.add({first, second}, photographOfBoth(first, second));
    for (std::size_t p = 0; p < 2; ++p) {
      const auto curves = preview.curves(p);
      for (std::size_t q = 0; q < 3 * count; ++q) {
        const double drive = drives[p][q], found = curves[q % 3].at(drive);
        QVERIFY2(std::abs(found - drive * drive) < 1e-3,
                 qPrintable(QString("%1 at %2").arg(found).arg(drive)));
      }
    }
    QVERIFY(preview.curves(2)[0].empty());
  }

  void anotherMosaicBeginsAnew() {
    RampPreview preview;
    preview.add({Image(size, 3)}, photographOf(Image(size, 3)));
    for (std::uint64_t seed : {1, 2}) {
      const Mosaic mosaic(size, Random{seed}, false);
      for (std::size_t q = 0; q < mosaicLights; ++q) {
        const Image pattern = mosaic.pattern(lightAlone(q));
        preview.add({pattern}, photographOf(pattern));
      }
      if (seed == 2)
        for (const auto& curve : preview.curves()) QVERIFY(curve.empty());
      preview.add({mosaic.pattern(levels)}, photographOf(mosaic.pattern(levels)));
    }
    QVERIFY(std::abs(preview.curves()[0].at(0.25) - 0.0625) < 1e-4);
  }

  void whatTellsNothingChangesNothing_data() {
    QTest::addColumn<int>("what");
    QTest::newRow("nothing known of the lights") << 0;
    QTest::newRow("no black") << 1;
    QTest::newRow("no exposure") << 2;
    QTest::newRow("all saturated") << 3;
    QTest::newRow("no mosaic") << 4;
    QTest::newRow("no pattern") << 5;
  }
  void whatTellsNothingChangesNothing() {
    QFETCH(int, what);
    const Mosaic mosaic(size, Random{3}, false);
    RampPreview preview;
    if (what != 1) preview.add({Image(size, 3)}, photographOf(Image(size, 3)));
    if (what != 0)
      for (std::size_t q = 0; q < mosaicLights; ++q)
        preview.add({mosaic.pattern(lightAlone(q))}, photographOf(mosaic.pattern(lightAlone(q))));
    Image pattern = mosaic.pattern(levels);
    RawFrame frame = photographOf(pattern);
    if (what == 2) frame.seconds = 0.0;
    if (what == 3) std::ranges::fill(frame.signal.data(), 1.0f);
    if (what == 4)
      for (std::size_t i = 0; i < pattern.data().size(); ++i)
        pattern.data()[i] = static_cast<float>(i % 101) / 101.0f;
    preview.add({what == 5 ? Image() : pattern}, frame);
    for (const auto& curve : preview.curves()) QVERIFY(curve.empty());
  }
};

QTEST_GUILESS_MAIN(TestRampPreview)
#include "test_ramp_preview.moc"
