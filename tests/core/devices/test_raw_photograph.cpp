// SPDX-License-Identifier: MIT
// Raw files that the test writes, read through LibRaw.
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>

#include "relucent/base/random.h"
#include "relucent/devices/raw/raw_photograph.h"
#include "support/dng.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::test;

namespace {

std::vector<std::uint8_t> fileOf(const Dng& dng) {
  const std::string bytes = bytesOf(dng);
  return {bytes.begin(), bytes.end()};
}

/// A sensor full of different codes.
Dng sensor(Size size = {24, 22}) {
  Dng dng;
  dng.size = size;
  dng.white = 15871;
  dng.black = {500, 510, 520, 530};
  for (std::size_t i = 0; i < size.count(); ++i)
    dng.codes.push_back(static_cast<std::uint16_t>(400 + 7919 * i % 15472));
  return dng;
}

}  // namespace

class TestRawPhotograph : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    if (!hasRawPhotographs()) QSKIP("this build lacks LibRaw");
  }

  /// The law that all else stands on: every pixel is a fixed linear function of its own cell's codes, with
  /// the file's white balance, colour matrix and everything else left out.
  void aPhotographIsTheSensorsOwnValues_data() {
    QTest::addColumn<QByteArray>("filter");
    QTest::addColumn<int>("layout");
    auto row = [](const char* name, std::initializer_list<char> filter, SensorLayout layout) {
      QTest::newRow(name) << QByteArray(filter.begin(), 4) << static_cast<int>(layout);
    };
    row("RGGB", {0, 1, 1, 2}, SensorLayout::bayerRG);
    row("GRBG", {1, 0, 2, 1}, SensorLayout::bayerGR);
    row("GBRG", {1, 2, 0, 1}, SensorLayout::bayerGB);
    row("BGGR", {2, 1, 1, 0}, SensorLayout::bayerBG);
  }
  void aPhotographIsTheSensorsOwnValues() {
    QFETCH(QByteArray, filter);
    QFETCH(int, layout);
    Dng dng = sensor();
    std::copy(filter.begin(), filter.end(), dng.filter.begin());
    const RawPhotograph photograph = rawPhotograph(fileOf(dng), "x.dng");
    QCOMPARE(static_cast<int>(photograph.frame.format.layout), layout);
    QCOMPARE(photograph.frame.size, dng.size);
    QVERIFY(photograph.frame.levels.has_value());
    QCOMPARE(photographBits(photograph.frame), 0);
    const Image image = photographOf(photograph.frame, "x.dng");
    QCOMPARE(image.size(), (Size{12, 11}));
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        std::array<double, 3> sum{}, count{};
        for (int place = 0; place < 4; ++place) {
          const auto p = static_cast<std::size_t>(place);
          const auto index =
              static_cast<std::size_t>((2 * y + place / 2) * dng.size.width + 2 * x + place % 2);
          const double black = dng.black[p];
          sum[dng.filter[p]] += (dng.codes[index] - black) / (dng.white - black);
          count[dng.filter[p]] += 1.0;
        }
        for (int c = 0; c < 3; ++c) {
          const auto channel = static_cast<std::size_t>(c);
          // Float rounding of values up to 1.
          QVERIFY(std::abs(image.at(x, y, c) - sum[channel] / count[channel]) < 1e-6);
        }
      }
  }

  /// Light that adds up on the sensor adds up in the photograph: code + code' - black.
  void lightAddsUp() {
    Dng first = sensor(), second = sensor(), both = sensor();
    for (std::size_t i = 0; i < first.codes.size(); ++i) {
      const std::uint16_t black = first.black[i / 24 % 2 * 2 + i % 24 % 2];
      first.codes[i] = static_cast<std::uint16_t>(black + 311 * i % 7000);
      second.codes[i] = static_cast<std::uint16_t>(black + 977 * i % 7000);
      both.codes[i] = static_cast<std::uint16_t>(first.codes[i] + second.codes[i] - black);
    }
    const Image a = photographOf(rawPhotograph(fileOf(first), "a").frame, "a");
    const Image b = photographOf(rawPhotograph(fileOf(second), "b").frame, "b");
    const Image sum = photographOf(rawPhotograph(fileOf(both), "c").frame, "c");
    for (std::size_t i = 0; i < sum.data().size(); ++i)
      QVERIFY(std::abs(a.data()[i] + b.data()[i] - sum.data()[i]) < 1e-6f);
  }

  /// Noise around black keeps its mean.
  void darknessIsNotCutOff() {
    Dng dng = sensor();
    for (std::size_t i = 0; i < dng.codes.size(); ++i)
      dng.codes[i] =
          static_cast<std::uint16_t>(dng.black[i / 24 % 2 * 2 + i % 24 % 2] + (i / 2 % 2 == 0 ? 8 : -8));
    const Image image = photographOf(rawPhotograph(fileOf(dng), "x").frame, "x");
    QVERIFY(*std::min_element(image.data().begin(), image.data().end()) < 0.0f);
    double sum = 0.0;
    for (float value : image.data()) sum += static_cast<double>(value);
    QVERIFY(std::abs(sum) < 1e-5);
  }

  void aFullSensorIsOne() {
    Dng dng = sensor();
    std::fill(dng.codes.begin(), dng.codes.end(), dng.white);
    const Image image = photographOf(rawPhotograph(fileOf(dng), "x").frame, "x");
    for (float value : image.data()) QCOMPARE(value, 1.0f);
  }

  void oddSizesAreCutToWholeCells() {
    const RawPhotograph photograph = rawPhotograph(fileOf(sensor({31, 27})), "x");
    QCOMPARE(photograph.frame.size, (Size{30, 26}));
    QCOMPARE(photographOf(photograph.frame, "x").size(), (Size{15, 13}));
  }

  void whatTheCameraWroteDownIsKept() {
    Dng dng = sensor();
    dng.seconds = 0.008;
    dng.taken = "2026:11:21 19:30:05";
    const RawPhotograph photograph = rawPhotograph(fileOf(dng), "x");
    QVERIFY(std::abs(photograph.seconds - 0.008) < 1e-6);
    QVERIFY(photograph.taken.has_value());
    dng.taken = "2026:11:21 19:30:08";
    QCOMPARE(*rawPhotograph(fileOf(dng), "x").taken - *photograph.taken, std::time_t{3});
    QVERIFY(mentions(photograph.model, "Test"));
    QVERIFY(!rawPhotograph(fileOf(sensor()), "x").taken);
  }

  void aFileIsReadLikeItsBytes() {
    QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("IMG_0001.DNG").toStdString();
    std::ofstream(path, std::ios::binary) << bytesOf(sensor());
    const Image image = photographOf(rawPhotograph(fileOf(sensor()), "x").frame, "x");
    QVERIFY(readRawPicture(path).data() == image.data());
    const std::string gone =
        sentenceOf([&] { readRawPhotograph(path.parent_path() / "no.dng"); }, ErrorKind::disk);
    QVERIFY(mentions(gone, "no.dng"));
  }

  void whatIsNoUsableRawFileIsTold_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("part");
    const std::string whole = bytesOf(sensor());
    const QByteArray good(whole.data(), static_cast<int>(whole.size()));
    Dng linear = sensor();
    linear.isLinear = true;
    linear.codes.resize(3 * linear.codes.size(), 1000);
    const std::string interpolated = bytesOf(linear);
    QTest::newRow("empty") << QByteArray() << "cannot be read (it is empty)";
    QTest::newRow("no raw file") << QByteArray("P6 2 2 255 abcdefghijkl") << "cannot be read";
    QTest::newRow("cut short") << good.left(good.size() - 200) << "cannot be read";
    QTest::newRow("only the beginning") << good.left(60) << "cannot be read";
    QTest::newRow("interpolated")
        << QByteArray(interpolated.data(), static_cast<int>(interpolated.size()))
        << "does not hold the sensor's own values; switch the camera to full-size RAW";
    Dng flat = sensor();
    flat.white = 505;
    const std::string inverted = bytesOf(flat);
    QTest::newRow("white below black") << QByteArray(inverted.data(), static_cast<int>(inverted.size()))
                                       << "its white is not above its black";
  }
  void whatIsNoUsableRawFileIsTold() {
    QFETCH(QByteArray, bytes);
    QFETCH(QString, part);
    const std::string sentence =
        sentenceOf([&] { rawPhotograph({bytes.begin(), bytes.end()}, "IMG_0001.DNG"); }, ErrorKind::format);
    QVERIFY(mentions(sentence, part.toStdString()));
    QVERIFY(mentions(sentence, "IMG_0001.DNG: "));
  }

  /// Whatever bytes are in a file, reading it ends in a photograph or in a sentence.
  void damageEndsInASentence() {
    const std::string whole = bytesOf(sensor());
    Random random({7});
    for (int round = 0; round < 200; ++round) {
      std::vector<std::uint8_t> bytes(whole.begin(), whole.end());
      for (int hits = 0; hits < 4; ++hits)
        bytes[static_cast<std::size_t>(random.uniform() * 700.0)] =
            static_cast<std::uint8_t>(random.uniform() * 256.0);
      try {
        photographOf(rawPhotograph(bytes, "x").frame, "x");
      } catch (const Error& error) {
        QVERIFY(!error.advice().empty());
      }
    }
  }

  void rawFilesAreKnownByTheirNames() {
    for (const char* name : {"IMG_1.CR2", "a/b.nef", "x.Dng", "x.cr3"}) QVERIFY2(isRawName(name), name);
    for (const char* name : {"x.jpg", "x.tif", "cr2", "x.", "", "x.dng.txt"})
      QVERIFY2(!isRawName(name), name);
  }
};

QTEST_GUILESS_MAIN(TestRawPhotograph)
#include "test_raw_photograph.moc"
