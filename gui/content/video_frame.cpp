// SPDX-License-Identifier: MIT
#include "content/video_frame.h"

#include <QTransform>
#include <QVideoFrameFormat>
#include <QtEndian>
#include <optional>

#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

using Format = QVideoFrameFormat;

/// Unmaps when it goes.
class Mapped {
 public:
  explicit Mapped(const QVideoFrame& frame) : frame_(frame) {
    if (!frame_.map(QVideoFrame::ReadOnly))
      throw Error(ErrorKind::format,
                  RELUCENT_ENGLISH_MESSAGE("content.video-frame-inaccessible",
                                           "a frame of the video cannot be accessed"),
                  RELUCENT_ENGLISH_MESSAGE("content.use-ffmpeg-backend",
                                           "set QT_MEDIA_BACKEND=ffmpeg and start again"));
  }
  ~Mapped() { frame_.unmap(); }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;

  /// That a plane holds so many lines of so many bytes. Of unpacked pictures, which lie from the bottom up,
  /// Qt's FFmpeg backend gives another format than they have, and lines of negative length: read as told,
  /// they end outside of their memory. Throws: Error{format}.
  void demand(int number, int lines, int bytes) const {
    const int line = frame_.bytesPerLine(number), there = frame_.mappedBytes(number);
    const bool isWhole = frame_.bits(number) != nullptr && line >= bytes && lines > 0 &&
                         qint64{line} * (lines - 1) + bytes <= qint64{there};
    if (isWhole) return;
    throw Error(
        ErrorKind::format,
        RELUCENT_ENGLISH_MESSAGE("content.video-samples-astray",
                                 "the video's samples do not lie as its format has them"),
        RELUCENT_ENGLISH_MESSAGE("content.convert-to-h-264", "convert it to H.264 with 4:2:0 chroma"));
  }

  image::VideoSamples::Plane plane(int number, int step = 1, int first = 0) const {
    return {frame_.bits(number) + first, static_cast<std::size_t>(frame_.bytesPerLine(number)), step};
  }

 private:
  QVideoFrame frame_;
};

/// None for formats that are not luma and chroma.
std::optional<image::VideoSamples> samplesOf(const Mapped& frame, Format::PixelFormat format) {
  switch (format) {
    case Format::Format_YUV420P:
      return image::VideoSamples{frame.plane(0), frame.plane(1), frame.plane(2), 8, 2, 2};
    case Format::Format_YV12:
      return image::VideoSamples{frame.plane(0), frame.plane(2), frame.plane(1), 8, 2, 2};
    case Format::Format_YUV422P:
      return image::VideoSamples{frame.plane(0), frame.plane(1), frame.plane(2), 8, 2, 1};
    case Format::Format_YUV420P10:
      return image::VideoSamples{frame.plane(0), frame.plane(1), frame.plane(2), 10, 2, 2};
    case Format::Format_NV12:
      return image::VideoSamples{frame.plane(0), frame.plane(1, 2), frame.plane(1, 2, 1), 8, 2, 2};
    case Format::Format_NV21:
      return image::VideoSamples{frame.plane(0), frame.plane(1, 2, 1), frame.plane(1, 2), 8, 2, 2};
    case Format::Format_P010:
    case Format::Format_P016:  // ten bits in the upper part of sixteen
      return image::VideoSamples{frame.plane(0), frame.plane(1, 2), frame.plane(1, 2, 2), 16, 2, 2};
    case Format::Format_YUYV:
      return image::VideoSamples{frame.plane(0, 2), frame.plane(0, 4, 1), frame.plane(0, 4, 3), 8, 2, 1};
    case Format::Format_UYVY:
      return image::VideoSamples{frame.plane(0, 2, 1), frame.plane(0, 4), frame.plane(0, 4, 2), 8, 2, 1};
    case Format::Format_Y8:
      return image::VideoSamples{frame.plane(0), {}, {}, 8};
    case Format::Format_Y16:
      return image::VideoSamples{frame.plane(0), {}, {}, 16};
    default:
      return std::nullopt;
  }
}

/// That the frame holds what will be read of it. Throws: Error{format}.
void demandWhole(const Mapped& mapped, const QVideoFrame& frame, const image::VideoSamples& samples,
                 QSize size) {
  const int sample = samples.bits > 8 ? 2 : 1, planes = frame.planeCount();
  const auto coarse = [](int pixels, int coarser) { return (pixels + coarser - 1) / coarser; };
  const bool isPacked = planes == 1 && samples.blue.data != nullptr;  // in groups of two pixels
  mapped.demand(0, size.height(), isPacked ? 4 * coarse(size.width(), 2) : sample * size.width());
  for (int chroma = 1; chroma < planes && samples.blue.data != nullptr; ++chroma)
    mapped.demand(chroma, coarse(size.height(), samples.coarserY),
                  (planes == 2 ? 2 : 1) * sample * coarse(size.width(), samples.coarserX));
}

