// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/random.h"
#include "relucent/image/colour.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "shared_data.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::image;
namespace fs = std::filesystem;

namespace {

/// Every value a whole code of `bits`, so that files keep it exactly.
Image codes(Size size, int channels, int bits, std::uint64_t seed) {
  Random random{seed};
  const double top = (1 << bits) - 1;
  Image image(size, channels);
  for (float& value : image.data())
    value = static_cast<float>(static_cast<double>(random.below(1u << bits)) / top);
  return image;
}

void appendNumber(std::string& bytes, std::uint32_t value, int count, bool bigEndian) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * (bigEndian ? count - 1 - i : i));
}

/// The checksum of PNG chunks, bit by bit (ISO 3309).
std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffff;
  for (char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
  }
  return ~crc;
}

/// A baseline TIFF of one row, written byte by byte: no library decides its byte order.
std::string tinyTiff(const std::vector<std::uint16_t>& row, bool bigEndian) {
  std::string bytes = bigEndian ? std::string("MM\0*", 4) : std::string("II*\0", 4);
  const auto width = static_cast<std::uint32_t>(row.size());
  appendNumber(bytes, 8 + 2 * width, 4, bigEndian);
  for (std::uint16_t sample : row) appendNumber(bytes, sample, 2, bigEndian);
  const std::vector<std::array<std::uint32_t, 3>> entries{{256, 3, width}, {257, 3, 1}, {258, 3, 16},
                                                          {259, 3, 1},     {262, 3, 1}, {273, 4, 8},
                                                          {277, 3, 1},     {278, 3, 1}, {279, 4, 2 * width}};
  appendNumber(bytes, static_cast<std::uint32_t>(entries.size()), 2, bigEndian);
  for (const auto& [tag, type, value] : entries) {
    appendNumber(bytes, tag, 2, bigEndian);
    appendNumber(bytes, type, 2, bigEndian);
    appendNumber(bytes, 1, 4, bigEndian);
    appendNumber(bytes, value, type == 3 ? 2 : 4, bigEndian);
    if (type == 3) appendNumber(bytes, 0, 2, bigEndian);
  }
  appendNumber(bytes, 0, 4, bigEndian);
  return bytes;
}

std::string opencvFile(const char* extension, const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  // Uncompressed TIFF: OpenCV's default for float is a lossy compression.
  cv::imencode(extension, picture, bytes, {cv::IMWRITE_TIFF_COMPRESSION, 1});
  return std::string(bytes.begin(), bytes.end());
}

cv::Mat gradient(int type) {
  cv::Mat picture(24, 32, type);
  cv::randu(picture, cv::Scalar::all(0), cv::Scalar::all(CV_MAT_DEPTH(type) == CV_16U ? 65535 : 255));
  return picture;
}

}  // namespace

