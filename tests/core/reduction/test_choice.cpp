// SPDX-License-Identifier: MIT
#include "relucent/reduction/choice.h"

#include <QTest>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/reduction/lit_part.h"
#include "relucent/reduction/reduced_rig.h"
#include "relucent/reduction/reduced_transport.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::reduction;
using namespace relucent::rig;
using namespace relucent::test;
using namespace relucent::transport;

namespace {

const Fits anySize = [](const Rasters&) { return true; };
constexpr PixelUse automatic{}, all{PixelUse::Kind::all}, thirds{PixelUse::Kind::binned, 3};

SyntheticSettings sceneOf(Size projector, Size camera, double shareSeen, std::uint64_t seed) {
  SyntheticSettings scene;
  scene.projectors = {projector};
  scene.cameras = {camera};
  scene.shareSeen = shareSeen;
  scene.interreflection = 0.03;
  scene.seed = seed;
  return scene;
}

ScriptedVenue venueOf(const SyntheticSettings& scene, const ScriptedCamera& camera = {}) {
  ScriptedSettings devices;
  devices.cameras = {camera};
  TransportMatrix transport = syntheticTransport(scene);
  CameraStack black = syntheticBlack(transport);
  return ScriptedVenue(std::move(transport), std::move(black), devices);
}

/// Light within a rectangle, a share of it scattered everywhere, and noise.
Image lightOf(Size size, Pixel begin, Size lit, double scattered, double noise, std::uint64_t seed) {
  Image light(size, 3);
  Random random{seed};
  for (std::size_t i = 0; i < light.pixels(); ++i) {
    const Pixel at = pixelAt(size, i);
    const bool inside =
        at.x >= begin.x && at.y >= begin.y && at.x < begin.x + lit.width && at.y < begin.y + lit.height;
    for (float& value : light.pixel(i))
      value =
          static_cast<float>((inside ? 0.2 + 0.8 * random.uniform() : scattered) + noise * random.normal());
  }
  return light;
}

}  // namespace

class TestChoice : public QObject {
  Q_OBJECT

