// SPDX-License-Identifier: MIT
#include "relucent/engine/drive_encoder.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/random.h"
#include "relucent/engine/blue_noise.h"

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::hdr;
using namespace relucent::linearization;

namespace {

ProjectorResponse responseOf(const QString& name) {
  ProjectorResponse response;
  if (name == "linear") return response;
  std::vector<double> x, y;
  for (int k = 0; k <= 32; ++k) {
    x.push_back(k / 32.0);
    double drive = x.back();
    y.push_back(name == "gamma" ? std::pow(drive, 2.2)
                                : drive * drive * (3.0 - 2.0 * drive) * 0.98 + 0.02 * drive);
  }
  response.channels.fill(ResponseCurve(x, y));
  return response;
}

unsigned channelOf(std::uint32_t word, int bits, std::size_t c) {
  return word >> (static_cast<unsigned>(bits) * static_cast<unsigned>(c)) & ((1u << bits) - 1u);
}

/// The word of one pixel, in the middle of a line like it.
std::uint32_t encoded(const DriveEncoder& encoder, const float* colour, int x, int y) {
  std::vector<float> line;
  for (int i = 0; i <= x; ++i) line.insert(line.end(), colour, colour + 3);
  std::vector<std::uint32_t> words(static_cast<std::size_t>(x) + 1);
  encoder.encodeLine(line.data(), x + 1, y, words.data());
  return words.back();
}

}  // namespace

class TestDriveEncoder : public QObject {
  Q_OBJECT

  static void everyResponseAndDepth() {
    QTest::addColumn<QString>("response");
    QTest::addColumn<int>("bits");
    for (const char* response : {"linear", "gamma", "s-shaped"})
      for (int bits : {8, 10}) QTest::addRow("%s, %d bits", response, bits) << response << bits;
  }

 private slots:
  void roundsToTheNearestLevel_data() { everyResponseAndDepth(); }
  void roundsToTheNearestLevel() {
    QFETCH(QString, response);
    QFETCH(int, bits);
    ProjectorResponse projector = responseOf(response);
    DriveEncoder encoder(projector, bits, Dither::none);
    double last = std::pow(2.0, bits) - 1.0;
    Random random{3};
    for (int i = 0; i < 4000; ++i) {
      auto light = i < 2 ? static_cast<float>(i) : static_cast<float>(std::pow(random.uniform(), 3.0));
      float colour[3] = {light, light, light};
      std::uint32_t word = encoded(encoder, colour, i % 70, 2 * i);
      double drive = last * projector.channels[0].inverse(static_cast<double>(light));
      // Half a level, and a light that is a single float.
      for (std::size_t c = 0; c < 3; ++c) QVERIFY(std::abs(channelOf(word, bits, c) - drive) <= 0.5 + 1e-3);
      QCOMPARE(word >> 30, bits == 8 ? 3u : 3u);
    }
  }

  void ditherKeepsTheMeanLight_data() { everyResponseAndDepth(); }
  /// Over one period of the thresholds the mean light is the wanted light, to one threshold's share of a
  /// level.
  void ditherKeepsTheMeanLight() {
    QFETCH(QString, response);
    QFETCH(int, bits);
    ProjectorResponse projector = responseOf(response);
    double last = std::pow(2.0, bits) - 1.0;
    for (Dither dither : {Dither::ordered, Dither::blueNoise}) {
      DriveEncoder encoder(projector, bits, dither);
      for (float light : {0.0f, 1e-5f, 0.003f, 0.1f, 0.37f, 0.999f, 1.0f}) {
        double sum = 0.0, widest = 0.0;
        float colour[3] = {light, light, light};
        for (int y = 0; y < DriveEncoder::side; ++y) {
          for (int x = 0; x < DriveEncoder::side; ++x) {
            unsigned level = channelOf(encoded(encoder, colour, x, y), bits, 1);
            sum += projector.channels[1](level / last);
            widest = std::max(widest, projector.channels[1](std::min(1.0, (level + 1) / last)) -
                                          projector.channels[1](level / last));
          }
        }
        double mean = sum / (DriveEncoder::side * DriveEncoder::side);
        QVERIFY(std::abs(mean - static_cast<double>(light)) <= widest / 64.0 + 1e-6);
        if (light == 0.0f || light == 1.0f) QCOMPARE(mean, static_cast<double>(light));
      }
    }
  }

  void whatIsNoLightIsBlack() {
    DriveEncoder encoder(responseOf("gamma"), 8, Dither::blueNoise);
    float wild[3] = {std::numeric_limits<float>::quiet_NaN(), -1.0f, std::numeric_limits<float>::infinity()};
    QCOMPARE(encoded(encoder, wild, 5, 6), 0xffff0000u);
  }

  void thresholdsAreAllThereOnce() {
    for (int side : {8, 16, 64}) {
      std::vector<float> noise = blueNoise(side), sorted = noise;
      std::sort(sorted.begin(), sorted.end());
      auto count = static_cast<float>(side * side);
      for (std::size_t k = 0; k < sorted.size(); ++k)
        QCOMPARE(sorted[k], (static_cast<float>(k) + 0.5f) / count);
      QVERIFY(noise == blueNoise(side));
    }
  }

  /// Neighbours are far less alike than in white noise, in which means over 8x8 have a deviation of
  /// sqrt(1/12) / 8 = 0.036.
  void blueNoiseHasNoLowFrequencies() {
    constexpr int side = 64, block = 8;
    std::vector<float> noise = blueNoise(side);
    double sum = 0.0;
    for (int y = 0; y < side; y += block) {
      for (int x = 0; x < side; x += block) {
        double mean = 0.0;
        for (int j = 0; j < block; ++j)
          for (int i = 0; i < block; ++i)
            mean += static_cast<double>(noise[static_cast<std::size_t>((y + j) * side + x + i)]) /
                    (block * block);
        sum += std::pow(mean - 0.5, 2);
      }
    }
    double deviation = std::sqrt(sum / ((side / block) * (side / block)));
    QVERIFY2(deviation < 0.01, qPrintable(QString::number(deviation)));
  }
};

QTEST_GUILESS_MAIN(TestDriveEncoder)
#include "test_drive_encoder.moc"
