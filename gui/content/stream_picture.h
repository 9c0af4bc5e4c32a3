// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>

struct AVFrame;

namespace relucent::gui {

/// The light of a decoded frame as sRGB codes, Format_RGBX8888; see encodingOf(). `jpeg`: it is such a
/// picture. Throws: as encodingOf(); Error{format} for samples that are not luma and chroma of 8 to 16 bits.
QImage pictureOf(const AVFrame& frame, bool jpeg);

}  // namespace relucent::gui
