// SPDX-License-Identifier: MIT
#include "content/still_image.h"

#include <atomic>

namespace relucent::gui {

std::uint64_t nextFrameNumber() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

StillImage::StillImage(const QString& file, const Canvas& canvas) {
  const QImage picture = readContent(file);
  frame_ = {onCanvas(picture, canvas), nextFrameNumber(), identityOf(file, picture.size(), canvas)};
}

StillImage::StillImage(const QImage& picture, const Canvas& canvas)
    : frame_{onCanvas(picture, canvas), nextFrameNumber()} {}

}  // namespace relucent::gui