 private slots:
  void whatIsLitIsFound_data() {
    QTest::addColumn<double>("scattered");
    QTest::addColumn<double>("noise");
    QTest::addColumn<bool>("glint");
    QTest::newRow("alone") << 0.0 << 0.0 << false;
    QTest::newRow("in noise") << 0.0 << 0.02 << false;
    QTest::newRow("scattered everywhere") << 0.02 << 0.0 << false;
    QTest::newRow("with a stray reflection") << 0.0 << 0.0 << true;
    QTest::newRow("all of it") << 0.02 << 0.005 << true;
  }
  void whatIsLitIsFound() {
    QFETCH(double, scattered);
    QFETCH(double, noise);
    QFETCH(bool, glint);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Pixel begin{31 + static_cast<int>(seed), 40};
      const Size size{80, 50};
      Image light = lightOf({200, 150}, begin, size, scattered, noise, seed);
      if (glint)
        for (float& value : light.pixel(indexOf({200, 150}, {190, 8}))) value = 1.0f;
      const LitPart part = litPart(light);
      // Brightness is a mean over neighbours, so the edge may be one pixel off.
      QVERIFY2(std::abs(part.begin.x - begin.x) <= 1 && std::abs(part.begin.y - begin.y) <= 1,
               qPrintable(QString("%1, %2 of seed %3").arg(part.begin.x).arg(part.begin.y).arg(seed)));
      QVERIFY(std::abs(part.size.width - size.width) <= 2 && std::abs(part.size.height - size.height) <= 2);
      QVERIFY(part.pixels >= size.count() * 95 / 100 && part.pixels <= size.count() * 110 / 100);
    }
  }

  void wholeViewsAndDarknessAreWhatTheyAre() {
    const LitPart whole = litPart(lightOf({40, 30}, {0, 0}, {40, 30}, 0.0, 0.0, 1));
    QCOMPARE(whole, (LitPart{{0, 0}, {40, 30}, 1200}));
    QCOMPARE(withSurroundings(whole, {40, 30}), whole);
    QCOMPARE(litPart(Image({40, 30}, 3)), LitPart());
    QCOMPARE(withSurroundings({{20, 2}, {32, 10}, 7}, {100, 13}), (LitPart{{18, 0}, {36, 13}, 7}));
  }

  /// Nothing is photographed, so nothing changes for those who need nothing of this.
  void camerasOfFewPixelsAreNotLookedAt() {
    const ScriptedVenue venue = venueOf(sceneOf({32, 24}, {32, 24}, 0.5, 1));
    Rig rig = venue.rig();
    Progress progress;
    QVERIFY(chooseReductions(rig, automatic, 1, anySize, progress).empty());
    QVERIFY(chooseReductions(rig, all, 1, anySize, progress).empty());
    QCOMPARE(venue.captures(), 0);
  }

  void litPixelsBecomeAboutAsManyAsTheProjectors_data() {
    QTest::addColumn<double>("shareSeen");
    QTest::addColumn<quint64>("seed");
    for (double share : {0.4, 0.6, 0.9})
      for (quint64 seed : {1, 2}) QTest::addRow("%.1f, seed %llu", share, seed) << share << seed;
  }
  void litPixelsBecomeAboutAsManyAsTheProjectors() {
    QFETCH(double, shareSeen);
    QFETCH(quint64, seed);
    const SyntheticSettings scene = sceneOf({32, 24}, {240, 180}, shareSeen, seed);
    const ScriptedVenue venue = venueOf(scene);
    Rig rig = venue.rig();
    Progress progress;
    const std::vector<Reduction> chosen = chooseReductions(rig, automatic, 1, anySize, progress);
    QCOMPARE(chosen.size(), std::size_t{1});
    const Reduction& reduction = chosen[0];

    // What the projector truly lights, far above what it scatters.
    const Image flood = imageFromStack(venue.transport().floodlight(), venue.transport().cameras(), 0);
    const float most = *std::ranges::max_element(flood.data());
    std::size_t lit = 0, missed = 0;
    for (std::size_t i = 0; i < flood.pixels(); ++i) {
      const Pixel at = pixelAt(flood.size(), i);
      const bool fillsABin =
          at.x < 240 / reduction.bin * reduction.bin && at.y < 180 / reduction.bin * reduction.bin;
      if (std::ranges::max(flood.pixel(i)) < 0.3f * most || !fillsABin) continue;
      ++lit;
      missed += at.x < reduction.begin.x || at.y < reduction.begin.y ||
                at.x >= reduction.begin.x + reduction.part.width ||
                at.y >= reduction.begin.y + reduction.part.height;
    }
    QVERIFY2(static_cast<double>(missed) <= 0.001 * static_cast<double>(lit),
             qPrintable(QString("%1 of %2 lit pixels are cut off").arg(missed).arg(lit)));
    const double projector = 32.0 * 24.0;
    const double seen = std::pow(shareSeen, 2.0) * 240.0 * 180.0;  // at most: a quarter more or less is lit
    const double bin = std::sqrt(seen / projector);
    QVERIFY2(reduction.bin >= static_cast<int>(0.8 * bin) && reduction.bin <= static_cast<int>(1.3 * bin),
             qPrintable(QString("bins of %1, %2 expected").arg(reduction.bin).arg(bin)));
    QVERIFY(reduction.size().count() >= 0.7 * projector);
    if (shareSeen < 0.7) QVERIFY(reduction.part.width < 0.95 * 240);
  }

  void somebodyMayWantOtherBins() {
    const ScriptedVenue venue = venueOf(sceneOf({32, 24}, {80, 60}, 0.6, 1));
    Rig rig = venue.rig();
    Progress progress;
    const std::vector<Reduction> chosen = chooseReductions(rig, thirds, 1, anySize, progress);
    QCOMPARE(chosen.size(), std::size_t{1});
    QCOMPARE(chosen[0].bin, 3);
    // Not so many become one that nothing is left to measure with.
    const Size least =
        chooseReductions(rig, {PixelUse::Kind::binned, mostBin}, 1, anySize, progress).at(0).size();
    QVERIFY(least.width >= 8 && least.height >= 8);
  }

  /// Law: bins are the least that suit the projection and fit, or the largest there are.
  void binsGrowUntilTheyFit_data() {
    QTest::addColumn<int>("most");  // camera pixels that fit
    QTest::addColumn<quint64>("seed");
    for (quint64 seed : {1, 2, 3})
      for (int most : {100'000, 700, 300, 120, 1})
        QTest::addRow("%d pixels, seed %llu", most, seed) << most << seed;
  }
  void binsGrowUntilTheyFit() {
    QFETCH(int, most);
    QFETCH(quint64, seed);
    const ScriptedVenue venue = venueOf(sceneOf({32, 24}, {160, 120}, 0.8, seed));
    Rig rig = venue.rig();
    Progress progress;
    const Fits fits = [most](const Rasters& cameras) { return cameras.count() <= std::size_t(most); };
    const Reduction suitable = chooseReductions(rig, automatic, seed, anySize, progress).at(0);
    const Reduction chosen = chooseReductions(rig, automatic, seed, fits, progress).at(0);
    QVERIFY(!suitable.savesMemory);
    QCOMPARE(chosen.savesMemory, chosen.bin > suitable.bin);
    QVERIFY(chosen.bin >= suitable.bin);
    // The one before does not fit, so far as there is one before.
    if (chosen.savesMemory) {
      const PixelUse before{PixelUse::Kind::binned, chosen.bin - 1};
      QVERIFY(!fits(Rasters(chooseReductions(rig, before, seed, anySize, progress).at(0).size())));
    }
    const int next = std::min(chosen.part.width, chosen.part.height) / (chosen.bin + 1);
    QVERIFY2(fits(Rasters(chosen.size())) || chosen.bin == mostBin || next < leastSide,
             qPrintable(QString("bins of %1, %2x%3 pixels")
                            .arg(chosen.bin)
                            .arg(chosen.size().width)
                            .arg(chosen.size().height)));
  }
  /// Others than automatic ones are as somebody wants them.
  void whatSomebodyWantsDoesNotGrow() {
    const ScriptedVenue venue = venueOf(sceneOf({32, 24}, {80, 60}, 0.6, 1));
    Rig rig = venue.rig();
    Progress progress;
    const Fits nothing = [](const Rasters&) { return false; };
    const Reduction chosen = chooseReductions(rig, thirds, 1, nothing, progress).at(0);
    QVERIFY(chosen.bin == 3 && !chosen.savesMemory);
    QVERIFY(chooseReductions(rig, all, 1, nothing, progress).empty());
  }
  /// Nobody would look at it if there were memory enough.
  void aCameraOfFewPixelsGetsLargerBinsToo() {
    const ScriptedVenue venue = venueOf(sceneOf({64, 48}, {48, 36}, 0.9, 1));
    Rig rig = venue.rig();
    Progress progress;
    QVERIFY(chooseReductions(rig, automatic, 1, anySize, progress).empty());
    const Fits few = [](const Rasters& cameras) { return cameras.count() <= 500; };
    const std::vector<Reduction> chosen = chooseReductions(rig, automatic, 1, few, progress);
    QVERIFY(chosen.size() == 1 && chosen[0].bin == 2 && chosen[0].savesMemory);
  }

  /// What is measured through the reduced camera is linear, whatever the camera's own response.
  void aCurvedCameraIsReducedLinearly() {
    const SyntheticSettings scene = sceneOf({32, 24}, {160, 120}, 0.8, 3);
    ScriptedCamera camera;
    camera.bits = 8;
    camera.response = gammaCurve(1.0 / 2.2);
    const ScriptedVenue venue = venueOf(scene, camera);
    Rig rig = venue.rig();
    Progress progress;
    const std::vector<Reduction> chosen = chooseReductions(rig, automatic, 1, anySize, progress);
    QVERIFY(chosen.at(0).bin > 1);
    QVERIFY(!chosen[0].response[0].isIdentity());

    Rig small = reduced(rig, chosen);
    small.projectors[0]->show(Image({32, 24}, 3, 1.0f));
    const CameraStack expected = reducedRadiance(venue.radiance({Image({32, 24}, 3, 1.0f)}), chosen);
    const float most = *std::ranges::max_element(expected);
    // The same light at two exposures: their ratio is that of the times, within the fit's 0.04.
    const double shorter = 0.2 / most, longer = 0.8 / most;
    const Image dark = small.cameras[0]->capture({{"a", 0}, 0, shorter}).signal;
    const Image bright = small.cameras[0]->capture({{"a", 1}, 0, longer}).signal;
    double darkSum = 0.0, brightSum = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i] < 0.2f * most || bright.data()[i] > 0.9f) continue;
      darkSum += static_cast<double>(dark.data()[i]);
      brightSum += static_cast<double>(bright.data()[i]);
    }
    QVERIFY2(std::abs(brightSum / darkSum / 4.0 - 1.0) < 0.04,
             qPrintable(QString("4 times the light gives %1 times the signal").arg(brightSum / darkSum)));
  }

  void hotSamplesAreFoundInTheDark() {
    const Size size{60, 50};
    auto dark = [size](std::uint64_t seed) {
      Image image(size, 3);
      Random random{seed};
      for (float& value : image.data())
        value = static_cast<float>(std::max(0.0, 0.01 + 0.002 * random.normal()));
      image.at(20, 30, 0) += 0.3f;
      image.at(0, 0, 2) += 0.1f;
      return image;
    };
    Image first = dark(1), second = dark(2);
    first.at(5, 5, 1) = 0.5f;  // a particle, once only
    const std::vector<std::uint32_t> expected{2, 3 * (30 * 60 + 20)};
    QCOMPARE(hotSamples(first, second), expected);
  }

  /// A dark picture with stars in it is lit, not broken.
  void muchLightIsNoFault() {
    Image stars({50, 50}, 3, 0.01f);
    for (int y = 1; y < 50; y += 4)
      for (int x = 1; x < 50; x += 4)
        for (int c = 0; c < 3; ++c) stars.at(x, y, c) = 0.5f;
    QVERIFY(hotSamples(stars, stars).empty());
  }
};

QTEST_GUILESS_MAIN(TestChoice)
#include "test_choice.moc"
