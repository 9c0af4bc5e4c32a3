// SPDX-License-Identifier: MIT
#include "output/default_picture.h"

#include <QFile>
#include <QImage>

#include "relucent/base/file.h"
#include "relucent/base/require.h"
#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"

namespace relucent::gui {

QString defaultPicture() {
  return ":/pictures/demo.png";
}

std::filesystem::path pathOfPicture(const QString& picture, const std::filesystem::path& folder) {
  return picture.startsWith(':') ? folder / demonstrationCopy : std::filesystem::path(picture.toStdString());
}

std::filesystem::path pictureFile(const QString& picture, const std::filesystem::path& folder) {
  std::filesystem::path file = pathOfPicture(picture, folder);
  if (!picture.startsWith(':')) return file;
  QFile resource(picture);
  require(resource.open(QIODevice::ReadOnly), "the program's own picture is missing");
  createFolder(folder);
  writeFileAtomically(file, resource.readAll().toStdString());
  return file;
}

image::Image linearContentOf(const QString& file) {
  if (!file.startsWith(':')) return image::readLinearContent(file.toStdString());
  QImage image = QImage(file).convertToFormat(QImage::Format_RGB888);
  image::Image encoded(Size{image.width(), image.height()}, 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < 3 * image.width(); ++x)
      encoded.at(x / 3, y, x % 3) = static_cast<float>(image.constScanLine(y)[x]) / 255.0f;
  return image::srgbDecoded(encoded);
}

}  // namespace relucent::gui
