// SPDX-License-Identifier: MIT
#include "content/canvas.h"

#include <QColorSpace>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "relucent/image/exr.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::image;

namespace {

QImage plain(QSize size, QRgb colour, QImage::Format format = QImage::Format_RGB32) {
  QImage image(size, QImage::Format_ARGB32);
  image.fill(colour);
  return image.convertToFormat(format);
}

}  // namespace

class TestCanvas : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  QString file(const char* name) const { return folder_.filePath(name); }

 private slots:
  void codesOfAnSrgbPictureStayWhatTheyAre_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("png") << "a.png";
    QTest::newRow("bmp") << "a.bmp";
    QTest::newRow("named otherwise") << "a.unknown";
  }
  void codesOfAnSrgbPictureStayWhatTheyAre() {
    QFETCH(QString, name);
    QImage picture(256, 3, QImage::Format_RGB32);
    for (int x = 0; x < 256; ++x)
      for (int y = 0; y < 3; ++y) picture.setPixel(x, y, qRgb(x, 255 - x, (x * 7) % 256));
    QVERIFY(picture.save(folder_.filePath(name), name.endsWith("bmp") ? "BMP" : "PNG"));
    QImage read = readContent(folder_.filePath(name));
    QCOMPARE(read.format(), QImage::Format_RGBX8888);
    QVERIFY(read.convertToFormat(QImage::Format_RGB32) == picture);
  }

  /// A profile says what the codes mean: linear 0.5 is code 188 in sRGB.
  void aColourProfileIsBelieved() {
    QImage linear = plain({4, 4}, qRgb(128, 128, 128));
    linear.setColorSpace(QColorSpace::SRgbLinear);
    QVERIFY(linear.save(file("linear.png")));
    int expected = static_cast<int>(std::lround(255.0 * srgbEncode(128.0 / 255.0)));
    QVERIFY(std::abs(qRed(readContent(file("linear.png")).pixel(1, 1)) - expected) <= 1);
  }

  void transparentIsNoLight() {
    QVERIFY(plain({2, 2}, qRgba(255, 255, 255, 0), QImage::Format_ARGB32).save(file("clear.png")));
    QCOMPARE(readContent(file("clear.png")).pixel(0, 0) & 0xffffffu, 0u);
  }

  void floatPicturesStayLinear() {
    Image picture({3, 2}, 3, 0.25f);
    picture.at(2, 1, 1) = 1.5f;
    writeExr(file("a.exr").toStdString(), picture, ExrType::floatType);
    QImage read = readContent(file("a.exr"));
    QCOMPARE(read.format(), QImage::Format_RGBX32FPx4);
    auto* line = reinterpret_cast<const float*>(read.constScanLine(1));
    QCOMPARE(line[4 * 2 + 1], 1.5f);
    QCOMPARE(line[0], 0.25f);
  }

  void whatIsNoPictureIsNamed() {
    QVERIFY(mentions(sentenceOf([&] { readContent(file("missing.png")); }, ErrorKind::disk), "missing.png"));
    QFile text(file("text.png"));
    QVERIFY(text.open(QIODevice::WriteOnly) && text.write("no picture") > 0);
    text.close();
    QVERIFY(mentions(sentenceOf([&] { readContent(file("text.png")); }, ErrorKind::format), "text.png"));
  }

  void everyShapeFillsTheCanvas_data() {
    QTest::addColumn<QSize>("picture");
    QTest::addColumn<Fit>("fit");
    QTest::addColumn<QRect>("lit");
    QTest::newRow("the same size") << QSize(40, 30) << Fit::fit << QRect(0, 0, 40, 30);
    QTest::newRow("wide, with bars") << QSize(80, 30) << Fit::fit << QRect(0, 7, 40, 15);
    QTest::newRow("tall, with bars") << QSize(30, 60) << Fit::fit << QRect(12, 0, 15, 30);
    QTest::newRow("stretched") << QSize(80, 30) << Fit::fill << QRect(0, 0, 40, 30);
    QTest::newRow("cut") << QSize(80, 30) << Fit::cover << QRect(0, 0, 40, 30);
    QTest::newRow("one pixel") << QSize(1, 1) << Fit::cover << QRect(0, 0, 40, 30);
  }
  void everyShapeFillsTheCanvas() {
    QFETCH(QSize, picture);
    QFETCH(Fit, fit);
    QFETCH(QRect, lit);
    QImage placed = onCanvas(plain(picture, qRgb(200, 100, 50), QImage::Format_RGBX8888), {{40, 30}, fit});
    QCOMPARE(placed.size(), QSize(40, 30));
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x)
        QCOMPARE(placed.pixel(x, y) & 0xffffffu, lit.contains(x, y) ? qRgb(200, 100, 50) & 0xffffffu : 0u);
  }

  /// Half the light of white is code 188, not 128; both ends are the pictures themselves.
  void fadesLightNotCodes() {
    QImage black = plain({5, 4}, qRgb(0, 0, 0), QImage::Format_RGBX8888);
    QImage white = plain({5, 4}, qRgb(255, 255, 255), QImage::Format_RGBX8888);
    QCOMPARE(qRed(crossFaded(black, white, 0.5).pixel(2, 2)),
             static_cast<int>(std::lround(255.0 * srgbEncode(0.5))));
    QImage codes(256, 1, QImage::Format_RGBX8888);
    for (int x = 0; x < 256; ++x) codes.setPixel(x, 0, qRgb(x, x, x));
    QImage other = plain({256, 1}, qRgb(9, 99, 199), QImage::Format_RGBX8888);
    QVERIFY(crossFaded(codes, other, 0.0) == codes && crossFaded(other, codes, 1.0) == codes);
    QVERIFY(crossFaded(codes, codes, 0.3) == codes);
  }
};

QTEST_GUILESS_MAIN(TestCanvas)
#include "test_canvas.moc"