/// Of formats that QImage has in the opposite order of bytes alone: as these.
QImage reversed(const Mapped& mapped, QSize size) {
  mapped.demand(0, size.height(), 4 * size.width());
  const image::VideoSamples::Plane plane = mapped.plane(0);
  QImage picture(size, QImage::Format_RGBX8888);
  for (int y = 0; y < size.height(); ++y)
    qbswap<4>(static_cast<const uchar*>(plane.data) + static_cast<std::size_t>(y) * plane.bytesPerLine,
              size.width(), picture.scanLine(y));
  return picture;
}

/// As it is to be seen: telephones turn films by a note in the file.
QImage upright(const QImage& picture, const QVideoFrame& frame) {
#if QT_VERSION >= QT_VERSION_CHECK(6, 7, 0)
  int turned = static_cast<int>(frame.rotation());
#else
  int turned = static_cast<int>(frame.rotationAngle());
#endif
  QImage result = frame.mirrored() ? picture.mirrored(true, false) : picture;
  return turned % 360 == 0 ? result : result.transformed(QTransform().rotate(turned));
}

[[noreturn]] void refuseRange(const char* what) {
  throw Error(ErrorKind::input,
              RELUCENT_ENGLISH_MESSAGE("content.video-range-unsupported",
                                       "the video is {}, which projectors cannot show")
                  .with(what),
              RELUCENT_ENGLISH_MESSAGE("content.convert-to-bt-709",
                                       "convert it to BT.709 of standard dynamic range"));
}

}  // namespace

image::VideoEncoding encodingOf(const QVideoFrameFormat& format, bool jpeg) {
  image::VideoEncoding encoding;
  constexpr int linesOfHighDefinition = 720;
  if (format.colorSpace() == Format::ColorSpace_BT2020) refuseRange("made for BT.2020's colours");
  bool bt601 =
      format.colorSpace() == Format::ColorSpace_BT601 ||
      (format.colorSpace() == Format::ColorSpace_Undefined && format.frameHeight() < linesOfHighDefinition);
  encoding.matrix = bt601 ? image::VideoEncoding::Matrix::bt601 : image::VideoEncoding::Matrix::bt709;
  bool full = format.colorRange() == Format::ColorRange_Full;
  encoding.range = full ? image::VideoEncoding::Range::full : image::VideoEncoding::Range::video;
  switch (format.colorTransfer()) {
    case Format::ColorTransfer_ST2084:
    case Format::ColorTransfer_STD_B67:
      refuseRange("of high dynamic range");
    case Format::ColorTransfer_Linear:
      encoding.transfer = image::VideoEncoding::Transfer::linear;
      break;
    case Format::ColorTransfer_Gamma22:
      encoding.transfer = image::VideoEncoding::Transfer::gamma22;
      break;
    case Format::ColorTransfer_Gamma28:
      encoding.transfer = image::VideoEncoding::Transfer::gamma28;
      break;
    default:
      encoding.transfer =
          full || jpeg ? image::VideoEncoding::Transfer::srgb : image::VideoEncoding::Transfer::bt1886;
  }
  return encoding;
}

QImage pictureOf(const QVideoFrame& frame, bool jpeg) {
  Mapped mapped(frame);
  QVideoFrameFormat format = frame.surfaceFormat();
  QSize size = format.frameSize();
  std::optional<image::VideoSamples> samples = samplesOf(mapped, format.pixelFormat());
  if (format.pixelFormat() == Format::Format_XBGR8888 || format.pixelFormat() == Format::Format_ABGR8888)
    return upright(reversed(mapped, size), frame);
  if (!samples) {
    QImage::Format known = Format::imageFormatFromPixelFormat(format.pixelFormat());
    if (known == QImage::Format_Invalid)
      throw Error(
          ErrorKind::format,
          RELUCENT_ENGLISH_MESSAGE("content.video-samples-unknown",
                                   "the video's samples are of an unknown kind ({})")
              .with(Format::pixelFormatToString(format.pixelFormat()).toStdString()),
          RELUCENT_ENGLISH_MESSAGE("content.convert-to-h-264", "convert it to H.264 with 4:2:0 chroma"));
    mapped.demand(0, size.height(), size.width() * QImage::toPixelFormat(known).bitsPerPixel() / 8);
    image::VideoSamples::Plane plane = mapped.plane(0);
    QImage there(static_cast<const uchar*>(plane.data), size.width(), size.height(),
                 static_cast<qsizetype>(plane.bytesPerLine), known);
    // A copy: the frame's memory goes with it.
    return upright(there.convertToFormat(QImage::Format_RGBX8888).copy(), frame);
  }
  demandWhole(mapped, frame, *samples, size);
  QImage picture(size, QImage::Format_RGBX8888);
  image::srgbFromVideo(*samples, {size.width(), size.height()}, encodingOf(format, jpeg), picture.bits(),
                       static_cast<std::size_t>(picture.bytesPerLine()));
  return upright(picture, frame);
}

}  // namespace relucent::gui
