// SPDX-License-Identifier: MIT
#include "relucent/image/colour_map.h"

#include <QtTest>

#include "relucent/image/colour.h"

using namespace relucent::image;

class TestColourMap : public QObject {
  Q_OBJECT

 private slots:
  /// Law of both maps: brighter with every step, so that they can be read without colours. One code of
  /// rounding in each channel may hide a step.
  void mapsRiseInBrightness_data() {
    QTest::addColumn<int>("map");
    QTest::newRow("cividis") << static_cast<int>(ColourMap::cividis);
    QTest::newRow("viridis") << static_cast<int>(ColourMap::viridis);
  }
  void mapsRiseInBrightness() {
    QFETCH(int, map);
    auto brightness = [&](int step) {
      const Rgb8 colour = colourAt(static_cast<ColourMap>(map), step / 100.0);
      auto linear = [](std::uint8_t code) { return static_cast<float>(srgbDecode(code / 255.0)); };
      return luminanceOf(linear(colour[0]), linear(colour[1]), linear(colour[2]));
    };
    for (int step = 1; step <= 100; ++step)
      QVERIFY2(brightness(step) > brightness(step - 1), QByteArray::number(step));
  }

  void endsHoldBeyondTheEnds() {
    QCOMPARE(colourAt(ColourMap::viridis, -3.0), coloursOf(ColourMap::viridis).front());
    QCOMPARE(colourAt(ColourMap::viridis, 1e9), coloursOf(ColourMap::viridis).back());
    QVERIFY(coloursOf(ColourMap::viridis) != coloursOf(ColourMap::cividis));
  }
};

QTEST_APPLESS_MAIN(TestColourMap)
#include "test_colour_map.moc"
