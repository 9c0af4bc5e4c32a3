// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/devices/sensor_frame.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;

namespace {

SensorFrame randomFrame(Size size, SensorFormat format, std::uint64_t seed, unsigned most = 0) {
  Random random{seed};
  const bool colours = format.layout == SensorLayout::rgb || format.layout == SensorLayout::bgr;
  SensorFrame frame{size, format, {}};
  for (std::size_t i = 0; i < size.count() * (colours ? 3 : 1); ++i) {
    const auto code = static_cast<unsigned>(random.below(most > 0 ? most : 1u << format.bits));
    frame.bytes.push_back(static_cast<std::uint8_t>(code & 0xffu));
    if (format.bits > 8) frame.bytes.push_back(static_cast<std::uint8_t>(code >> 8));
  }
  return frame;
}

unsigned codeAt(const SensorFrame& frame, std::size_t index) {
  if (frame.format.bits <= 8) return frame.bytes[index];
  return frame.bytes[2 * index] + 256u * frame.bytes[2 * index + 1];
}

}  // namespace

class TestSensorFrame : public QObject {
  Q_OBJECT

 private slots:
  void namesComeAndGo_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("read");
    for (const char* name : {"Mono8", "Mono10", "Mono12", "Mono14", "Mono16", "BayerRG8", "BayerGR10",
                             "BayerGB12", "BayerBG16", "RGB8", "BGR8"})
      QTest::newRow(name) << QString(name) << true;
    for (const char* name : {"", "Mono", "Mono12Packed", "Mono12p", "Mono7", "Mono17", "Mono32", "BayerRG12p",
                             "YUV422_8", "Bayer8", "8"})
      QTest::newRow((std::string("not ") + name).c_str()) << QString(name) << false;
  }
  void namesComeAndGo() {
    QFETCH(QString, name);
    QFETCH(bool, read);
    const auto format = sensorFormatFromName(name.toStdString());
    QCOMPARE(format.has_value(), read);
    if (read) QCOMPARE(nameOf(*format), name.toStdString());
  }

  void theFormatThatLosesLeastIsChosen() {
    auto best = [](const std::vector<std::string>& names) {
      const auto format = bestFormat(names);
      return format ? nameOf(*format) : std::string("none");
    };
    QCOMPARE(best({"Mono8", "BayerRG8", "Mono16", "RGB8"}), std::string("BayerRG8"));
    QCOMPARE(best({"BayerGB8", "BayerGB12", "BayerGB10"}), std::string("BayerGB12"));
    QCOMPARE(best({"Mono16", "RGB8", "YUV422_8"}), std::string("RGB8"));
    QCOMPARE(best({"Mono12p", "Mono10", "Mono8"}), std::string("Mono10"));
    QCOMPARE(best({"YUV411_8"}), std::string("none"));
    QCOMPARE(best({}), std::string("none"));
  }

  void everyLayoutPutsTheColoursWhereTheyBelong_data() {
    QTest::addColumn<SensorLayout>("layout");
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("red");  // place in the 2x2 cell
    int row = 0;
    for (int bits : {8, 10, 12, 16})
      for (auto [layout, red] : {std::pair(SensorLayout::bayerRG, 0), std::pair(SensorLayout::bayerGR, 1),
                                 std::pair(SensorLayout::bayerGB, 2), std::pair(SensorLayout::bayerBG, 3)})
        QTest::addRow("%d", row++) << layout << bits << red;
  }
  void everyLayoutPutsTheColoursWhereTheyBelong() {
    QFETCH(SensorLayout, layout);
    QFETCH(int, bits);
    QFETCH(int, red);
    const SensorFrame frame = randomFrame({10, 6}, {layout, bits}, 3);
    const Image image = photographOf(frame, "camera");
    QCOMPARE(image.size(), (Size{5, 3}));
    const double full = std::ldexp(1.0, bits + 1) - 1.0;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x) {
        auto cell = [&](int place) {
          return codeAt(frame, static_cast<std::size_t>((2 * y + place / 2) * 10 + 2 * x + place % 2));
        };
        QCOMPARE(image.at(x, y, 0), static_cast<float>(2.0 * cell(red) / full));
        QCOMPARE(image.at(x, y, 1), static_cast<float>((cell(red ^ 1) + cell(red ^ 2)) / full));
        QCOMPARE(image.at(x, y, 2), static_cast<float>(2.0 * cell(red ^ 3) / full));
        // What the log of shots relies on: whole codes.
        for (int c = 0; c < 3; ++c) {
          const double code = static_cast<double>(image.at(x, y, c)) * full;
          QVERIFY(std::abs(code - std::round(code)) < 0.02);  // float has 24 bits, the codes 17
        }
      }
  }

  void lightThatAddsUpOnTheSensorAddsUpInThePhotograph_data() {
    QTest::addColumn<SensorLayout>("layout");
    QTest::newRow("Bayer") << SensorLayout::bayerGB;
    QTest::newRow("grey") << SensorLayout::mono;
    QTest::newRow("RGB") << SensorLayout::rgb;
  }
  void lightThatAddsUpOnTheSensorAddsUpInThePhotograph() {
    QFETCH(SensorLayout, layout);
    // Halves of the range, so that nothing saturates; an edge-aware interpolation fails this.
    SensorFrame one = randomFrame({16, 8}, {layout, 12}, 1, 2048),
                two = randomFrame({16, 8}, {layout, 12}, 2, 2048);
    SensorFrame both = one;
    for (std::size_t i = 0; i < both.bytes.size() / 2; ++i) {
      const unsigned sum = codeAt(one, i) + codeAt(two, i);
      both.bytes[2 * i] = static_cast<std::uint8_t>(sum & 0xffu);
      both.bytes[2 * i + 1] = static_cast<std::uint8_t>(sum >> 8);
    }
    const Image a = photographOf(one, "camera"), b = photographOf(two, "camera"),
                ab = photographOf(both, "camera");
    for (std::size_t i = 0; i < ab.data().size(); ++i)
      QVERIFY(std::abs(a.data()[i] + b.data()[i] - ab.data()[i]) <
              2e-7f);  // three roundings to float below 1
  }

  void greyAndColoursPixelByPixel() {
    const SensorFrame grey = randomFrame({5, 3}, {SensorLayout::mono, 10}, 4);
    const Image image = photographOf(grey, "camera");
    QCOMPARE(image.size(), (Size{5, 3}));
    for (std::size_t i = 0; i < 15; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        QCOMPARE(image.pixel(i)[c], static_cast<float>(codeAt(grey, i) / 1023.0));
    const SensorFrame bgr = randomFrame({3, 1}, {SensorLayout::bgr, 8}, 5);
    const Image colours = photographOf(bgr, "camera");
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        QCOMPARE(colours.pixel(i)[c], static_cast<float>(bgr.bytes[3 * i + 2 - c] / 255.0));
  }

  void fullScaleIsOneUpToHalfACode() {
    SensorFrame frame = randomFrame({2, 2}, {SensorLayout::bayerRG, 8}, 1);
    std::fill(frame.bytes.begin(), frame.bytes.end(), std::uint8_t{255});
    const Image image = photographOf(frame, "camera");
    for (float value : image.data()) QCOMPARE(value, static_cast<float>(510.0 / 511.0));
  }

  void oddSidesLoseTheirLastLine() {
    const SensorFrame frame = randomFrame({7, 5}, {SensorLayout::bayerRG, 8}, 6);
    QCOMPARE(photographOf(frame, "camera").size(), (Size{3, 2}));
    QCOMPARE(photographOf(randomFrame({1, 1}, {SensorLayout::mono, 8}, 7), "camera").size(), (Size{1, 1}));
  }

  /// With levels every place of a cell has its own black, and what lies below it is negative.
  void levelsAreTakenFromEveryPlace_data() {
    QTest::addColumn<int>("layout");
    QTest::addColumn<int>("bits");
    for (SensorLayout layout : {SensorLayout::mono, SensorLayout::bayerRG, SensorLayout::bayerGR,
                                SensorLayout::bayerGB, SensorLayout::bayerBG})
      for (int bits : {8, 14})
        QTest::addRow("%s", nameOf({layout, bits}).c_str()) << static_cast<int>(layout) << bits;
  }
  void levelsAreTakenFromEveryPlace() {
    QFETCH(int, layout);
    QFETCH(int, bits);
    const SensorFormat format{static_cast<SensorLayout>(layout), bits};
    SensorFrame frame = randomFrame({6, 4}, format, 9);
    QCOMPARE(photographBits(frame), photographBits(format));
    frame.levels = SensorLevels{{10, 20, 30, 40}, 200};
    QCOMPARE(photographBits(frame), 0);
    const Image image = photographOf(frame, "camera");
    // The same cells with black taken off by hand, one place after the other.
    auto signal = [&](int x, int y) {
      const float black = frame.levels->black[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
      const auto index = static_cast<std::size_t>(y * frame.size.width + x);
      return (static_cast<float>(codeAt(frame, index)) - black) / (200.0f - black);
    };
    if (format.layout == SensorLayout::mono) {
      QCOMPARE(image.at(3, 1, 2), signal(3, 1));
      return;
    }
    const int red = format.layout == SensorLayout::bayerRG   ? 0
                    : format.layout == SensorLayout::bayerGR ? 1
                    : format.layout == SensorLayout::bayerGB ? 2
                                                             : 3;
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) {
        auto place = [&](int p) { return signal(2 * x + p % 2, 2 * y + p / 2); };
        QVERIFY(std::abs(image.at(x, y, 0) - place(red)) < 1e-5f * std::abs(place(red)) + 1e-6f);
        const float green = 0.5f * (place(red ^ 1) + place(red ^ 2));
        QVERIFY(std::abs(image.at(x, y, 1) - green) < 1e-5f * std::abs(green) + 1e-6f);
        QVERIFY(std::abs(image.at(x, y, 2) - place(red ^ 3)) < 1e-5f * std::abs(place(red ^ 3)) + 1e-6f);
      }
  }

  void impossibleLevelsAreRefused() {
    SensorFrame frame = randomFrame({2, 2}, {SensorLayout::bayerRG, 8}, 10);
    frame.levels = SensorLevels{{0, 0, 9, 0}, 9};
    QVERIFY_EXCEPTION_THROWN(photographOf(frame, "camera"), std::logic_error);
    SensorFrame colours = randomFrame({2, 2}, {SensorLayout::rgb, 8}, 11);
    colours.levels = SensorLevels{{0, 0, 0, 0}, 9};
    QVERIFY_EXCEPTION_THROWN(photographOf(colours, "camera"), std::logic_error);
  }

  void tooFewBytesAreTold() {
    SensorFrame frame = randomFrame({4, 4}, {SensorLayout::mono, 12}, 8);
    frame.bytes.pop_back();
    const std::string sentence = sentenceOf([&] { photographOf(frame, "left camera"); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "left camera: a photograph of 4x4 pixels as Mono12 came with 31 of 32 bytes"));
  }
};

QTEST_GUILESS_MAIN(TestSensorFrame)
#include "test_sensor_frame.moc"
