// SPDX-License-Identifier: MIT
#include "relucent/image/video_colour.h"

#include <QtTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "relucent/image/colour.h"

using namespace relucent;
using namespace relucent::image;
using Matrix = VideoEncoding::Matrix;
using Range = VideoEncoding::Range;
using Transfer = VideoEncoding::Transfer;

namespace {

/// One colour as a sender encodes it, the standards' equations forward: R'G'B' to Y, Cb, Cr of `bits`.
std::array<std::uint16_t, 3> encoded(const Colour& rgb, const VideoEncoding& encoding, int bits) {
  bool bt709 = encoding.matrix == Matrix::bt709, full = encoding.range == Range::full;
  double red = bt709 ? 0.2126 : 0.299, blue = bt709 ? 0.0722 : 0.114;
  double y = red * rgb[0] + (1.0 - red - blue) * rgb[1] + blue * rgb[2];
  double b = (rgb[2] - y) / (2.0 * (1.0 - blue)), r = (rgb[0] - y) / (2.0 * (1.0 - red));
  double unit = 1 << (bits - 8), largest = 256.0 * unit - 1.0;
  // Full red at full range is half a code more than there are.
  auto code = [&](double value) { return static_cast<std::uint16_t>(std::lround(std::min(value, largest))); };
  if (full) return {code(largest * y), code(128 * unit + largest * b), code(128 * unit + largest * r)};
  return {code(unit * (16 + 219 * y)), code(unit * (128 + 224 * b)), code(unit * (128 + 224 * r))};
}

template <typename Sample>
std::array<int, 3> decoded(std::array<std::uint16_t, 3> code, const VideoEncoding& encoding, int bits) {
  std::array<Sample, 3> sample;
  for (std::size_t c = 0; c < 3; ++c) sample[c] = static_cast<Sample>(code[c]);
  std::array<std::uint8_t, 4> rgbx{};
  srgbFromVideo({{&sample[0], 2, 1}, {&sample[1], 2, 1}, {&sample[2], 2, 1}, bits, 1, 1}, {1, 1}, encoding,
                rgbx.data(), 4);
  return {rgbx[0], rgbx[1], rgbx[2]};
}

}  // namespace

class TestVideoColour : public QObject {
  Q_OBJECT

 private slots:
  void whatWasSentIsWhatIsShown_data() {
    QTest::addColumn<int>("matrix");
    QTest::addColumn<int>("range");
    QTest::addColumn<int>("bits");
    for (int matrix : {0, 1})
      for (int range : {0, 1})
        for (int bits : {8, 10, 16})
          QTest::addRow("%s %s %d bits", matrix ? "709" : "601", range ? "full" : "video", bits)
              << matrix << range << bits;
  }
  /// Through the sender's equations and back. Rounding Y, Cb and Cr to 8 bits moves R, G and B by at most
  /// (0.5 + 0.5 * 2 * (1 - k_b) * 219 / 224) * 255 / 219 = 1.6 codes before they are rounded themselves.
  void whatWasSentIsWhatIsShown() {
    QFETCH(int, matrix);
    QFETCH(int, range);
    QFETCH(int, bits);
    VideoEncoding encoding{Matrix(matrix), Range(range), Transfer::srgb};
    int tolerance = bits == 8 ? 2 : 1;
    for (int r = 0; r <= 255; r += 51)
      for (int g = 0; g <= 255; g += 51)
        for (int b = 0; b <= 255; b += 51) {
          auto sent = encoded({r / 255.0, g / 255.0, b / 255.0}, encoding, bits);
          auto shown = bits == 8 ? decoded<std::uint8_t>(sent, encoding, bits)
                                 : decoded<std::uint16_t>(sent, encoding, bits);
          QVERIFY(std::abs(shown[0] - r) <= tolerance && std::abs(shown[1] - g) <= tolerance &&
                  std::abs(shown[2] - b) <= tolerance);
        }
  }

