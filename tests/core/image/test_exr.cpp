// SPDX-License-Identifier: MIT
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>

#include <QTemporaryDir>
#include <QtTest>
#include <fstream>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/random.h"
#include "relucent/image/exr.h"
#include "shared_data.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::image;
namespace fs = std::filesystem;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

Image noise(Size size, int channels, std::uint64_t seed) {
  Random random{seed};
  Image image(size, channels);
  for (float& value : image.data()) value = static_cast<float>(random.normal()) * 10.0f;
  return image;
}

bool sameBits(const Image& a, const Image& b) {
  return a.size() == b.size() && a.channels() == b.channels() &&
         std::memcmp(a.data().data(), b.data().data(), a.data().size() * sizeof(float)) == 0;
}

/// Without waiting for the disk, as there are hundreds.
void writePlainly(const fs::path& path, std::string_view content) {
  std::ofstream(path, std::ios::binary) << content;
}

struct Counts {
  int notNumbers = 0, infinities = 0, negatives = 0;
};
Counts countsOf(const Image& image) {
  Counts counts;
  for (float value : image.data()) {
    counts.notNumbers += std::isnan(value);
    counts.infinities += std::isinf(value);
    counts.negatives += value < 0.0f && std::isfinite(value);
  }
  return counts;
}

}  // namespace

#define SHARED(variable, name)                      \
  const fs::path variable = test::sharedData(name); \
  if (variable.empty()) QSKIP("the real data beside the checkout is not there")

