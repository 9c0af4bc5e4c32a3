// SPDX-License-Identifier: MIT
#include "relucent/engine/followed_brightness.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/engine/engine_backends.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::synthetic;

namespace {

using Seconds = std::chrono::duration<double>;

Image greyOf(float value) {
  return Image({40, 30}, 3, value);
}

float meanOf(const BrightnessField& field) {
  float sum = 0.0f;
  for (float octaves : field.octaves) sum += octaves / static_cast<float>(field.octaves.size());
  return sum;
}

}  // namespace

class TestFollowedBrightness : public QObject {
  Q_OBJECT

  EngineScene scene_ = engineSceneOf("wall");

 private slots:
  void init() {
    // The room is lit to a twenty-fifth of white.
    const EngineVenue engine = prepareVenue(scene_.venue, scene_.inverse, scene_.responses, {});
    const float black = 0.04f * prepareContent(engine, {40, 30}).white;
    for (float& value : scene_.venue.black) value = black;
  }

  /// The first frame gets at once what fitTarget() gives it.
  void beginsWhereAStillIs() {
    const EngineVenue engine = prepareVenue(scene_.venue, scene_.inverse, scene_.responses, {});
    const EngineContent content = prepareContent(engine, {40, 30});
    const Image dark = greyOf(0.004f);
    FollowedBrightness followed(engine, content, Brightness::region);
    const BrightnessField field = followed.follow(frameOf(dark), Seconds(0.0));
    QVERIFY(followed.settled());
    TargetSettings settings;
    settings.brightness = Brightness::region;
    const Target target = fitTarget(dark, scene_.venue, settings);
    QVERIFY2(meanOf(field) > 0.2f, qPrintable(QString::number(meanOf(field))));
    for (std::size_t i = 0; i < target.gain.size(); ++i)
      if (target.inside[i] != 0)
        QVERIFY(std::abs(field.gain(content.place[i][0], content.place[i][1]) / target.gain[i] - 1.0f) <
                1e-3f);
  }

  void goesSlowly_data() {
    QTest::addColumn<int>("framesPerSecond");
    for (int rate : {24, 60}) QTest::addRow("%d", rate) << rate;
  }
  /// What changes by little, of one class of brightness, goes there in a second or so, at any rate of frames,
  /// and never beyond.
  void goesSlowly() {
    QFETCH(int, framesPerSecond);
    const EngineVenue engine = prepareVenue(scene_.venue, scene_.inverse, scene_.responses, {});
    const EngineContent content = prepareContent(engine, {40, 30});
    const Image before = greyOf(0.0215f), after = greyOf(0.031f);
    FollowedBrightness still(engine, content, Brightness::region);
    const float from = meanOf(still.follow(frameOf(before), Seconds(0.0)));
    const float to =
        meanOf(FollowedBrightness(engine, content, Brightness::region).follow(frameOf(after), Seconds(0.0)));
    QVERIFY(std::abs(to - from) > 0.02f);
    float last = from;
    int frames = 0;
    while (frames == 0 || !still.settled()) {
      const float here = meanOf(still.follow(frameOf(after), Seconds(1.0 / framesPerSecond)));
      QVERIFY((here - last) * (to - from) >= 0.0f && (to - here) * (to - from) >= -1e-6f);
      // At most what an exponential of a second goes in a frame.
      QVERIFY(std::abs(here - last) <= std::abs(to - from) * 1.05f / static_cast<float>(framesPerSecond) ||
              still.settled());
      last = here;
      QVERIFY(++frames < 20 * framesPerSecond);
    }
    QCOMPARE(last, to);
    QVERIFY(frames > framesPerSecond);
  }

  /// A new scene is not faded into.
  void jumpsWithTheScene() {
    const EngineVenue engine = prepareVenue(scene_.venue, scene_.inverse, scene_.responses, {});
    const EngineContent content = prepareContent(engine, {40, 30});
    FollowedBrightness followed(engine, content, Brightness::region);
    const Image bright = greyOf(0.6f), dark = greyOf(0.004f);
    const float first = meanOf(followed.follow(frameOf(bright), Seconds(0.0)));
    const float second = meanOf(followed.follow(frameOf(dark), Seconds(1.0 / 60.0)));
    QVERIFY(followed.settled());
    QVERIFY(second > first + 0.2f);
  }
};

QTEST_APPLESS_MAIN(TestFollowedBrightness)
#include "test_followed_brightness.moc"
