// SPDX-License-Identifier: MIT
// Mosaics, and what the light that they make says of a projector.
#include "relucent/linearization/response_fit.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/linearization/additivity.h"
#include "relucent/linearization/mosaic.h"
#include "relucent/linearization/mosaic_photographs.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::linearization;

namespace {

constexpr std::size_t levelCount = 12;

struct Emitter {
  double drift = 0.0, flicker = 0.0, whiteSegment = 0.0;
  double brightness = 1.0;
  std::array<double, 3> gammas{2.2, 1.0, 3.0};
};

enum class Where { samePlace, sideBySide };

/// Lights a_iq of camera values: most see one group, all of them something of all others. Two projectors with
/// the same place have a constant ratio of brightness there: only cells of no group tell them apart.
std::vector<std::vector<double>> lightsOf(std::size_t values, const std::vector<Emitter>& emitters,
                                          Where where, Random random) {
  const std::size_t count = emitters.size();
  std::vector<std::vector<double>> lights(values, std::vector<double>(count * mosaicLights, 0.0));
  for (std::size_t i = 0; i < values; ++i) {
    std::array<double, mosaicLights> surface{};
    for (double& value : surface) value = 0.5 + random.uniform();
    for (std::size_t p = 0; p < count; ++p) {
      const std::size_t group = count > 1 ? random.below(mosaicGroups + 1) : i % mosaicGroups;
      if (where == Where::sideBySide && i % count != p) continue;
      for (std::size_t q = 0; q < mosaicLights; ++q) {
        double direct = q / 3 == group ? (q % 3 == i / 3 % 3 ? 0.5 : 0.1) : 0.0;
        lights[i][p * mosaicLights + q] = emitters[p].brightness * (direct + 0.05) * surface[q % 3];
      }
    }
  }
  return lights;
}

struct World {
  std::vector<Emitter> emitters;
  Where where = Where::samePlace;
  std::vector<std::vector<double>> drives;  // [projector][level]
  std::vector<LevelLights> truth;
  std::vector<MosaicShot> shots;
  std::vector<std::vector<double>> power;  // of the lamps, [projector][shot]
  double noise = 0.0;

  LightProducts products(std::size_t values, Random random, double exponent = 1.0) const {
    LightProducts result(shots.size());
    const auto lights = lightsOf(values, emitters, where, Random{9});
    for (const std::vector<double>& light : lights) {
      std::vector<double> seen(shots.size(), 0.0),
          variance(shots.size(), std::pow(std::max(noise, 1e-4), 2.0));
      for (std::size_t m = 0; m < shots.size(); ++m) {
        for (std::size_t p = 0; p < emitters.size(); ++p) {
          auto emitted = [&](std::size_t q) {
            std::size_t level = shots[m].level[p][q];
            return level > 0 ? std::pow(truth[p][q % 3][level - 1], exponent) : 0.0;
          };
          for (std::size_t q = 0; q < mosaicLights; ++q) {
            std::size_t first = q / 3 * 3;
            double least = std::min({emitted(first), emitted(first + 1), emitted(first + 2)});
            seen[m] +=
                power[p][m] * light[p * mosaicLights + q] * (emitted(q) + emitters[p].whiteSegment * least);
          }
        }
        seen[m] += noise * random.normal();
      }
      result.add(seen, variance, 1.0 / variance.front());
    }
    return result;
  }
};

/// White, every projector's lights and one group in white, the levels of all: as photographMosaics() shows
/// them.
World worldOf(std::uint64_t seed, std::vector<Emitter> emitters, Where where = Where::samePlace) {
  World world;
  world.where = where;
  const std::size_t count = emitters.size();
  MosaicShot dark{std::vector<MosaicLevels>(count, MosaicLevels{}), 0.0}, white = dark;
  for (std::size_t p = 0; p < count; ++p) {
    std::vector<double>& drives = world.drives.emplace_back();
    for (std::size_t k = 1; k <= levelCount; ++k)
      drives.push_back(std::pow(static_cast<double>(k) / levelCount, 2.0));
    LevelLights& truth = world.truth.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      for (double drive : drives) truth[c].push_back(std::pow(drive, emitters[p].gammas[c]));
    white.level[p].fill(levelCount);
  }
  world.shots.push_back(white);
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t q = 0; q < mosaicLights; ++q) {
      MosaicShot light = dark;
      light.level[p][q] = levelCount;
      world.shots.push_back(light);
    }
    MosaicShot group = dark;
    std::fill_n(group.level[p].begin(), 3, levelCount);
    world.shots.push_back(group);
  }
  for (std::size_t high = levelCount - 1; high > 0; high -= std::min<std::size_t>(high, 2)) {
    MosaicShot shot = dark;
    for (std::size_t p = 0; p < count; ++p)
      for (std::size_t c = 0; c < 3; ++c) {
        // Which group shows what differs from projector to projector.
        auto group = [p](std::size_t g) { return 3 * ((g + p) % mosaicGroups); };
        shot.level[p][group(0) + c] = high;
        shot.level[p][group(1) + (c + high) % 3] = high > 1 ? high - 1 : 0;
        shot.level[p][group(2) + c] = c == high % 3 ? levelCount : high;
      }
    world.shots.push_back(shot);
  }
  world.shots.push_back(white);
  Random random{seed};
  world.power.resize(count);
  for (std::size_t m = 0; m < world.shots.size(); ++m) {
    world.shots[m].time = static_cast<double>(m);
    for (std::size_t p = 0; p < count; ++p)
      world.power[p].push_back(1.0 + emitters[p].drift * static_cast<double>(m) +
                               emitters[p].flicker * random.normal());
  }
  world.emitters = std::move(emitters);
  return world;
}

