// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QVideoFrame>

#include "image/video_colour.h"

namespace relucent {

/// What a frame's numbers mean, where the file does not say: BT.709 from 720 lines on, below BT.601; video
/// range; light as BT.1886 has it, at full range and for JPEG pictures as sRGB. `jpeg`: they are such
/// pictures; Qt from 6.5 on brings these to video range and says nothing of it. Throws: Error{input} for what
/// no projector of ours can show: high dynamic range and BT.2020.
VideoEncoding encodingOf(const QVideoFrameFormat& format, bool jpeg = false);

/// A frame's light as sRGB codes, upright, Format_RGBX8888.
/// Throws: as encodingOf(); Error{format} for samples of an unknown kind or memory that cannot be reached.
QImage pictureOf(const QVideoFrame& frame, bool jpeg = false);

}  // namespace relucent
