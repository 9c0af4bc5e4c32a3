// SPDX-License-Identifier: MIT
// Frames as decoders and cameras leave them in memory, in every arrangement of their samples.
#include "content/video_frame.h"

#include <QVideoFrame>
#include <QtTest>
#include <functional>

#include "support/sentences.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;
using Format = QVideoFrameFormat;

namespace {

const QSize size{6, 4};

/// Samples that differ everywhere; chroma belongs to 2x2 pixels.
int luma(int x, int y) {
  return 40 + 7 * x + 31 * y;
}
int blue(int x, int y) {
  return 100 + 9 * (x / 2) + 20 * (y / 2);
}
int red(int x, int y) {
  return 150 - 11 * (x / 2) + 13 * (y / 2);
}

/// The first of two samples of which the second is the other.
struct Place {
  int plane, x, y;  // x in bytes
};
using PlaceOf = std::function<Place(int x, int y)>;

/// How an arrangement keeps Y, Cb and Cr of a pixel, and in how many bytes.
struct Arrangement {
  PlaceOf luma, blue, red;
  int shift = 0;  // of 8-bit samples into two bytes
  int bytes = 1;
};

PlaceOf planar(int plane, int coarserX, int coarserY, int step = 1, int first = 0) {
  return [=](int x, int y) { return Place{plane, first + step * (x / coarserX), y / coarserY}; };
}

Arrangement arrangementOf(Format::PixelFormat format) {
  switch (format) {
    case Format::Format_YV12:
      return {planar(0, 1, 1), planar(2, 2, 2), planar(1, 2, 2)};
    case Format::Format_YUV422P:
      return {planar(0, 1, 1), planar(1, 2, 1), planar(2, 2, 1)};
    case Format::Format_NV12:
      return {planar(0, 1, 1), planar(1, 2, 2, 2), planar(1, 2, 2, 2, 1)};
    case Format::Format_NV21:
      return {planar(0, 1, 1), planar(1, 2, 2, 2, 1), planar(1, 2, 2, 2)};
    case Format::Format_YUYV:
      return {planar(0, 1, 1, 2), planar(0, 2, 1, 4, 1), planar(0, 2, 1, 4, 3)};
    case Format::Format_UYVY:
      return {planar(0, 1, 1, 2, 1), planar(0, 2, 1, 4), planar(0, 2, 1, 4, 2)};
    case Format::Format_P010:
    case Format::Format_P016:
      return {planar(0, 1, 1, 2), planar(1, 2, 2, 4), planar(1, 2, 2, 4, 2), 8, 2};
    case Format::Format_YUV420P10:
      return {planar(0, 1, 1, 2), planar(1, 2, 2, 2), planar(2, 2, 2, 2), 2, 2};
    default:
      return {planar(0, 1, 1), planar(1, 2, 2), planar(2, 2, 2)};
  }
}

QVideoFrame frameIn(const Format& format) {
  QVideoFrame frame(format);
  if (!frame.map(QVideoFrame::WriteOnly)) return {};
  Arrangement arrangement = arrangementOf(format.pixelFormat());
  auto put = [&](const Place& place, int value) {
    uchar* at = frame.bits(place.plane) + place.y * frame.bytesPerLine(place.plane) + place.x;
    value <<= arrangement.shift;
    at[0] = static_cast<uchar>(value & 255);
    if (arrangement.bytes == 2) at[1] = static_cast<uchar>(value >> 8);
  };
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width(); ++x) {
      put(arrangement.luma(x, y), luma(x, y));
      put(arrangement.blue(x, y), blue(x, y));
      put(arrangement.red(x, y), red(x, y));
    }
  frame.unmap();
  return frame;
}

}  // namespace

class TestVideoFrame : public QObject {
  Q_OBJECT

 private slots:
  void everyArrangementIsTheSamePicture_data() {
    QTest::addColumn<int>("format");
    for (auto format : {Format::Format_YUV420P, Format::Format_YV12, Format::Format_YUV422P,
                        Format::Format_NV12, Format::Format_NV21, Format::Format_YUYV, Format::Format_UYVY,
                        Format::Format_P010, Format::Format_P016, Format::Format_YUV420P10})
      QTest::newRow(qPrintable(Format::pixelFormatToString(format))) << static_cast<int>(format);
  }
  void everyArrangementIsTheSamePicture() {
    QFETCH(int, format);
    QImage shown = pictureOf(frameIn({size, Format::PixelFormat(format)}));
    QCOMPARE(shown.format(), QImage::Format_RGBX8888);
    for (int y = 0; y < size.height(); ++y)
      for (int x = 0; x < size.width(); ++x) {
        std::uint8_t samples[3]{static_cast<std::uint8_t>(luma(x, y)), static_cast<std::uint8_t>(blue(x, y)),
                                static_cast<std::uint8_t>(red(x, y))};
        std::uint8_t expected[4];
        srgbFromVideo({{&samples[0], 1, 1}, {&samples[1], 1, 1}, {&samples[2], 1, 1}}, {1, 1},
                      encodingOf({size, Format::PixelFormat(format)}), expected, 4);
        QCOMPARE(shown.pixel(x, y), qRgb(expected[0], expected[1], expected[2]));
      }
  }

