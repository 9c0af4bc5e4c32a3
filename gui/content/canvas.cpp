// SPDX-License-Identifier: MIT
#include "content/canvas.h"

#include <QColorSpace>
#include <QFile>
#include <QFileInfo>
#include <QImageReader>
#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/content_identity.h"
#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"

namespace relucent::gui {
namespace {

constexpr QImage::Format encodedFormat = QImage::Format_RGBX8888;
constexpr QImage::Format linearFormat = QImage::Format_RGBX32FPx4;

QImage linearFrom(const image::Image& image) {
  QImage picture(image.width(), image.height(), linearFormat);
  parallelFor(0, static_cast<std::size_t>(image.height()), 16, [&](std::size_t y) {
    auto* line = reinterpret_cast<float*>(picture.scanLine(static_cast<int>(y)));
    for (int x = 0; x < image.width(); ++x) {
      for (int c = 0; c < 3; ++c) line[4 * x + c] = image.at(x, static_cast<int>(y), c);
      line[4 * x + 3] = 1.0f;
    }
  });
  picture.setColorSpace(QColorSpace::SRgbLinear);
  return picture;
}

/// Files with more than Qt knows: float samples, and TIFF, for which Qt needs a plug-in.
bool isForCore(const QString& file) {
  QString ending = QFileInfo(file).suffix().toLower();
  return ending == "exr" || ending == "tif" || ending == "tiff";
}

QImage encodedFrom(const QImage& image) {
  QImage picture = image;
  if (picture.colorSpace().isValid() && picture.colorSpace() != QColorSpace(QColorSpace::SRgb))
    picture.convertToColorSpace(QColorSpace::SRgb);
  if (picture.hasAlphaChannel()) {
    QImage opaque(picture.size(), QImage::Format_RGB32);
    opaque.fill(Qt::black);
    QPainter(&opaque).drawImage(0, 0, picture);
    picture = opaque;
  }
  return picture.convertToFormat(encodedFormat);
}

/// sRGB codes to light, and back to the nearest code: a table over the square root of light is at most one
/// code too low, which the light half-way to the next one tells.
class Tables {
 public:
  Tables() {
    for (std::size_t i = 0; i < light_.size(); ++i) {
      light_[i] = static_cast<float>(image::srgbDecode(static_cast<double>(i) / 255.0));
      halfWay_[i] = static_cast<float>(image::srgbDecode((static_cast<double>(i) + 0.5) / 255.0));
    }
    for (std::size_t i = 0; i < code_.size(); ++i) {
      double root = static_cast<double>(i) / steps;
      code_[i] = static_cast<std::uint8_t>(std::lround(255.0 * image::srgbEncode(root * root)));
    }
  }
  float light(std::uint8_t code) const { return light_[code]; }
  /// Of light between 0 and 1.
  std::uint8_t code(float light) const {
    std::uint8_t low = code_[static_cast<std::size_t>(std::sqrt(light) * steps)];
    return low < 255 && light >= halfWay_[low] ? static_cast<std::uint8_t>(low + 1) : low;
  }

 private:
  static constexpr int steps = 4096;
  std::array<float, 256> light_{}, halfWay_{};
  std::array<std::uint8_t, steps + 1> code_{};
};
const Tables& tables() {
  static const Tables made;
  return made;
}

/// Linear light of one line, three values a pixel.
void readLine(const QImage& picture, int y, std::vector<float>& line) {
  line.resize(3 * static_cast<std::size_t>(picture.width()));
  for (std::size_t x = 0; x < line.size() / 3; ++x)
    for (std::size_t c = 0; c < 3; ++c)
      line[3 * x + c] = picture.format() == linearFormat
                            ? reinterpret_cast<const float*>(picture.constScanLine(y))[4 * x + c]
                            : tables().light(picture.constScanLine(y)[4 * x + c]);
}

}  // namespace

QImage readContent(const QString& file) {
  if (isForCore(file)) return linearFrom(image::readLinearContent(file.toStdString()));
  if (QFile probe(file); !probe.open(QIODevice::ReadOnly))
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("disk.cannot-read", "cannot read ({})").with(probe.errorString().toStdString()),
        RELUCENT_MESSAGE("disk.check-path-and-disk", "check the path and the disk"), file.toStdString());
  QImageReader reader(file);
  reader.setAutoTransform(true);
  reader.setDecideFormatFromContent(true);
  QImage image = reader.read();
  if (image.isNull())
    throw Error(
        ErrorKind::format, RELUCENT_MESSAGE("content.picture-unreadable", "not a picture that can be read"),
        RELUCENT_MESSAGE("content.choose-supported-picture", "choose a PNG, JPEG, TIFF or EXR picture"),
        file.toStdString());
  return encodedFrom(image);
}

QImage blackOn(const Canvas& canvas) {
  QImage black(canvas.size, QImage::Format_RGBX8888);
  black.fill(Qt::black);
  return black;
}

QImage onCanvas(const QImage& picture, const Canvas& canvas) {
  require(!picture.isNull() && !canvas.size.isEmpty(), "an empty picture or canvas");
  Qt::AspectRatioMode mode = canvas.fit == compensation::Fit::fill  ? Qt::IgnoreAspectRatio
                             : canvas.fit == compensation::Fit::fit ? Qt::KeepAspectRatio
                                                                    : Qt::KeepAspectRatioByExpanding;
  QSize scaledSize = picture.size().scaled(canvas.size, mode).expandedTo({1, 1});
  QImage scaled = picture.size() == scaledSize
                      ? picture
                      : picture.scaled(scaledSize, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                            .convertToFormat(picture.format());
  if (scaledSize == canvas.size) return scaled;
  // QImage::copy() fills what lies outside with zeros: black.
  return scaled.copy(QRect(QPoint((scaledSize.width() - canvas.size.width()) / 2,
                                  (scaledSize.height() - canvas.size.height()) / 2),
                           canvas.size));
}

std::string identityOf(const QString& file, QSize picture, const Canvas& canvas) {
  QFile bytes(file);  // of the program's own too
  if (!bytes.open(QIODevice::ReadOnly)) return {};
  return compensation::contentIdentity(bytes.readAll().toStdString(), {picture.width(), picture.height()},
                                       {{canvas.size.width(), canvas.size.height()}, canvas.fit});
}

QImage crossFaded(const QImage& from, const QImage& to, double share) {
  require(from.size() == to.size(), "pictures of {}x{} and {}x{} cannot be mixed", from.width(),
          from.height(), to.width(), to.height());
  auto late = static_cast<float>(std::clamp(share, 0.0, 1.0));
  QImage mixed(from.size(), encodedFormat);
  uchar* bits = mixed.bits();
  qsizetype stride = mixed.bytesPerLine();
  parallelFor(0, static_cast<std::size_t>(from.height()), 16, [&](std::size_t row) {
    int y = static_cast<int>(row);
    std::vector<float> a, b;
    readLine(from, y, a);
    readLine(to, y, b);
    uchar* line = bits + y * stride;
    for (std::size_t x = 0; x < a.size() / 3; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        float light = std::clamp((1.0f - late) * a[3 * x + c] + late * b[3 * x + c], 0.0f, 1.0f);
        line[4 * x + c] = tables().code(light);
      }
      line[4 * x + 3] = 255;
    }
  });
  return mixed;
}

}  // namespace relucent::gui
