// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QRandomGenerator>

namespace relucent::test {

/// Every pixel another colour.
inline QImage noise(QSize size, quint32 seed) {
  QImage image(size, QImage::Format_RGB32);
  QRandomGenerator random(seed);
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width(); ++x) image.setPixel(x, y, random.generate() | 0xff000000u);
  return image;
}

}  // namespace relucent::test
