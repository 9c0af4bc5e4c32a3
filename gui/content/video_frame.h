// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QVideoFrame>

#include "image/video_color.h"

namespace relucent {

/// What a frame's numbers mean, where the file does not say: BT.709 from 720 lines on, below BT.601; video
/// range; light as BT.1886 has it, at full range (JPEG's) as sRGB.
/// Throws: Error{input} for what no projector of ours can show: high dynamic range and BT.2020.
VideoEncoding encodingOf(const QVideoFrameFormat& format);

/// A frame's light as sRGB codes, upright, Format_RGBX8888.
/// Throws: as encodingOf(); Error{format} for samples of an unknown kind or memory that cannot be reached.
QImage pictureOf(const QVideoFrame& frame);

}  // namespace relucent