std::vector<ResponseFit> fitOf(const World& world, const LightProducts& products, Progress progress = {}) {
  return fitResponses(world.drives, world.shots, products, usualResponses(world.drives), progress);
}

/// Asks to cancel at a report, counted from 1; 0: before the first.
class StopAt : public ProgressSink {
 public:
  explicit StopAt(int report) : report_(report) { askIfDue(); }
  void progressed(double fraction, const Message&) override {
    fraction_ = fraction;
    ++reports_;
    askIfDue();
  }
  Progress progress() { return {*this, stop_}; }
  int reports() const { return reports_; }
  double fraction() const { return fraction_; }

 private:
  void askIfDue() {
    if (reports_ == report_) stop_.ask(StopRequest::Kind::cancel);
  }

  int report_, reports_ = 0;
  double fraction_ = 0.0;
  StopRequest stop_;
};

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
  /// Law: the nine lights of a mosaic make up white, and every cell belongs to one group or, where cells stay
  /// dark, to none.
  void aMosaicsLightsAddUpToWhite_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("projectors");
    for (int projectors : {1, 2, 4})
      for (Size size : {Size{1, 1}, Size{5, 4}, Size{64, 48}, Size{33, 100}})
        QTest::addRow("%dx%d, of %d", size.width, size.height, projectors)
            << size.width << size.height << projectors;
  }
  void aMosaicsLightsAddUpToWhite() {
    QFETCH(int, width);
    QFETCH(int, height);
    QFETCH(int, projectors);
    const MosaicOrder order{static_cast<std::size_t>(projectors)};
    const bool darkCells = projectors > 1;
    const Mosaic mosaic({width, height}, Random{4}, darkCells, order.lights() / 3);
    Image sum({width, height}, 3);
    for (std::size_t q = 0; q < order.lights(); ++q) {
      MosaicDrive drive{};
      drive[q] = 1.0;
      const Image light = mosaic.pattern(drive);
      for (std::size_t i = 0; i < sum.data().size(); ++i) sum.data()[i] += light.data()[i];
    }
    MosaicDrive all{};
    all.fill(1.0);
    QCOMPARE(sum, mosaic.pattern(all));
    const auto dark = std::ranges::count(sum.data(), 0.0f);
    QCOMPARE(std::ranges::count(sum.data(), 1.0f) + dark, static_cast<std::ptrdiff_t>(sum.data().size()));
    if (!darkCells) QCOMPARE(dark, std::ptrdiff_t{0});
  }

  void groupsAreEquallyLarge_data() {
    QTest::addColumn<bool>("darkCells");
    QTest::addColumn<int>("groups");
    QTest::newRow("all cells lit") << false << 3;
    QTest::newRow("dark cells") << true << 3;
    QTest::newRow("of many projectors") << true << 2;
  }
  void groupsAreEquallyLarge() {
    QFETCH(bool, darkCells);
    QFETCH(int, groups);
    const Mosaic mosaic({96, 72}, Random{4}, darkCells, static_cast<std::size_t>(groups));
    const Image pattern = mosaic.pattern({1, 0, 0, 0, 1, 0, 0, 0, 1});
    for (std::size_t c = 0; c < static_cast<std::size_t>(groups); ++c) {
      double share = 0.0;
      for (std::size_t i = 0; i < pattern.pixels(); ++i)
        share += static_cast<double>(pattern.pixel(i)[c]) / static_cast<double>(pattern.pixels());
      QVERIFY(std::abs(share - (darkCells ? 6.0 / 7.0 : 1.0) / groups) < 0.02);
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
    const World world = worldOf(1, {{drift, flicker, whiteSegment}});
    const ResponseFit fit = fitOf(world, world.products(900, Random{2})).front();
    // Photographs of three dark lights share a power that smoothness and the line alone tell.
    const double tolerance = flicker > 0.0 ? 3.0 * flicker : 1e-5;
    QVERIFY2(worst(fit.light, world.truth[0]) < tolerance,
             qPrintable(QString::number(worst(fit.light, world.truth[0]))));
    QVERIFY(std::abs(fit.whiteSegment - whiteSegment) < 0.02 * whiteSegment + tolerance);
    QVERIFY2(std::abs(fit.drift - drift) < 2e-4 + 0.2 * flicker, qPrintable(QString::number(fit.drift)));
  }

  /// Law: the same holds for two projectors in the same photographs, each with what its own lamp does.
  void twoProjectorsAreToldApart_data() {
    QTest::addColumn<std::vector<Emitter>>("emitters");
    QTest::addColumn<bool>("sideBySide");
    const std::array<double, 3> soft{1.8, 1.8, 1.8}, usual{2.2, 2.2, 2.2};
    const std::vector<std::pair<const char*, std::vector<Emitter>>> rows{
        {"alike", {{}, {}}},
        {"other curves, one four times as bright",
         {{.brightness = 0.25, .gammas = usual}, {.brightness = 1.0, .gammas = soft}}},
        {"one drifts", {{}, {.drift = 1e-3}}},
        {"they drift apart", {{.drift = -1e-3}, {.drift = 1e-3}}},
        {"one flickers", {{}, {.flicker = 4e-3}}},
        {"white segment in the first", {{.whiteSegment = 0.4}, {}}},
        {"white segment in the second, all else", {{.drift = 1e-3}, {.flicker = 2e-3, .whiteSegment = 0.4}}}};
    for (bool sideBySide : {false, true})
      for (const auto& [name, emitters] : rows)
        QTest::addRow("%s, %s", name, sideBySide ? "side by side" : "in the same place")
            << emitters << sideBySide;
  }
  void twoProjectorsAreToldApart() {
    QFETCH(std::vector<Emitter>, emitters);
    QFETCH(bool, sideBySide);
    const World world = worldOf(1, emitters, sideBySide ? Where::sideBySide : Where::samePlace);
    const std::vector<ResponseFit> fits = fitOf(world, world.products(1800, Random{2}));
    QCOMPARE(fits.size(), emitters.size());
    double most = 0.0;
    for (const Emitter& emitter : emitters) most = std::max(most, emitter.flicker);
    const double tolerance = most > 0.0 ? 3.0 * most : 1e-5;
    for (std::size_t p = 0; p < fits.size(); ++p) {
      const Emitter& emitter = emitters[p];
      const QString name = QString("projector %1: %2");
      QVERIFY2(worst(fits[p].light, world.truth[p]) < tolerance,
               qPrintable(name.arg(p).arg(worst(fits[p].light, world.truth[p]))));
      QVERIFY2(std::abs(fits[p].whiteSegment - emitter.whiteSegment) <
                   0.02 * emitter.whiteSegment + tolerance + 1e-4,
               qPrintable(name.arg(p).arg(fits[p].whiteSegment)));
      QVERIFY2(std::abs(fits[p].drift - emitter.drift) < 2e-4 + 0.2 * emitter.flicker,
               qPrintable(name.arg(p).arg(fits[p].drift)));
      QVERIFY2(std::abs(fits[p].flicker - emitter.flicker) < 0.4 * emitter.flicker + 1.2e-3,
               qPrintable(name.arg(p).arg(fits[p].flicker)));
    }
  }

  /// Law: with noise the errors are what the fit says that they are.
  void deviationsTellTheErrors_data() {
    QTest::addColumn<int>("projectors");
    QTest::addColumn<bool>("sideBySide");
    QTest::newRow("one projector") << 1 << false;
    QTest::newRow("two in the same place") << 2 << false;
    QTest::newRow("two side by side") << 2 << true;
  }
  void deviationsTellTheErrors() {
    QFETCH(int, projectors);
    QFETCH(bool, sideBySide);
    World world = worldOf(1, std::vector<Emitter>(static_cast<std::size_t>(projectors)),
                          sideBySide ? Where::sideBySide : Where::samePlace);
    world.noise = 5e-3;
    double squares = 0.0, count = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const std::vector<ResponseFit> fits = fitOf(world, world.products(900, Random{seed}));
      for (std::size_t p = 0; p < fits.size(); ++p) {
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t k = 0; k + 1 < levelCount; ++k) {
            squares += std::pow((fits[p].light[c][k] - world.truth[p][c][k]) / fits[p].deviation[c][k], 2.0);
            count += 1.0;
          }
        QVERIFY(worst(fits[p].light, world.truth[p]) < 0.01);
      }
    }
    QVERIFY2(squares / count > 0.4 && squares / count < 1.7, qPrintable(QString::number(squares / count)));
  }

  /// Law: residuals are what photographs say of a level beyond the smooth curve: next to nothing where they
  /// are clean, and more the noisier they are; full light has none.
  void residualsAreWhatSmoothingTakesAway() {
    World world = worldOf(3, {Emitter{}});
    const auto largest = [&world](double noise) {
      world.noise = noise;
      const ResponseFit fit = fitOf(world, world.products(600, Random{5})).front();
      double most = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        if (fit.residual[c].size() != fit.light[c].size() || fit.residual[c].back() != 0.0) return 1.0;
        for (double residual : fit.residual[c]) most = std::max(most, std::abs(residual));
      }
      return most;
    };
    const double clean = largest(1e-4), noisy = largest(1e-2);
    QVERIFY2(clean < 5e-4, qPrintable(QString::number(clean)));
    QVERIFY2(noisy > 3.0 * clean && noisy < 0.05, qPrintable(QString::number(noisy)));
  }

  /// Law: a region of the same response deviates by nothing, one of another exponent by what that makes.
  void aRegionsExponentIsFound_data() {
    QTest::addColumn<double>("exponent");
    QTest::addColumn<int>("projectors");
    for (int projectors : {1, 2})
      for (double exponent : {1.0, 1.02, 1.1, 0.9})
        QTest::addRow("%.2f, %d projectors", exponent, projectors) << exponent << projectors;
  }
  void aRegionsExponentIsFound() {
    QFETCH(double, exponent);
    QFETCH(int, projectors);
    const World world = worldOf(1, std::vector<Emitter>(static_cast<std::size_t>(projectors)));
    const std::vector<ResponseFit> fits = fitOf(world, world.products(1800, Random{2}));
    const std::vector<RegionDeviation> regions =
        deviationsOf(fits, world.shots, world.products(600, Random{3}, exponent));
    QCOMPARE(regions.size(), fits.size());
    // f^(1 + x) = f + x f ln f + ..., against -b e f ln f.
    const double expected = (1.0 - exponent) / std::exp(1.0);
    for (const RegionDeviation& region : regions)
      for (double amplitude : region.amplitude)
        QVERIFY2(std::abs(amplitude - expected) < 0.15 * std::abs(expected) + 1e-4,
                 qPrintable(QString("%1 for %2").arg(amplitude).arg(expected)));
  }

  /// Whoever waits sees that it goes on, and may end it whenever it says so.
  void theFitTellsHowFarItIs() {
    const World world = worldOf(1, std::vector<Emitter>(3));
    const LightProducts products = world.products(1800, Random{2});
    StopAt whole(-1);
    fitOf(world, products, whole.progress());
    QVERIFY2(whole.reports() >= 4, qPrintable(QString::number(whole.reports())));
    QCOMPARE(whole.fraction(), 1.0);
    for (int at = 1; at <= whole.reports(); ++at) {
      StopAt stopping(at);
      QVERIFY_EXCEPTION_THROWN(fitOf(world, products, stopping.progress()), Cancelled);
      QCOMPARE(stopping.reports(), at);
    }
  }
  /// Within a moment: before the first report as well.
  void theFitLooksForTheEndAtEveryStep() {
    const World world = worldOf(1, {{}});
    StopAt stopped(0);
    QVERIFY_EXCEPTION_THROWN(fitOf(world, world.products(900, Random{2}), stopped.progress()), Cancelled);
    QCOMPARE(stopped.reports(), 0);
  }

  void lightsThatNothingTellsApartAreRefused() {
    const World world = worldOf(1, {{}});
    QVERIFY_EXCEPTION_THROWN(fitOf(world, LightProducts(world.shots.size())), Error);
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
    const ChannelSums lights{9.0, 6.0, 12.0}, groupLights{1.0, 0.5, 2.0};
    ChannelSums inWhite{}, whole{};
    for (std::size_t c = 0; c < 3; ++c) {
      inWhite[c] = groupLights[c] * (1.0 + white);
      whole[c] = lights[c] * (1.0 + white) / (1.0 + places);
    }
    const Additivity found = additivityOf(whole, lights, inWhite, groupLights);
    QVERIFY(std::abs(found.white - white) < 1e-12);
    QVERIFY(std::abs(found.superposition - places) < 1e-12);
    QCOMPARE(additivityFindings(found, "projector", 0.025).size(),
             std::size_t{(std::abs(white) > 0.025 ? 1u : 0u) + (std::abs(places) > 0.025 ? 1u : 0u)});
  }
};

QTEST_APPLESS_MAIN(TestResponseFit)
#include "test_response_fit.moc"
