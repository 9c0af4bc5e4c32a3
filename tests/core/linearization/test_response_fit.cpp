// SPDX-License-Identifier: MIT
// Mosaics, and what the light that they make says of a projector.
#include "relucent/linearization/response_fit.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/linearization/additivity.h"
#include "relucent/linearization/mosaic.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::linearization;

namespace {

constexpr std::size_t levelCount = 12;

/// Lights a_iq of camera values: most see one group, all of them something of all others.
std::vector<std::array<double, mosaicLights>> lightsOf(std::size_t values, Random random) {
  std::vector<std::array<double, mosaicLights>> lights(values);
  for (std::size_t i = 0; i < values; ++i)
    for (std::size_t q = 0; q < mosaicLights; ++q) {
      double direct = q / 3 == i % 3 ? (q % 3 == i / 3 % 3 ? 0.5 : 0.1) : 0.0;
      lights[i][q] = (direct + 0.05) * (0.5 + random.uniform());
    }
  return lights;
}

struct World {
  std::vector<double> drives;
  LevelLights truth;
  std::vector<MosaicShot> shots;
  std::vector<double> power;  // of the lamp
  double whiteSegment = 0.0;
  double noise = 0.0;

  LightProducts products(std::size_t values, Random random, double exponent = 1.0) const {
    LightProducts result(shots.size());
    const auto lights = lightsOf(values, Random{9});
    for (const std::array<double, mosaicLights>& light : lights) {
      std::vector<double> seen(shots.size(), 0.0),
          variance(shots.size(), std::pow(std::max(noise, 1e-4), 2.0));
      for (std::size_t m = 0; m < shots.size(); ++m) {
        auto emitted = [&](std::size_t q) {
          std::size_t level = shots[m].level[q];
          return level > 0 ? std::pow(truth[q % 3][level - 1], exponent) : 0.0;
        };
        for (std::size_t q = 0; q < mosaicLights; ++q) {
          std::size_t first = q / 3 * 3;
          double least = std::min({emitted(first), emitted(first + 1), emitted(first + 2)});
          seen[m] += light[q] * (emitted(q) + whiteSegment * least);
        }
        seen[m] = power[m] * seen[m] + noise * random.normal();
      }
      result.add(seen, variance, 1.0 / variance.front());
    }
    return result;
  }
};

/// White, the lights, a group in white, all levels: as photographMosaics() shows them.
World worldOf(std::uint64_t seed, double drift, double flicker) {
  World world;
  for (std::size_t k = 1; k <= levelCount; ++k)
    world.drives.push_back(std::pow(static_cast<double>(k) / levelCount, 2.0));
  const std::array<double, 3> gammas{2.2, 1.0, 3.0};
  for (std::size_t c = 0; c < 3; ++c)
    for (double drive : world.drives) world.truth[c].push_back(std::pow(drive, gammas[c]));

  MosaicShot white, group;
  white.level.fill(levelCount);
  std::fill_n(group.level.begin(), 3, levelCount);
  world.shots.push_back(white);
  for (std::size_t q = 0; q < mosaicLights; ++q) {
    MosaicShot light;
    light.level[q] = levelCount;
    world.shots.push_back(light);
  }
  world.shots.push_back(group);
  for (std::size_t high = levelCount - 1; high > 0; high -= std::min<std::size_t>(high, 2)) {
    MosaicShot shot;
    for (std::size_t c = 0; c < 3; ++c) {
      shot.level[c] = high;
      shot.level[3 + (c + high) % 3] = high > 1 ? high - 1 : 0;
      shot.level[6 + c] = c == high % 3 ? levelCount : high;
    }
    world.shots.push_back(shot);
  }
  world.shots.push_back(white);
  Random random{seed};
  for (std::size_t m = 0; m < world.shots.size(); ++m) {
    world.shots[m].time = static_cast<double>(m);
    world.power.push_back(1.0 + drift * static_cast<double>(m) + flicker * random.normal());
  }
  return world;
}

LevelLights startOf(const World& world) {
  LevelLights start;
  for (std::vector<double>& channel : start)
    for (double drive : world.drives) channel.push_back(std::pow(drive, 2.2));
  return start;
}

double worst(const LevelLights& found, const LevelLights& truth) {
  double result = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < truth[c].size(); ++k)
      result = std::max(result, std::abs(found[c][k] - truth[c][k]));
  return result;
}

}  // namespace

class TestResponseFit : public QObject {
  Q_OBJECT

