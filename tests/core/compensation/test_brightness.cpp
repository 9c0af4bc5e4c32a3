// SPDX-License-Identifier: MIT
#include "relucent/compensation/brightness.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/compensation/prediction.h"
#include "relucent/image/metrics.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::synthetic;

namespace {

using Limits = std::pair<float, float>;

/// A grid of samples of one grey. `limits`: least and most of each place.
template <typename LimitsAt>
std::vector<BrightnessSample> samplesOf(float grey, const LimitsAt& limits) {
  std::vector<BrightnessSample> samples;
  for (int y = 0; y < 36; ++y)
    for (int x = 0; x < 48; ++x) {
      BrightnessSample sample;
      sample.u = (static_cast<float>(x) + 0.5f) / 48.0f;
      sample.v = (static_cast<float>(y) + 0.5f) / 36.0f;
      const auto [least, most] = limits(sample.u, sample.v);
      sample.wanted.fill(grey);
      sample.least.fill(least);
      sample.most.fill(most);
      samples.push_back(sample);
    }
  return samples;
}

float mostOf(const BrightnessField& field) {
  return *std::ranges::max_element(field.octaves);
}
float leastOf(const BrightnessField& field) {
  return *std::ranges::min_element(field.octaves);
}

MeasuredVenue venueOf(const Scene& scene) {
  return {scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
}

}  // namespace

class TestBrightness : public QObject {
  Q_OBJECT

  static void everyWay() {
    QTest::addColumn<Brightness>("way");
    for (Brightness way : allValues<Brightness>())
      QTest::addRow("%s", std::string(nameOf(way)).c_str()) << way;
  }

 private slots:
  void whatCanBeHadStays_data() { everyWay(); }
  /// Where nothing is out of reach, whichever way, white is what it was.
  void whatCanBeHadStays() {
    QFETCH(Brightness, way);
    const BrightnessFit fit(way, 4.0 / 3.0);
    const BrightnessField field = fit.fit(samplesOf(0.5f, [](float, float) { return Limits{0.0f, 9.0f}; }));
    for (float octaves : field.octaves) QVERIFY(std::abs(octaves) < 1e-5f);
    QCOMPARE(BrightnessFit(way, 1.0).fit({}).octaves, BrightnessField().octaves);
  }

  void theDarkAsksForMoreTheBrightForLess_data() { everyWay(); }
  /// A picture darker than the room's black gets a brighter white, one brighter than there is light a darker
  /// one, within the limits.
  void theDarkAsksForMoreTheBrightForLess() {
    QFETCH(Brightness, way);
    const BrightnessFit fit(way, 4.0 / 3.0);
    const BrightnessField dark = fit.fit(samplesOf(0.01f, [](float, float) { return Limits{0.03f, 1.0f}; }));
    const BrightnessField bright =
        fit.fit(samplesOf(0.9f, [](float, float) { return Limits{0.001f, 0.6f}; }));
    if (way == Brightness::even) {
      QCOMPARE(dark.octaves, BrightnessField().octaves);
      QCOMPARE(bright.octaves, BrightnessField().octaves);
      return;
    }
    QVERIFY2(leastOf(dark) > 0.3f && mostOf(dark) <= 2.0f, qPrintable(QString::number(leastOf(dark))));
    QVERIFY2(mostOf(bright) < -0.2f && leastOf(bright) >= -0.5f, qPrintable(QString::number(mostOf(bright))));
    // One grey in one light: the same everywhere.
    QVERIFY(mostOf(dark) - leastOf(dark) < 1e-4f);
  }

  void regionsFollowTheirLight_data() {
    QTest::addColumn<double>("aspect");
    for (double aspect : {0.5, 4.0 / 3.0, 2.39}) QTest::addRow("%g", aspect) << aspect;
  }
  /// Where light is missing white gets dimmer, where the room is too bright it gets brighter, and no step is
  /// in between.
  void regionsFollowTheirLight() {
    QFETCH(double, aspect);
    const auto samples =
        samplesOf(0.3f, [](float u, float) { return u < 0.5f ? Limits{0.001f, 0.2f} : Limits{0.4f, 1.5f}; });
    const BrightnessField one = BrightnessFit(Brightness::picture, aspect).fit(samples);
    QVERIFY(mostOf(one) == leastOf(one));
    const BrightnessField field = BrightnessFit(Brightness::region, aspect).fit(samples);
    QVERIFY(field.octavesAt(0.0f, 0.5f) < field.octavesAt(1.0f, 0.5f) - 0.05f);
    float before = field.octavesAt(0.0f, 0.5f);
    for (int step = 1; step <= 200; ++step) {
      const float here = field.octavesAt(static_cast<float>(step) / 200.0f, 0.5f);
      // Half an octave over a quarter of the picture's mean side would be 0.01 a step.
      QVERIFY(here >= before - 1e-5f &&
              here - before < 0.01f * std::max(1.0f, std::sqrt(static_cast<float>(aspect))));
      before = here;
    }
    // Rows do not differ in light.
    QVERIFY(std::abs(field.octavesAt(0.3f, 0.1f) - field.octavesAt(0.3f, 0.9f)) < 1e-4f);
  }

