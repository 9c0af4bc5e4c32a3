// SPDX-License-Identifier: MIT
#include "relucent/engine/adaptive_range.h"

#include <QtTest>
#include <cmath>
#include <limits>

#include "core/engine/engine_scenes.h"
#include "relucent/base/random.h"
#include "relucent/image/colour.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::linearization;
using namespace relucent::transport;
using namespace std::chrono_literals;
using namespace relucent::synthetic;

namespace {

using Colours = std::vector<std::array<float, 3>>;
constexpr float noNumber = std::numeric_limits<float>::quiet_NaN();

std::vector<Reach> someReach(std::size_t count, std::uint64_t seed) {
  std::vector<Reach> reach(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random{seed, i};
    for (std::size_t c = 0; c < 3; ++c) {
      reach[i].least[c] = 0.05f * random.uniformFloat();
      reach[i].most[c] = 0.5f + random.uniformFloat();
    }
  }
  return reach;
}

Colours someColours(std::size_t count, std::uint64_t seed, float brightness) {
  Colours colours(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random{seed, i};
    for (float& value : colours[i]) value = brightness * random.uniformFloat();
  }
  return colours;
}

/// A venue, and content of one colour in it.
struct Stage {
  EngineScene scene = engineSceneOf("wall");
  EngineVenue engine = prepareVenue(scene.venue, scene.inverse, scene.responses, {});
  EngineContent content = prepareContent(engine, {40, 30});

  static Image grey(float light) { return Image({40, 30}, 3, light); }
  static ContentFrame frame(const Image& image) {
    return {image.data().data(), image.size(), 12 * static_cast<std::size_t>(image.width()),
            ContentFrame::Format::linearFloat};
  }
  DisplayRange demand(float light) const {
    return AdaptiveRange(engine, content).follow(frame(grey(light)), 0s);
  }
};

}  // namespace

class TestAdaptiveRange : public QObject {
  Q_OBJECT

 private slots:
  void theDefaultsAreRight() { QVERIFY(problems(AdaptiveRangeSettings{}).empty()); }
  void wrongSettingsAreNamed() {
    for (auto wrong :
         {AdaptiveRangeSettings{.outOfReach = -1.0}, AdaptiveRangeSettings{.dimmest = 0.0},
          AdaptiveRangeSettings{.brightest = 0.9}, AdaptiveRangeSettings{.mostLift = 1.0},
          AdaptiveRangeSettings{.timeConstant = 0.0}, AdaptiveRangeSettings{.cut = std::nan("")}})
      QCOMPARE(problems(wrong).size(), std::size_t{1});
  }

