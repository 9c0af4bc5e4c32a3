// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/compensation/placement.h"

namespace relucent::compensation {

/// A size to which content is brought before it is compensated.
struct ContentCanvas {
  Size size{};  // 0x0: the content's own
  Fit fit = Fit::fit;
};
/// Pixels of a canvas' sides.
inline constexpr int leastCanvasSide = 8, mostCanvasSide = 8192;
std::vector<Message> problems(const ContentCanvas& canvas);

/// Which picture it is, and how it lies on a canvas: the same for every copy of a file, and for every size of
/// canvas that has the shape of the picture. `file`: all its bytes.
std::string contentIdentity(std::string_view file, Size picture, const ContentCanvas& canvas);

/// The picture brought to the canvas; bars are black.  Shapes: three channels.
image::Image onCanvas(const image::Image& picture, const ContentCanvas& canvas);

}  // namespace relucent::compensation