  /// A little change of a picture changes little: films do not jump where the best gain lies between two.
  void changesLittleWithThePicture() {
    const BrightnessFit fit(Brightness::region, 4.0 / 3.0);
    BrightnessField before;
    for (int frame = 0; frame <= 40; ++frame) {
      const float grey = 0.01f + 0.0005f * static_cast<float>(frame);
      const BrightnessField field =
          fit.fit(samplesOf(grey, [](float u, float) { return Limits{0.02f, 0.5f + u}; }));
      if (frame > 0)
        for (std::size_t i = 0; i < field.octaves.size(); ++i)
          QVERIFY2(std::abs(field.octaves[i] - before.octaves[i]) < 0.15f,
                   qPrintable(QString("%1: %2 %3").arg(frame).arg(field.octaves[i]).arg(before.octaves[i])));
      before = field;
    }
  }

  void targetsKeepTheirHue_data() { everyWay(); }
  /// The same gain for all channels, 1 where the target is even; and everything else as it was.
  void targetsKeepTheirHue() {
    QFETCH(Brightness, way);
    Scene scene = makeScene({});
    for (float& value : scene.black) value *= 10.0f;
    const MeasuredVenue venue = venueOf(scene);
    Image content = makeContent(Content::saturated, {40, 30}, 2);
    for (float& value : content.data()) value *= 0.1f;
    TargetSettings settings;
    const Target even = fitTarget(content, venue, settings);
    settings.brightness = way;
    const Target target = fitTarget(content, venue, settings);
    QCOMPARE(target.gain.empty(), way == Brightness::even);
    QVERIFY(target.white == even.white && target.inside == even.inside && target.content == even.content);
    double differs = 0.0;
    for (std::size_t i = 0; i < target.wanted.size(); ++i) {
      const float gain = target.gain.empty() ? 1.0f : target.gain[i / 3];
      if (!target.inside[i / 3])
        QCOMPARE(target.wanted[i], even.wanted[i]);
      else
        QVERIFY(std::abs(target.wanted[i] - gain * even.wanted[i]) <= 1e-5f * target.white[0]);
      QVERIFY(gain >= 0.7f && gain <= 4.001f);
      differs = std::max(differs, std::abs(static_cast<double>(gain) - 1.0));
    }
    QVERIFY(way == Brightness::even || differs > 0.05);
    const Image seen = underEvenWhite(target.wanted, target, venue.transport.cameras(), 0);
    for (std::size_t i = 0; i < seen.data().size(); ++i)
      if (target.inside[i / 3]) QVERIFY(std::abs(seen.data()[i] - even.wanted[i]) < 1e-5f * target.white[0]);
  }

  /// What is compensated is nearer to what is wanted than under an even white.
  void darkPicturesComeNearer() {
    SceneSettings s;
    Scene scene = makeScene(s);
    for (float& value : scene.black) value *= 6.0f;
    const MeasuredVenue venue = venueOf(scene);
    Progress quiet;
    const WindowInverse inverse = computeWindows(venue.transport, venue.usable, {}, quiet);
    Image content = makeContent(Content::natural, {60, 45}, 5);
    for (float& value : content.data()) value *= 0.05f;
    std::array<double, 3> error{};
    for (Brightness way : allValues<Brightness>()) {
      TargetSettings settings;
      settings.brightness = way;
      const Target target = fitTarget(content, venue, settings);
      const Compensation done = Compensator(venue, inverse).solve(Method::refined, target, quiet);
      error[static_cast<std::size_t>(way)] = predict(venue, target, done).meanDeltaE;
    }
    QVERIFY2(error[1] < 0.9 * error[0] && error[2] < 0.9 * error[0],
             qPrintable(QString("%1 %2 %3").arg(error[0]).arg(error[1]).arg(error[2])));
  }
};

QTEST_APPLESS_MAIN(TestBrightness)
#include "test_brightness.moc"