  void redGreenBlueStaysWhatItIs() {
    QVideoFrame frame({size, Format::Format_BGRX8888});
    QVERIFY(frame.map(QVideoFrame::WriteOnly));
    for (int y = 0; y < size.height(); ++y)
      for (int x = 0; x < size.width(); ++x) {
        uchar* pixel = frame.bits(0) + y * frame.bytesPerLine(0) + 4 * x;
        pixel[0] = 30;
        pixel[1] = 120;
        pixel[2] = static_cast<uchar>(200 + x);
      }
    frame.unmap();
    QImage shown = pictureOf(frame);
    for (int x = 0; x < size.width(); ++x) QCOMPARE(shown.pixel(x, 2), qRgb(200 + x, 120, 30));
  }

  void whatTheFileDoesNotSayIsTheUsual() {
    auto encoding = [](QSize of, auto change) {
      Format format(of, Format::Format_YUV420P);
      change(format);
      return encodingOf(format);
    };
    auto nothing = [](Format&) {};
    using Matrix = VideoEncoding::Matrix;
    QVERIFY(encoding({720, 576}, nothing).matrix == Matrix::bt601);
    QVERIFY(encoding({1280, 720}, nothing).matrix == Matrix::bt709);
    QVERIFY(encoding({1280, 720}, [](Format& f) { f.setColorSpace(Format::ColorSpace_BT601); }).matrix ==
            Matrix::bt601);
    QVERIFY(encoding({720, 576}, [](Format& f) { f.setColorSpace(Format::ColorSpace_BT709); }).matrix ==
            Matrix::bt709);
    VideoEncoding usual = encoding(size, nothing);
    QVERIFY(usual.range == VideoEncoding::Range::video && usual.transfer == VideoEncoding::Transfer::bt1886);
    VideoEncoding full = encoding(size, [](Format& f) { f.setColorRange(Format::ColorRange_Full); });
    QVERIFY(full.range == VideoEncoding::Range::full && full.transfer == VideoEncoding::Transfer::srgb);
    VideoEncoding jpeg = encoding(size, [](Format& f) {
      f.setColorRange(Format::ColorRange_Full);
      f.setColorTransfer(Format::ColorTransfer_BT601);
    });
    QVERIFY(jpeg.transfer == VideoEncoding::Transfer::srgb);
    QVERIFY(encoding(size, [](Format& f) { f.setColorTransfer(Format::ColorTransfer_Linear); }).transfer ==
            VideoEncoding::Transfer::linear);
  }

  void whatNoProjectorShowsIsRefused() {
    Format format(size, Format::Format_P010);
    for (auto transfer : {Format::ColorTransfer_ST2084, Format::ColorTransfer_STD_B67}) {
      format.setColorTransfer(transfer);
      QVERIFY(mentions(sentenceOf([&] { encodingOf(format); }, ErrorKind::input), "high dynamic range"));
    }
    format.setColorTransfer(Format::ColorTransfer_BT709);
    format.setColorSpace(Format::ColorSpace_BT2020);
    QVERIFY(mentions(sentenceOf([&] { pictureOf(QVideoFrame(format)); }, ErrorKind::input), "BT.2020"));
  }

  void telephonesFilmsStandUpright() {
    QVideoFrame frame = frameIn({size, Format::Format_YUV420P});
    QImage lying = pictureOf(frame);
#if QT_VERSION >= QT_VERSION_CHECK(6, 7, 0)
    frame.setRotation(QtVideo::Rotation::Clockwise90);
#else
    frame.setRotationAngle(QVideoFrame::Rotation90);
#endif
    QImage turned = pictureOf(frame);
    QCOMPARE(turned.size(), QSize(4, 6));
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 4; ++x) QCOMPARE(turned.pixel(x, y), lying.pixel(y, 3 - x));
  }
};

QTEST_GUILESS_MAIN(TestVideoFrame)
#include "test_video_frame.moc"