  void greyIsTheTransfersLight_data() {
    QTest::addColumn<int>("transfer");
    QTest::addColumn<double>("gamma");
    QTest::newRow("BT.1886") << static_cast<int>(Transfer::bt1886) << 2.4;
    QTest::newRow("2.2") << static_cast<int>(Transfer::gamma22) << 2.2;
    QTest::newRow("2.8") << static_cast<int>(Transfer::gamma28) << 2.8;
    QTest::newRow("linear") << static_cast<int>(Transfer::linear) << 1.0;
  }
  void greyIsTheTransfersLight() {
    QFETCH(int, transfer);
    QFETCH(double, gamma);
    for (int code = 16; code <= 235; ++code) {
      auto shown = decoded<std::uint8_t>({static_cast<std::uint16_t>(code), 128, 128},
                                         {Matrix::bt709, Range::video, Transfer(transfer)}, 8);
      double expected = 255.0 * srgbEncode(std::pow((code - 16) / 219.0, gamma));
      for (int channel : shown) QVERIFY(std::abs(channel - expected) <= 0.5 + 16.0 / 255.0);
    }
  }

  /// Blacker than black and whiter than white, as films hold them, are black and white.
  void whatLiesOutsideIsCutOff() {
    VideoEncoding video;
    for (std::uint16_t code : {0, 15, 16}) QVERIFY(decoded<std::uint8_t>({code, 128, 128}, video, 8)[1] == 0);
    for (std::uint16_t code : {235, 236, 255})
      QVERIFY(decoded<std::uint8_t>({code, 128, 128}, video, 8)[1] == 255);
    QCOMPARE(decoded<std::uint8_t>({126, 128, 0}, video, 8)[0], 0);
    QCOMPARE(decoded<std::uint8_t>({0, 0, 255}, {video.matrix, Range::full, Transfer::srgb}, 8)[1], 0);
  }

  /// Every pixel takes the chroma of its place, at odd sizes too; packed and planar alike.
  void chromaBelongsToItsPlace() {
    for (Size size : {Size{5, 3}, Size{1, 1}, Size{4, 4}, Size{7, 1}}) {
      int wide = (size.width + 1) / 2, high = (size.height + 1) / 2;
      std::vector<std::uint8_t> luma(size.count(), 128), chroma(static_cast<std::size_t>(2 * wide * high));
      for (std::size_t i = 0; i < chroma.size() / 2; ++i) {
        chroma[2 * i] = static_cast<std::uint8_t>(108 + 5 * i);
        chroma[2 * i + 1] = static_cast<std::uint8_t>(148 - 5 * i);
      }
      auto lines = static_cast<std::size_t>(2 * wide);
      std::vector<std::uint8_t> rgbx(4 * size.count());
      VideoEncoding encoding{Matrix::bt601, Range::full, Transfer::srgb};
      srgbFromVideo({{luma.data(), static_cast<std::size_t>(size.width), 1},
                     {chroma.data(), lines, 2},
                     {chroma.data() + 1, lines, 2},
                     8,
                     2,
                     2},
                    size, encoding, rgbx.data(), 4 * static_cast<std::size_t>(size.width));
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          int i = (y / 2) * wide + x / 2;
          double red = 128 + 1.402 * (20 - 5 * i), blue = 128 + 1.772 * (5 * i - 20);
          const std::uint8_t* pixel = &rgbx[4 * indexOf(size, {x, y})];
          QVERIFY(std::abs(pixel[0] - red) <= 1.0 && std::abs(pixel[2] - blue) <= 1.0);
          QCOMPARE(pixel[3], std::uint8_t{255});
        }
    }
  }

  void withoutChromaItIsGrey() {
    std::uint8_t luma = 126;
    std::array<std::uint8_t, 4> rgbx{};
    srgbFromVideo({{&luma, 1, 1}, {}, {}}, {1, 1}, {}, rgbx.data(), 4);
    QVERIFY(rgbx[0] == rgbx[1] && rgbx[1] == rgbx[2] && rgbx[0] > 0);
  }

  void anEmptyFrameIsNothing() { srgbFromVideo({}, {0, 0}, {}, nullptr, 0); }
};

QTEST_GUILESS_MAIN(TestVideoColour)
#include "test_video_colour.moc"
