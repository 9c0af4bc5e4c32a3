// SPDX-License-Identifier: MIT
#include "content/stream_picture.h"

#include <QVideoFrameFormat>

#include "content/stream_failure.h"
#include "content/video_frame.h"
#include "relucent/image/video_colour.h"

extern "C" {
#include <libavutil/frame.h>
#include <libavutil/pixdesc.h>
}

namespace relucent::gui {
namespace {

using Format = QVideoFrameFormat;

Format::ColorSpace spaceOf(const AVFrame& frame) {
  switch (frame.colorspace) {
    case AVCOL_SPC_BT709:
      return Format::ColorSpace_BT709;
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M:
    case AVCOL_SPC_FCC:
      return Format::ColorSpace_BT601;
    case AVCOL_SPC_BT2020_NCL:
    case AVCOL_SPC_BT2020_CL:
      return Format::ColorSpace_BT2020;
    default:
      return Format::ColorSpace_Undefined;
  }
}

Format::ColorTransfer transferOf(const AVFrame& frame) {
  switch (frame.color_trc) {
    case AVCOL_TRC_SMPTE2084:
      return Format::ColorTransfer_ST2084;
    case AVCOL_TRC_ARIB_STD_B67:
      return Format::ColorTransfer_STD_B67;
    case AVCOL_TRC_LINEAR:
      return Format::ColorTransfer_Linear;
    case AVCOL_TRC_GAMMA22:
      return Format::ColorTransfer_Gamma22;
    case AVCOL_TRC_GAMMA28:
      return Format::ColorTransfer_Gamma28;
    default:
      return Format::ColorTransfer_Unknown;
  }
}

/// Formats whose full range is in their name, as JPEG's decoder has them.
bool isFullRange(const AVFrame& frame) {
  switch (frame.format) {
    case AV_PIX_FMT_YUVJ420P:
    case AV_PIX_FMT_YUVJ422P:
    case AV_PIX_FMT_YUVJ444P:
    case AV_PIX_FMT_YUVJ440P:
    case AV_PIX_FMT_YUVJ411P:
      return true;
    default:
      return frame.color_range == AVCOL_RANGE_JPEG;
  }
}

QVideoFrameFormat formatOf(const AVFrame& frame) {
  Format format(QSize(frame.width, frame.height), Format::Format_YUV420P);
  format.setColorSpace(spaceOf(frame));
  format.setColorTransfer(transferOf(frame));
  format.setColorRange(isFullRange(frame) ? Format::ColorRange_Full : Format::ColorRange_Video);
  return format;
}

image::VideoSamples samplesOf(const AVFrame& frame) {
  const AVPixFmtDescriptor* kind = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  constexpr std::uint64_t foreign = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_BE | AV_PIX_FMT_FLAG_PAL |
                                    AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL |
                                    AV_PIX_FMT_FLAG_FLOAT;
  if (kind == nullptr || (kind->flags & foreign) != 0) throw streamUnusable();
  // In words of one or two bytes; some have their bits at the upper end.
  const int bits = kind->comp[0].depth + kind->comp[0].shift;
  if (bits < 8 || bits > 16) throw streamUnusable();
  const int bytes = bits > 8 ? 2 : 1;
  const auto plane = [&](int number) -> image::VideoSamples::Plane {
    if (number >= kind->nb_components) return {};
    const AVComponentDescriptor& part = kind->comp[number];
    // Pictures that stand on their head are nobody's stream.
    if (frame.data[part.plane] == nullptr || frame.linesize[part.plane] <= 0) throw streamUnusable();
    return {frame.data[part.plane] + part.offset, static_cast<std::size_t>(frame.linesize[part.plane]),
            part.step / bytes};
  };
  if (kind->nb_components < 3) return {plane(0), {}, {}, bits};
  return {plane(0), plane(1), plane(2), bits, 1 << kind->log2_chroma_w, 1 << kind->log2_chroma_h};
}

}  // namespace

QImage pictureOf(const AVFrame& frame, bool jpeg) {
  const image::VideoSamples samples = samplesOf(frame);
  const image::VideoEncoding encoding = encodingOf(formatOf(frame), jpeg);
  QImage picture(frame.width, frame.height, QImage::Format_RGBX8888);
  if (picture.isNull()) throw std::bad_alloc();
  image::srgbFromVideo(samples, {frame.width, frame.height}, encoding, picture.bits(),
                       static_cast<std::size_t>(picture.bytesPerLine()));
  return picture;
}

}  // namespace relucent::gui