class TestPictureFiles : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path file(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }
  fs::path fileWith(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;  // without waiting for the disk
    return file(name);
  }

 private slots:
  void pngKeepsEveryCode_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("channels");
    for (int bits : {8, 16})
      for (int channels : {1, 3}) QTest::addRow("%d bits, %d channels", bits, channels) << bits << channels;
  }
  void pngKeepsEveryCode() {
    QFETCH(int, bits);
    QFETCH(int, channels);
    const Image image = codes({31, 17}, channels, bits, 1);
    writePng(file("codes.png"), image, bits);
    const Picture back = readPicture(file("codes.png"));
    QCOMPARE(back.bits, bits);
    QCOMPARE(back.encoded.channels(), 3);
    for (std::size_t i = 0; i < image.pixels(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        QCOMPARE(back.encoded.pixel(i)[c], image.pixel(i)[channels == 3 ? c : 0]);
  }

  void pngRoundsToTheNearestCode() {
    Image image({4, 1}, 1, std::vector<float>{0.49f / 255.0f, 0.51f / 255.0f, -3.0f, 1.5f});
    writePng(file("rounded.png"), image, 8);
    const Image back = readPicture(file("rounded.png")).encoded;
    QCOMPARE(back.at(0, 0, 0), 0.0f);
    QCOMPARE(back.at(1, 0, 0), 1.0f / 255.0f);
    QCOMPARE(back.at(2, 0, 0), 0.0f);
    QCOMPARE(back.at(3, 0, 0), 1.0f);
    image.at(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    QVERIFY_THROWS_EXCEPTION(std::logic_error, encodePng(image, 8));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, encodePng(Image({1, 1}, 3), 12));
  }

  void theFirstChannelIsRed() {
    Image image({1, 1}, 3, std::vector<float>{1.0f, 0.0f, 0.2f});
    writePng(file("red.png"), image, 8);
    QCOMPARE(readPicture(file("red.png")).encoded, image);
    QVERIFY(cv::imread(file("red.png").string()).at<cv::Vec3b>(0, 0) == cv::Vec3b(51, 0, 255));
  }

  void aPng16IsBigEndian() {
    // Written and read by one library, swapped bytes would go unnoticed: look at the samples in the file.
    const Image image({1, 1}, 3, std::vector<float>{258.0f / 65535.0f, 0.0f, 1.0f});
    const std::string bytes = encodePng(image, 16);
    QCOMPARE(readPicture(fileWith("order.png", bytes)).encoded, image);
    const std::string raw =
        qUncompress([&] {
          const std::size_t data = bytes.find("IDAT") + 4;
          QByteArray block(bytes.data() + data, static_cast<qsizetype>(bytes.size() - data));
          return QByteArray("\0\0\0\x07", 4) + block;
        }())
            .toStdString();
    QVERIFY(raw.size() >= 7);
    const auto red = raw.substr(1, 2);
    // The filter of a one-pixel row leaves the first sample as it is.
    QCOMPARE(red, std::string("\x01\x02", 2));
  }

  void tiffOfBothByteOrders_data() {
    QTest::addColumn<bool>("bigEndian");
    QTest::newRow("Intel") << false;
    QTest::newRow("Motorola") << true;
  }
  void tiffOfBothByteOrders() {
    QFETCH(bool, bigEndian);
    const std::vector<std::uint16_t> row{0, 1, 256, 258, 32768, 65535};
    const Picture picture = readPicture(fileWith("order.tif", tinyTiff(row, bigEndian)));
    QCOMPARE(picture.bits, 16);
    for (std::size_t i = 0; i < row.size(); ++i)
      QCOMPARE(picture.encoded.at(static_cast<int>(i), 0, 1), static_cast<float>(row[i] / 65535.0));
  }

  void everySampleKindIsRead_data() {
    QTest::addColumn<QString>("extension");
    QTest::addColumn<int>("type");
    QTest::addColumn<int>("bits");
    QTest::newRow("png 8") << ".png" << CV_8UC3 << 8;
    QTest::newRow("png 16") << ".png" << CV_16UC3 << 16;
    QTest::newRow("png grey 16") << ".png" << CV_16UC1 << 16;
    QTest::newRow("tiff 8") << ".tif" << CV_8UC3 << 8;
    QTest::newRow("tiff 16") << ".tif" << CV_16UC3 << 16;
    QTest::newRow("tiff float") << ".tif" << CV_32FC3 << 0;
    QTest::newRow("tiff grey float") << ".tif" << CV_32FC1 << 0;
    QTest::newRow("bmp") << ".bmp" << CV_8UC3 << 8;
  }
  void everySampleKindIsRead() {
    QFETCH(QString, extension);
    QFETCH(int, type);
    QFETCH(int, bits);
    const cv::Mat source = gradient(type);
    const Picture picture = readPicture(fileWith("kind", opencvFile(extension.toLatin1(), source)));
    QCOMPARE(picture.bits, bits);
    QCOMPARE(picture.encoded.size(), (Size{32, 24}));
    cv::Mat expected;
    source.convertTo(expected, CV_64F, bits == 0 ? 1.0 : 1.0 / ((1 << bits) - 1));
    const int channels = expected.channels();
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x)
        for (int c = 0; c < 3; ++c) {
          const double wanted = expected.ptr<double>(y)[x * channels + (channels == 3 ? 2 - c : 0)];
          QVERIFY(std::abs(picture.encoded.at(x, y, c) - wanted) <= 1e-7 * std::max(1.0, wanted));
        }
  }

  void jpegIsCloseToItsSource() {
    const cv::Mat flat(16, 16, CV_8UC3, cv::Scalar(30, 90, 200));
    const Image image = readPicture(fileWith("flat.jpg", opencvFile(".jpg", flat))).encoded;
    // Two codes: what JPEG's colour transform and rounding cost a flat colour.
    QVERIFY(std::abs(image.at(8, 8, 0) - 200.0f / 255.0f) <= 2.0f / 255.0f);
    QVERIFY(std::abs(image.at(8, 8, 2) - 30.0f / 255.0f) <= 2.0f / 255.0f);
  }

  void sidewaysPhotographsAreTurnedForPeopleOnly() {
    // A JPEG with an Exif header that says: top of the picture is on the right.
    const std::string jpeg = opencvFile(".jpg", cv::Mat(8, 16, CV_8UC3, cv::Scalar::all(100)));
    std::string exif("Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0", 32);
    std::string app("\xff\xe1\0", 3);
    app += static_cast<char>(exif.size() + 2);
    const fs::path path = fileWith("sideways.jpg", jpeg.substr(0, 2) + app + exif + jpeg.substr(2));
    QCOMPARE(readPicture(path).encoded.size(), (Size{16, 8}));
    QCOMPARE(readPicture(path, Orientation::upright).encoded.size(), (Size{8, 16}));
    QCOMPARE(readLinearContent(path).size(), (Size{8, 16}));
  }

  void transparencyLiesOnBlack() {
    cv::Mat picture(1, 2, CV_8UC4);
    picture.at<cv::Vec4b>(0, 0) = {0, 0, 255, 0};
    picture.at<cv::Vec4b>(0, 1) = {0, 0, 255, 51};
    const Image image = readPicture(fileWith("clear.png", opencvFile(".png", picture))).encoded;
    QCOMPARE(image.at(0, 0, 0), 0.0f);
    QCOMPARE(image.at(1, 0, 0), 0.2f);
  }

  void exrIsKnownByItsContent() {
    const Image image({2, 2}, 3, 7.5f);
    writeExr(file("picture.png"), image, ExrType::floatType);
    const Picture picture = readPicture(file("picture.png"));
    QCOMPARE(picture.bits, 0);
    QCOMPARE(picture.encoded, image);
  }

  void contentIsDecodedExactlyOnce() {
    const Image encoded({1, 1}, 3, 128.0f / 255.0f);
    writePng(file("content.png"), encoded, 8);
    QCOMPARE(readLinearContent(file("content.png")).at(0, 0, 0),
             static_cast<float>(srgbDecode(128.0f / 255.0f)));
    // Linear files must not be decoded at all.
    writeExr(file("content.exr"), Image({1, 1}, 3, 0.5f), ExrType::floatType);
    QCOMPARE(readLinearContent(file("content.exr")).at(0, 0, 0), 0.5f);
    // Round trip: linear -> encoded file -> linear, within half a code of 16 bits at the steepest place.
    const float linear = 0.18f;
    writePng(file("grey.png"), srgbEncoded(Image({1, 1}, 3, linear)), 16);
    QVERIFY(std::abs(readLinearContent(file("grey.png")).at(0, 0, 0) - linear) < 2.4f * 0.5f / 65535.0f);
  }

  void contentIsNeverNegativeNorNan() {
    Image image({2, 1}, 3, std::vector<float>{-0.5f, 2.0f, 0.25f, 0.0f, 0.0f, 0.0f});
    writeExr(file("gamut.exr"), image, ExrType::floatType);
    const Image content = readLinearContent(file("gamut.exr"));
    QCOMPARE(content.at(0, 0, 0), 0.0f);
    QCOMPARE(content.at(0, 0, 1), 2.0f);
    image.at(1, 0, 2) = std::numeric_limits<float>::quiet_NaN();
    writeExr(file("nan.exr"), image, ExrType::floatType);
    QVERIFY(mentions(sentenceOf([&] { readLinearContent(file("nan.exr")); }, ErrorKind::input),
                     "1 NaN and 0 infinite values, the first at pixel 1, 0"));
  }

  void whatIsNoPictureIsNamed_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<QString>("part");
    QTest::newRow("empty") << QByteArray() << "cut short";
    QTest::newRow("text") << QByteArray("no picture at all") << "not a picture";
    QTest::newRow("zeros") << QByteArray(1000, '\0') << "not a picture";
    QTest::newRow("png signature") << QByteArray("\x89PNG\r\n\x1a\n") << "cut short";
    QTest::newRow("jpeg start") << QByteArray("\xff\xd8\xff\xe0") << "cut short";
    QTest::newRow("tiff start") << QByteArray("II*\0\x08\0\0\0", 8) << "cut short";
  }
  void whatIsNoPictureIsNamed() {
    QFETCH(QByteArray, content);
    QFETCH(QString, part);
    const fs::path path = fileWith("foreign.png", content.toStdString());
    QVERIFY(mentions(sentenceOf([&] { readPicture(path); }, ErrorKind::format), part.toStdString()));
    QVERIFY(!sentenceOf([&] { readPicture(file("missing.png")); }, ErrorKind::disk).empty());
    QVERIFY(!sentenceOf([&] { readPicture(file("")); }, ErrorKind::disk).empty());  // a folder
  }

  void everyTruncationIsAnError_data() {
    QTest::addColumn<QString>("extension");
    QTest::addColumn<int>("type");
    QTest::newRow("png 8") << ".png" << CV_8UC3;
    QTest::newRow("png 16") << ".png" << CV_16UC3;
    QTest::newRow("jpeg") << ".jpg" << CV_8UC3;
    QTest::newRow("tiff") << ".tif" << CV_16UC3;
  }
  void everyTruncationIsAnError() {
    QFETCH(QString, extension);
    QFETCH(int, type);
    const std::string whole = opencvFile(extension.toLatin1(), gradient(type));
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 60) {
      const fs::path path = fileWith("part", whole.substr(0, length));
      QVERIFY2(!sentenceOf([&] { readPicture(path); }, ErrorKind::format).empty(),
               qPrintable(QString("cut at %1 of %2").arg(length).arg(whole.size())));
    }
  }

  void aHugePictureIsAnErrorBeforeItIsAllocated_data() {
    QTest::addColumn<quint32>("side");
    QTest::newRow("beyond OpenCV") << 100000u;
    QTest::newRow("beyond libpng") << 0x7fffffffu;
  }
  void aHugePictureIsAnErrorBeforeItIsAllocated() {
    QFETCH(quint32, side);
    std::string png = encodePng(Image({1, 1}, 1), 8), header = "IHDR";
    appendNumber(header, side, 4, true);
    appendNumber(header, side, 4, true);
    header += png.substr(24, 5);
    appendNumber(header, crc32(header), 4, true);
    png.replace(12, header.size(), header);
    QVERIFY(mentions(sentenceOf([&] { readPicture(fileWith("huge.png", png)); }, ErrorKind::format),
                     "too large"));
  }

  void aPhotographFromElsewhere() {
    const fs::path path = test::sharedData("graycode-captures/capture_0/graycode_40.png");
    if (path.empty()) QSKIP("the real data beside the checkout is not there");
    const Picture picture = readPicture(path);
    QCOMPARE(picture.bits, 8);
    QCOMPARE(picture.encoded.size(), (Size{1280, 1024}));
    for (std::size_t i = 0; i < picture.encoded.pixels(); ++i) {
      const auto pixel = picture.encoded.pixel(i);
      QVERIFY(pixel[0] == pixel[1] && pixel[1] == pixel[2]);
    }
  }
};

QTEST_GUILESS_MAIN(TestPictureFiles)
#include "test_picture_files.moc"