class TestExr : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path file(const char* name) const { return fs::path(folder_.path().toStdString()) / name; }

 private slots:
  void floatKeepsEveryBit() {
    Image image = noise({17, 11}, 3, 1);
    image.at(0, 0, 0) = std::numeric_limits<float>::denorm_min();
    image.at(1, 0, 0) = -1e-40f;
    image.at(2, 0, 0) = std::numeric_limits<float>::max();
    image.at(3, 0, 0) = -0.0f;
    image.at(4, 0, 0) = infinity;
    image.at(5, 0, 0) = notANumber;
    writeExr(file("float.exr"), image, ExrType::floatType);
    const ExrImage back = readExr(file("float.exr"));
    QCOMPARE(back.channelNames, (std::vector<std::string>{"R", "G", "B"}));
    QVERIFY(sameBits(back.pixels, image));
    QVERIFY(sameBits(readRgbExr(file("float.exr")), image));
  }

  /// Law: what is not packed is the same picture, and one bit that changed on the disk is noticed, as in ZIP.
  void whatIsNotPackedHasAChecksum() {
    ExrImage image;
    image.pixels = noise({17, 11}, 3, 1);
    image.channelNames = {"Y", "R", "A"};  // not as files have them
    image.attributes = {{exr_attribute::units, "lamps"}};
    writeExr(file("plain.exr"), image, ExrType::floatType, ExrPacking::none);
    const ExrImage back = readExr(file("plain.exr"));
    QVERIFY(back.attributes == image.attributes);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto place =
          std::ranges::find(back.channelNames, image.channelNames[c]) - back.channelNames.begin();
      for (int x = 0; x < 17; ++x)
        QCOMPARE(back.pixels.at(x, 5, static_cast<int>(place)), image.pixels.at(x, 5, static_cast<int>(c)));
    }
    const std::string whole = readFile(file("plain.exr"));
    QVERIFY(whole.size() > image.pixels.data().size() * sizeof(float));
    for (std::size_t at = whole.size() - 1000; at < whole.size(); at += 37) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ 1);
      writePlainly(file("damaged.exr"), damaged);
      QVERIFY(!sentenceOf([&] { readExr(file("damaged.exr")); }, ErrorKind::format).empty());
    }
    QVERIFY_THROWS_EXCEPTION(std::logic_error,
                             writeExr(file("x.exr"), image, ExrType::half, ExrPacking::none));
  }

  void halfRoundsToNearest() {
    const Image image = noise({17, 11}, 3, 2);
    writeExr(file("half.exr"), image, ExrType::half);
    const Image back = readExr(file("half.exr")).pixels;
    for (std::size_t i = 0; i < image.data().size(); ++i) {
      const float allowed = std::max(std::abs(image.data()[i]) * 0x1p-11f, 0x1p-25f);  // half a step of half
      QVERIFY(std::abs(back.data()[i] - image.data()[i]) <= allowed);
    }
    writeExr(file("again.exr"), back, ExrType::half);
    QVERIFY(sameBits(readExr(file("again.exr")).pixels, back));
  }

  void halfDenormalsSurvive() {
    Image image({3, 1}, 1, std::vector<float>{0x1p-24f, 3 * 0x1p-24f, -0x1p-15f});
    writeExr(file("small.exr"), image, ExrType::half);
    QVERIFY(sameBits(readExr(file("small.exr")).pixels, image));
  }

  void halfOverflowIsRefused_data() {
    QTest::addColumn<float>("value");
    QTest::addColumn<bool>("fits");
    QTest::newRow("largest half") << 65504.0f << true;
    QTest::newRow("rounds to the largest half") << 65519.0f << true;
    QTest::newRow("too large") << 65520.0f << false;
    QTest::newRow("far too large") << -1e30f << false;
    QTest::newRow("infinity is itself") << infinity << true;
  }
  void halfOverflowIsRefused() {
    QFETCH(float, value);
    QFETCH(bool, fits);
    writeFileAtomically(file("over.exr"), "old");
    const std::string sentence = sentenceOf(
        [&] { writeExr(file("over.exr"), Image({2, 2}, 3, value), ExrType::half); }, ErrorKind::input);
    QCOMPARE(sentence.empty(), fits);
    if (!fits) {
      QVERIFY(mentions(sentence, "write the picture as float"));
      QCOMPARE(readFile(file("over.exr")), std::string("old"));
    }
  }

  void everyChannelPlaceAndAttributeComesBack() {
    ExrImage image;
    image.pixels = noise({7, 5}, 5, 3);
    image.channelNames = {"R", "G", "B", "A", "variance.Y"};
    image.dataOrigin = {-3, 12};
    image.displayOrigin = {1, 2};
    image.displaySize = Size{40, 30};
    image.attributes = {{exr_attribute::units, "camera signal per second"},
                        {exr_attribute::software, "Relucent"},
                        {"relucent:gain", 1.0 / 3.0},
                        {"relucent:shot", 17}};
    writeExr(file("all.exr"), image, ExrType::floatType);
    const ExrImage back = readExr(file("all.exr"));
    QVERIFY(sameBits(back.pixels, image.pixels));
    QCOMPARE(back.channelNames, image.channelNames);
    QCOMPARE(back.dataOrigin, image.dataOrigin);
    QCOMPARE(back.displayOrigin, image.displayOrigin);
    QVERIFY(back.displaySize == image.displaySize);
    QVERIFY(back.attributes == image.attributes);
  }

  void contractsAreChecked() {
    ExrImage image;
    image.pixels = Image({2, 2}, 2);
    image.channelNames = {"R"};
    QVERIFY_THROWS_EXCEPTION(std::logic_error, writeExr(file("x.exr"), image, ExrType::half));
    image.channelNames = {"R", "R"};
    QVERIFY_THROWS_EXCEPTION(std::logic_error, writeExr(file("x.exr"), image, ExrType::half));
    image.channelNames = {"R", "G"};
    image.attributes["dataWindow"] = 3;
    QVERIFY_THROWS_EXCEPTION(std::logic_error, writeExr(file("x.exr"), image, ExrType::half));
    image.attributes.clear();
    image.dataOrigin = {std::numeric_limits<int>::max(), 0};  // beyond what OpenEXR can place
    QVERIFY_THROWS_EXCEPTION(std::logic_error, writeExr(file("x.exr"), image, ExrType::half));
    QVERIFY(!fs::exists(file("x.exr")));
  }

  void theDataWindowIsPlacedInTheDisplayWindow_data() {
    QTest::addColumn<int>("x");
    QTest::addColumn<int>("y");
    QTest::newRow("same corner") << 0 << 0;
    QTest::newRow("inside") << 2 << 1;
    QTest::newRow("over the left edge") << -3 << 2;
    QTest::newRow("over the lower right corner") << 8 << 6;
    QTest::newRow("larger than the display") << -1 << -1;
    QTest::newRow("elsewhere") << 100 << -100;
    QTest::newRow("far away") << 1000000000 << -1000000000;
  }
  void theDataWindowIsPlacedInTheDisplayWindow() {
    QFETCH(int, x);
    QFETCH(int, y);
    ExrImage image;
    image.pixels = noise({12, 9}, 3, 4);
    image.channelNames = {"R", "G", "B"};
    image.displayOrigin = {5, -7};
    image.dataOrigin = {5 + x, -7 + y};
    image.displaySize = Size{10, 8};
    writeExr(file("placed.exr"), image, ExrType::floatType);
    const Image placed = readRgbExr(file("placed.exr"), Size{10, 8});
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 10; ++column) {
        const bool covered = row >= y && row - 9 < y && column >= x && column - 12 < x;
        const float expected = covered ? image.pixels.at(column - x, row - y, 2) : 0.0f;
        QCOMPARE(placed.at(column, row, 2), expected);
      }
  }

  void greyIsReplicatedAndOtherChannelsAreNamed() {
    writeExr(file("grey.exr"), noise({3, 2}, 1, 5), ExrType::floatType);
    const Image rgb = readRgbExr(file("grey.exr")), grey = readExr(file("grey.exr")).pixels;
    for (std::size_t i = 0; i < grey.pixels(); ++i)
      for (float value : rgb.pixel(i)) QCOMPARE(value, grey.data()[i]);

    ExrImage depth;
    depth.pixels = Image({2, 2}, 2);
    depth.channelNames = {"Z", "left.R"};
    writeExr(file("depth.exr"), depth, ExrType::floatType);
    QVERIFY(mentions(sentenceOf([&] { readRgbExr(file("depth.exr")); }, ErrorKind::format), "Z, left.R"));
  }

  void anotherSizeIsRefused() {
    writeExr(file("size.exr"), Image({4, 3}, 3), ExrType::half);
    QVERIFY(mentions(sentenceOf([&] { readRgbExr(file("size.exr"), Size{3, 4}); }, ErrorKind::input),
                     "4x3 pixels where 3x4"));
  }

  void tiledFilesAreRead() {
    const Image image = noise({70, 50}, 1, 6);
    Imf::Header header(70, 50);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.setTileDescription(Imf::TileDescription(32, 32));
    {
      Imf::TiledOutputFile tiled(file("tiled.exr").c_str(), header);
      Imf::FrameBuffer frame;
      frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, image.data().data(), header.dataWindow()));
      tiled.setFrameBuffer(frame);
      tiled.writeTiles(0, tiled.numXTiles() - 1, 0, tiled.numYTiles() - 1);
    }
    QVERIFY(sameBits(readExr(file("tiled.exr")).pixels, image));
  }

  void subsampledChannelsAreRefused() {
    const std::vector<float> samples(64);
    Imf::Header header(8, 8);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.channels().insert("RY", Imf::Channel(Imf::FLOAT, 2, 2));
    {
      Imf::OutputFile out(file("chroma.exr").c_str(), header);
      Imf::FrameBuffer frame;
      frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, samples.data(), header.dataWindow()));
      frame.insert("RY", Imf::Slice::Make(Imf::FLOAT, samples.data(), header.dataWindow(), 0, 0, 2, 2));
      out.setFrameBuffer(frame);
      out.writePixels(8);
    }
    QVERIFY(mentions(sentenceOf([&] { readExr(file("chroma.exr")); }, ErrorKind::format), "RY"));
  }

  void filesOfSeveralPartsAreRefused() {
    const std::vector<float> samples(64);
    std::vector<Imf::Header> headers(2, Imf::Header(8, 8));
    for (std::size_t i = 0; i < headers.size(); ++i) {
      headers[i].setName(i == 0 ? "left" : "right");
      headers[i].setType(Imf::SCANLINEIMAGE);
      headers[i].channels().insert("Y", Imf::Channel(Imf::FLOAT));
    }
    {
      Imf::MultiPartOutputFile out(file("parts.exr").c_str(), headers.data(), 2);
      for (int i = 0; i < 2; ++i) {
        Imf::OutputPart part(out, i);
        Imf::FrameBuffer frame;
        frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, samples.data(), headers.front().dataWindow()));
        part.setFrameBuffer(frame);
        part.writePixels(8);
      }
    }
    QVERIFY(mentions(sentenceOf([&] { readExr(file("parts.exr")); }, ErrorKind::format), "several parts"));
  }

  void anUnfinishedFileIsRefused() {
    Imf::Header header(8, 8);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    {
      Imf::OutputFile out(file("unfinished.exr").c_str(), header);
    }
    QVERIFY(mentions(sentenceOf([&] { readExr(file("unfinished.exr")); }, ErrorKind::format), "incomplete"));
  }

  void missingAndForeignFiles_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("text") << QByteArray("This is a text and not a picture.");
    QTest::newRow("magic alone") << QByteArray("\x76\x2f\x31\x01", 4);
    QTest::newRow("magic and noise") << QByteArray("\x76\x2f\x31\x01 noise noise noise noise noise");
  }
  void missingAndForeignFiles() {
    QFETCH(QByteArray, content);
    QVERIFY(!sentenceOf([&] { readExr(file("missing.exr")); }, ErrorKind::disk).empty());
    writeFileAtomically(file("foreign.exr"), content.toStdString());
    const std::string sentence = sentenceOf([&] { readExr(file("foreign.exr")); }, ErrorKind::format);
    QVERIFY(mentions(sentence, "foreign.exr: "));
  }

  void everyTruncationIsAnError() {
    writeExr(file("whole.exr"), noise({19, 23}, 3, 7), ExrType::half);
    const std::string whole = readFile(file("whole.exr"));
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 400) {
      writePlainly(file("part.exr"), whole.substr(0, length));
      const std::string sentence = sentenceOf([&] { readExr(file("part.exr")); }, ErrorKind::format);
      QVERIFY2(mentions(sentence, "part.exr"), qPrintable(QString("cut at %1").arg(length)));
    }
  }

  void damageNeverDoesMoreThanThrow() {
    writeExr(file("whole.exr"), noise({19, 23}, 3, 8), ExrType::half);
    const std::string whole = readFile(file("whole.exr"));
    Random random{9};
    for (int round = 0; round < 300; ++round) {
      std::string damaged = whole;
      // Two times in three the header, where damage can ask for anything.
      const std::size_t range = round % 3 == 0 ? damaged.size() : 400;
      for (int hit = 0; hit < 3; ++hit) damaged[random.below(range)] = static_cast<char>(random.below(256));
      writePlainly(file("damaged.exr"), damaged);
      try {
        readExr(file("damaged.exr"));
        readRgbExr(file("damaged.exr"));
      } catch (const Error&) {
      }
    }
  }

  void finiteIsChecked() {
    Image image({4, 4}, 3);
    checkFinite(image, "a.exr");
    image.at(2, 1, 1) = notANumber;
    image.at(3, 3, 0) = -infinity;
    image.at(3, 3, 2) = infinity;
    const std::string sentence = sentenceOf([&] { checkFinite(image, "a.exr"); }, ErrorKind::input);
    QVERIFY(
        mentions(sentence, "a.exr: the picture holds 1 NaN and 2 infinite values, the first at pixel 2, 1"));
  }

  // What other programs wrote. The counts are those that the data's own description gives.

  void notEverythingElsewhereIsFinite_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("notNumbers");
    QTest::addColumn<int>("infinities");
    QTest::newRow("all halves") << "AllHalfValues.exr" << 6138 << 6;
    QTest::newRow("rings") << "BrightRingsNanInf.exr" << 6 << 12;
    QTest::newRow("rings, finite") << "BrightRings.exr" << 0 << 0;
  }
  void notEverythingElsewhereIsFinite() {
    QFETCH(QString, name);
    QFETCH(int, notNumbers);
    QFETCH(int, infinities);
    SHARED(path, fs::path("openexr-images/TestImages") / name.toStdString());
    const Image image = readRgbExr(path);
    const Counts counts = countsOf(image);
    QCOMPARE(counts.notNumbers, notNumbers);
    QCOMPARE(counts.infinities, infinities);
    const std::string sentence = sentenceOf([&] { checkFinite(image, path); }, ErrorKind::input);
    QCOMPARE(sentence.empty(), notNumbers + infinities == 0);
  }

  void greyFromElsewhere() {
    SHARED(path, "openexr-images/TestImages/GrayRampsHorizontal.exr");
    QCOMPARE(readExr(path).channelNames, std::vector<std::string>{"Y"});
    const Image image = readRgbExr(path);
    QVERIFY(countsOf(image).negatives == 0 &&
            *std::max_element(image.data().begin(), image.data().end()) > 0);
  }

  void aWideRangeFromElsewhere() {
    SHARED(path, "openexr-images/TestImages/WideFloatRange.exr");
    const ExrImage image = readExr(path);
    QCOMPARE(image.channelNames, std::vector<std::string>{"G"});
    const float largest = *std::max_element(image.pixels.data().begin(), image.pixels.data().end());
    QVERIFY2(largest > 1.6e38f && largest < 1.8e38f, qPrintable(QString::number(largest)));
    QVERIFY(mentions(sentenceOf([&] { readRgbExr(path); }, ErrorKind::format), "has the channels G;"));
  }

  void negativeSamplesFromElsewhere() {
    SHARED(path, "openexr-images/TestImages/WideColorGamut.exr");
    QCOMPARE(countsOf(readRgbExr(path)).negatives, 128284);
  }

  void windowsFromElsewhere_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<double>("smallest");  // share of the 400x300 pixels that is in view
    QTest::addColumn<double>("largest");
    for (int i = 1; i <= 16; ++i) {
      // The data's README: t01 all, t09 to t12 nothing, t13 and t14 one pixel, the others a part.
      const bool all = i == 1, nothing = i >= 9 && i <= 12, one = i == 13 || i == 14;
      const double pixel = 1.0 / (400 * 300);
      QTest::addRow("t%02d", i) << QString::asprintf("t%02d.exr", i)
                                << (all       ? 1.0
                                    : nothing ? 0.0
                                              : pixel)
                                << (all       ? 1.0
                                    : nothing ? 0.0
                                    : one     ? pixel
                                              : 1.0);
    }
  }
  void windowsFromElsewhere() {
    QFETCH(QString, name);
    QFETCH(double, smallest);
    QFETCH(double, largest);
    SHARED(reference, "openexr-images/DisplayWindow/t01.exr");
    SHARED(path, fs::path("openexr-images/DisplayWindow") / name.toStdString());
    const Image whole = readRgbExr(reference);
    const ExrImage exr = readExr(path);
    QCOMPARE(exr.pixels.size(), whole.size());

    const Image placed = readRgbExr(path);
    const int left = exr.dataOrigin.x - exr.displayOrigin.x, top = exr.dataOrigin.y - exr.displayOrigin.y;
    int shown = 0;
    for (int y = 0; y < placed.height(); ++y)
      for (int x = 0; x < placed.width(); ++x) {
        const bool covered = x >= left && y >= top && x < left + whole.width() && y < top + whole.height();
        shown += covered;
        for (int c = 0; c < 3; ++c)
          QCOMPARE(placed.at(x, y, c), covered ? whole.at(x - left, y - top, c) : 0.0f);
      }
    const double share = shown / (400.0 * 300.0);
    QVERIFY2(share >= smallest && share <= largest, qPrintable(QString::number(share)));
  }
};

QTEST_GUILESS_MAIN(TestExr)
#include "test_exr.moc"
