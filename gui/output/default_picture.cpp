// SPDX-License-Identifier: MIT
#include "output/default_picture.h"

#include <QImage>

#include "image/colour.h"
#include "image/picture_files.h"

namespace relucent {

QString defaultPicture() {
  return ":/pictures/demo.png";
}

Image linearContentOf(const QString& file) {
  if (!file.startsWith(':')) return readLinearContent(file.toStdString());
  QImage image = QImage(file).convertToFormat(QImage::Format_RGB888);
  Image encoded(Size{image.width(), image.height()}, 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < 3 * image.width(); ++x)
      encoded.at(x / 3, y, x % 3) = static_cast<float>(image.constScanLine(y)[x]) / 255.0f;
  return srgbDecoded(encoded);
}

}  // namespace relucent
