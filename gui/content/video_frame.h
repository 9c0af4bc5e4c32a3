// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QVideoFrame>

#include "relucent/image/video_colour.h"

namespace relucent::gui {

/// Encoding of a frame; where the file does not state it: BT.709 from 720 lines on, below BT.601; video
/// range; light as BT.1886 has it, at full range and for JPEG pictures as sRGB. `jpeg`: the frame is such a
/// picture; Qt from 6.5 on converts these to video range without saying so. Throws: Error{input} for
/// unsupported encodings: high dynamic range and BT.2020.
image::VideoEncoding encodingOf(const QVideoFrameFormat& format, bool jpeg = false);

/// A frame's light as sRGB codes, upright, Format_RGBX8888.
/// Throws: as encodingOf(); Error{format} for unknown sample formats or memory that cannot be mapped.
QImage pictureOf(const QVideoFrame& frame, bool jpeg = false);

}  // namespace relucent::gui