 private slots:
  /// Law: the nine lights of a mosaic make up white, and every cell belongs to one group.
  void aMosaicsLightsAddUpToWhite_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    for (Size size : {Size{1, 1}, Size{5, 4}, Size{64, 48}, Size{33, 100}})
      QTest::addRow("%dx%d", size.width, size.height) << size.width << size.height;
  }
  void aMosaicsLightsAddUpToWhite() {
    QFETCH(int, width);
    QFETCH(int, height);
    const Mosaic mosaic({width, height}, Random{4});
    Image sum({width, height}, 3);
    for (std::size_t q = 0; q < mosaicLights; ++q) {
      MosaicDrive drive{};
      drive[q] = 1.0;
      const Image light = mosaic.pattern(drive);
      for (std::size_t i = 0; i < sum.data().size(); ++i) sum.data()[i] += light.data()[i];
    }
    QCOMPARE(sum, Image({width, height}, 3, 1.0f));
  }

  void groupsAreEquallyLarge() {
    const Mosaic mosaic({96, 72}, Random{4});
    const Image pattern = mosaic.pattern({1, 0, 0, 0, 1, 0, 0, 0, 1});
    for (std::size_t c = 0; c < 3; ++c) {
      double share = 0.0;
      for (std::size_t i = 0; i < pattern.pixels(); ++i)
        share += static_cast<double>(pattern.pixel(i)[c]) / static_cast<double>(pattern.pixels());
      QVERIFY(std::abs(share - 1.0 / 3.0) < 0.02);
    }
  }

  /// Law: without noise, whatever the lights, the lamp and the white segment do, the response is exact.
  void withoutNoiseTheResponseIsExact_data() {
    QTest::addColumn<double>("drift");
    QTest::addColumn<double>("flicker");
    QTest::addColumn<double>("whiteSegment");
    QTest::newRow("steady lamp") << 0.0 << 0.0 << 0.0;
    QTest::newRow("drift") << 1e-3 << 0.0 << 0.0;
    QTest::newRow("flicker") << 0.0 << 2e-3 << 0.0;
    QTest::newRow("white segment") << 0.0 << 0.0 << 0.5;
    QTest::newRow("all") << -1e-3 << 2e-3 << 0.3;
  }
  void withoutNoiseTheResponseIsExact() {
    QFETCH(double, drift);
    QFETCH(double, flicker);
    QFETCH(double, whiteSegment);
    World world = worldOf(1, drift, flicker);
    world.whiteSegment = whiteSegment;
    const ResponseFit fit =
        fitResponse(world.drives, world.shots, world.products(900, Random{2}), startOf(world));
    // Photographs of three dark lights share a power that smoothness and the line alone tell.
    const double tolerance = flicker > 0.0 ? 3.0 * flicker : 1e-5;
    QVERIFY2(worst(fit.light, world.truth) < tolerance,
             qPrintable(QString::number(worst(fit.light, world.truth))));
    QVERIFY(std::abs(fit.whiteSegment - whiteSegment) < 0.02 * whiteSegment + tolerance);
    QVERIFY2(std::abs(fit.drift - drift) < 2e-4 + 0.2 * flicker, qPrintable(QString::number(fit.drift)));
  }

  /// Law: with noise the errors are what the fit says that they are.
  void deviationsTellTheErrors() {
    World world = worldOf(1, 0.0, 0.0);
    world.noise = 5e-3;
    double squares = 0.0, count = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const ResponseFit fit =
          fitResponse(world.drives, world.shots, world.products(900, Random{seed}), startOf(world));
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k + 1 < levelCount; ++k) {
          squares += std::pow((fit.light[c][k] - world.truth[c][k]) / fit.deviation[c][k], 2.0);
          count += 1.0;
        }
      QVERIFY(worst(fit.light, world.truth) < 0.01);
    }
    QVERIFY2(squares / count > 0.4 && squares / count < 1.7, qPrintable(QString::number(squares / count)));
  }

  /// Law: a region of the same response deviates by nothing, one of another exponent by what that makes.
  void aRegionsExponentIsFound_data() {
    QTest::addColumn<double>("exponent");
    for (double exponent : {1.0, 1.02, 1.1, 0.9}) QTest::addRow("%.2f", exponent) << exponent;
  }
  void aRegionsExponentIsFound() {
    QFETCH(double, exponent);
    const World world = worldOf(1, 0.0, 0.0);
    const ResponseFit fit =
        fitResponse(world.drives, world.shots, world.products(900, Random{2}), startOf(world));
    const RegionDeviation region = deviationOf(fit, world.shots, world.products(300, Random{3}, exponent));
    // f^(1 + x) = f + x f ln f + ..., against -b e f ln f.
    const double expected = (1.0 - exponent) / std::exp(1.0);
    for (double amplitude : region.amplitude)
      QVERIFY2(std::abs(amplitude - expected) < 0.15 * std::abs(expected) + 1e-4,
               qPrintable(QString("%1 for %2").arg(amplitude).arg(expected)));
  }

  void lightsThatNothingTellsApartAreRefused() {
    World world = worldOf(1, 0.0, 0.0);
    QVERIFY_EXCEPTION_THROWN(
        fitResponse(world.drives, world.shots, LightProducts(world.shots.size()), startOf(world)), Error);
  }

  void additivityIsOfColoursAndOfPlaces_data() {
    QTest::addColumn<double>("white");
    QTest::addColumn<double>("places");
    for (double white : {0.0, 0.3, -0.1})
      for (double places : {0.0, 0.2, -0.05}) QTest::addRow("%.2f, %.2f", white, places) << white << places;
  }
  void additivityIsOfColoursAndOfPlaces() {
    QFETCH(double, white);
    QFETCH(double, places);
    std::array<ChannelSums, mosaicLights> lights{};
    for (std::size_t q = 0; q < mosaicLights; ++q) lights[q].fill(1.0 + 0.1 * static_cast<double>(q));
    double group = 0.0, all = 0.0;
    for (std::size_t q = 0; q < mosaicLights; ++q) {
      all += lights[q][0];
      if (q < 3) group += lights[q][0];
    }
    ChannelSums inWhite{}, whole{};
    inWhite.fill(group * (1.0 + white));
    whole.fill(all * (1.0 + white) / (1.0 + places));
    const Additivity found = additivityOf(whole, lights, inWhite);
    QVERIFY(std::abs(found.white - white) < 1e-12);
    QVERIFY(std::abs(found.superposition - places) < 1e-12);
    QCOMPARE(additivityFindings(found, "projector", 0.025).size(),
             std::size_t{(std::abs(white) > 0.025 ? 1u : 0u) + (std::abs(places) > 0.025 ? 1u : 0u)});
  }
};

QTEST_APPLESS_MAIN(TestResponseFit)
#include "test_response_fit.moc"