  /// Brighter content is never made brighter, darker content never lifted less.
  void isMonotone() {
    AdaptiveRangeSettings settings{.dimmest = 0.01, .brightest = 50.0, .mostLift = 0.9};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      std::vector<Reach> reach = someReach(500, seed);
      DisplayRange last{1e9f, 1.0f};
      for (float brightness : {0.0f, 0.01f, 0.1f, 0.3f, 0.7f, 1.0f}) {
        DisplayRange range = demandedRange(reach, someColours(500, 100 + seed, brightness), settings);
        QVERIFY(range.brightness <= last.brightness && range.blackLift <= last.blackLift);
        last = range;
      }
      QVERIFY(last.brightness < 5.0f);  // the law holds not because nothing happens
    }
  }

  /// Not more than the share that the settings allow is out of reach, and with a little more range more is.
  void leavesTheAllowedShareOutOfReach() {
    AdaptiveRangeSettings settings{.outOfReach = 5.0, .dimmest = 0.01, .brightest = 50.0};
    std::vector<Reach> reach = someReach(2000, 7);
    Colours colours = someColours(2000, 8, 1.0f);
    float brightness = demandedRange(reach, colours, settings).brightness;
    auto above = [&](float factor) {
      int count = 0;
      for (std::size_t i = 0; i < reach.size(); ++i) {
        bool over = false;
        for (std::size_t c = 0; c < 3; ++c)
          over = over || factor * brightness * colours[i][c] > reach[i].most[c];
        count += over;
      }
      return count;
    };
    QVERIFY(above(0.9999f) <= 100 && above(1.02f) > 100);
  }

  void liftReachesTheDarkestThatCanBeShown() {
    AdaptiveRangeSettings settings{.outOfReach = 0.0};
    std::vector<Reach> reach{{{0.05f, 0.02f, 0.0f}, {1.0f, 1.0f, 1.0f}}};
    QCOMPARE(demandedRange(reach, {{0.0f, 0.0f, 0.0f}}, settings).blackLift, 0.05f);
    QCOMPARE(demandedRange(reach, {{0.5f, 0.5f, 0.5f}}, settings).blackLift, 0.0f);
    reach[0].least[0] = 0.5f;
    QCOMPARE(demandedRange(reach, {{0.0f, 0.0f, 0.0f}}, settings).blackLift, 0.1f);
  }

  void nothingAndNoNumbersAreHarmless() {
    AdaptiveRangeSettings settings;
    QCOMPARE(demandedRange({}, {}, settings), DisplayRange{});
    std::vector<Reach> reach{{{noNumber, 0.0f, 0.0f}, {0.0f, noNumber, 1.0f}},
                             {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}};
    for (const Colours& colours : {Colours{{noNumber, noNumber, noNumber}, {-1.0f, 0.0f, noNumber}},
                                   Colours{{1.0f, 1.0f, 1.0f}, {1e30f, 1.0f, 0.0f}}}) {
      DisplayRange range = demandedRange(reach, colours, settings);
      QVERIFY(range.brightness >= 0.5f && range.brightness <= 1.5f);
      QVERIFY(range.blackLift >= 0.0f && range.blackLift <= 0.1f);
    }
  }

  void stillContentIsStill() {
    static const Stage stage;
    AdaptiveRange range(stage.engine, stage.content);
    Image picture = Stage::grey(0.9f);
    DisplayRange first = range.follow(Stage::frame(picture), 0s);
    for (int frame = 0; frame < 200; ++frame) {
      QVERIFY(range.settled());
      QVERIFY(range.follow(Stage::frame(picture), 17ms) == first);
    }
  }

  void glidesWithItsTimeConstant_data() {
    QTest::addColumn<double>("timeConstant");
    QTest::addColumn<int>("rate");
    for (double timeConstant : {0.5, 1.0, 3.0})
      for (int rate : {10, 60, 144})
        QTest::addRow("%g s at %d Hz", timeConstant, rate) << timeConstant << rate;
  }
  /// A scene that grows brighter without a cut: after one time constant 1/e of the way is left, whatever the
  /// frame rate, and it arrives.
  void glidesWithItsTimeConstant() {
    QFETCH(double, timeConstant);
    QFETCH(int, rate);
    static const Stage stage;
    AdaptiveRange range(stage.engine, stage.content, {.timeConstant = timeConstant, .cut = 2.0});
    DisplayRange from = range.follow(Stage::frame(Stage::grey(0.3f)), 0s), to = stage.demand(1.0f);
    QVERIFY(to.brightness < 0.9f * from.brightness);
    Image bright = Stage::grey(1.0f);
    double whole = std::log(from.brightness / to.brightness);
    float last = from.brightness;
    std::chrono::duration<double> step(1.0 / rate);
    int frames = static_cast<int>(std::lround(timeConstant * rate));
    for (int frame = 1; frame <= frames; ++frame) {
      float now = range.follow(Stage::frame(bright), step).brightness;
      QVERIFY(now < last);
      last = now;
    }
    double left = std::log(last / to.brightness) / whole;
    QVERIFY2(std::abs(left - std::exp(-1.0)) < 0.01, qPrintable(QString::number(left)));
    QVERIFY(!range.settled());
    for (int frame = 0; frame < 8 * frames; ++frame)
      last = range.follow(Stage::frame(bright), step).brightness;
    QVERIFY(range.settled());
    QCOMPARE(last, to.brightness);
  }

  void beginsAnewAtACut() {
    static const Stage stage;
    AdaptiveRange range(stage.engine, stage.content);
    range.follow(Stage::frame(Stage::grey(0.1f)), 0s);
    QVERIFY(range.follow(Stage::frame(Stage::grey(1.0f)), 17ms) == stage.demand(1.0f));
    QVERIFY(range.settled());
  }

  /// A cross-fade of two seconds is no cut: brightness never jumps by more than 63 % a time constant asks
  /// for.
  void aFadeIsNoCut() {
    static const Stage stage;
    AdaptiveRange range(stage.engine, stage.content);
    Image picture({40, 30}, 3);
    auto noise = [&](float most) {
      for (std::size_t i = 0; i < picture.data().size(); ++i)
        picture.data()[i] = most * static_cast<float>(i % 97) / 96.0f;
      return Stage::frame(picture);
    };
    float last = range.follow(noise(0.2f), 0s).brightness;
    double most = 0.0;
    for (int frame = 1; frame <= 120; ++frame) {
      float now = range.follow(noise(0.2f + 0.8f * static_cast<float>(frame) / 120.0f), 17ms).brightness;
      most = std::max(most, std::abs(std::log(static_cast<double>(now / last))));
      last = now;
    }
    QVERIFY(most > 0.0 && most < std::log(1.5 / 0.5) * 0.017);
  }

  void formatsAgree() {
    static const Stage stage;
    std::vector<std::uint8_t> rgba, bgra, rgb;
    Image linear({40, 30}, 3);
    for (std::size_t i = 0; i < linear.pixels(); ++i) {
      std::array<std::uint8_t, 3> code{static_cast<std::uint8_t>(i % 256),
                                       static_cast<std::uint8_t>(i * 7 % 256),
                                       static_cast<std::uint8_t>(i * 31 % 256)};
      rgb.insert(rgb.end(), code.begin(), code.end());
      rgba.insert(rgba.end(), {code[0], code[1], code[2], 255});
      bgra.insert(bgra.end(), {code[2], code[1], code[0], 255});
      for (std::size_t c = 0; c < 3; ++c)
        linear.data()[3 * i + c] = static_cast<float>(srgbDecode(code[c] / 255.0));
    }
    auto demand = [&](const void* data, std::size_t bytes, ContentFrame::Format format) {
      return AdaptiveRange(stage.engine, stage.content).follow({data, {40, 30}, 40 * bytes, format}, 0s);
    };
    DisplayRange expected = AdaptiveRange(stage.engine, stage.content).follow(Stage::frame(linear), 0s);
    QVERIFY(demand(rgb.data(), 3, ContentFrame::Format::rgb8) == expected);
    QVERIFY(demand(rgba.data(), 4, ContentFrame::Format::rgba8) == expected);
    QVERIFY(demand(bgra.data(), 4, ContentFrame::Format::bgra8) == expected);
  }
};

QTEST_GUILESS_MAIN(TestAdaptiveRange)
#include "test_adaptive_range.moc"
