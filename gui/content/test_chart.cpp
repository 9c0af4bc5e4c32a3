// SPDX-License-Identifier: MIT
#include "content/test_chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "content/still_image.h"
#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::gui {
namespace {

constexpr std::array names{std::pair{TestChart::grid, "grid"},
                           std::pair{TestChart::ramps, "ramps"},
                           std::pair{TestChart::resolution, "resolution"},
                           std::pair{TestChart::patches, "patches"},
                           std::pair{TestChart::checker, "checker"},
                           std::pair{TestChart::white, "white"}};

constexpr QRgb black = qRgb(0, 0, 0), white = qRgb(255, 255, 255);

/// Sixteen squares fit across.
int squareOf(QSize size) {
  return std::max(2, size.width() / 16);
}

QRgb grid(QPoint p, QSize size) {
  int square = squareOf(size);
  bool border = p.x() == 0 || p.y() == 0 || p.x() == size.width() - 1 || p.y() == size.height() - 1;
  bool line = p.x() % square == 0 || p.y() % square == 0;
  // From the centre, in half pixels, so that both halves mirror each other.
  double x = 2 * p.x() + 1 - size.width(), y = 2 * p.y() + 1 - size.height();
  double radius = 0.9 * std::min(size.width(), size.height());
  bool circle = std::abs(std::hypot(x, y) - radius) < 1.5;
  bool diagonal = std::abs(std::abs(x) * size.height() - std::abs(y) * size.width()) <
                  std::max(size.width(), size.height());
  return border || line || circle || diagonal ? white : black;
}

QRgb ramps(QPoint p, QSize size) {
  int band = 5 * p.y() / size.height();
  int code = size.width() > 1 ? (255 * p.x() + (size.width() - 1) / 2) / (size.width() - 1) : 255;
  switch (band) {
    case 1:
      return qRgb(code, 0, 0);
    case 2:
      return qRgb(0, code, 0);
    case 3:
      return qRgb(0, 0, code);
    case 4:
      code = 17 * (16 * p.x() / size.width());
      break;
    default:
      break;
  }
  return qRgb(code, code, code);
}

QRgb resolution(QPoint p, QSize size) {
  int width = 1 << (4 * p.x() / size.width());
  bool upright = 2 * p.y() < size.height();
  return (upright ? p.x() : p.y()) / width % 2 == 0 ? white : black;
}

QRgb patches(QPoint p, QSize size) {
  constexpr std::array full{qRgb(255, 0, 0),   qRgb(0, 255, 0),   qRgb(0, 0, 255),
                            qRgb(0, 255, 255), qRgb(255, 0, 255), qRgb(255, 255, 0)};
  int column = 6 * p.x() / size.width(), row = 4 * p.y() / size.height();
  if (row == 3) return qRgb(51 * column, 51 * column, 51 * column);
  QRgb colour = full[static_cast<std::size_t>(column)];
  // Half the light is code 188; pale is half the light and half of white.
  auto channel = [&](int value) {
    return row == 0 ? value : row == 1 ? (value > 0 ? 188 : 0) : std::max(value, 188);
  };
  return qRgb(channel(qRed(colour)), channel(qGreen(colour)), channel(qBlue(colour)));
}

QRgb checker(QPoint p, QSize size) {
  int square = squareOf(size);
  return (p.x() / square + p.y() / square) % 2 == 0 ? white : black;
}

QRgb colourOf(TestChart chart, QPoint p, QSize size) {
  switch (chart) {
    case TestChart::grid:
      return grid(p, size);
    case TestChart::ramps:
      return ramps(p, size);
    case TestChart::resolution:
      return resolution(p, size);
    case TestChart::patches:
      return patches(p, size);
    case TestChart::checker:
      return checker(p, size);
    case TestChart::white:
      return white;
  }
  return black;
}

}  // namespace

QString testChartName(TestChart chart) {
  return std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.first == chart; })->second;
}

std::optional<TestChart> testChartFromName(const QString& name) {
  for (const auto& [chart, known] : names)
    if (name == known) return chart;
  return std::nullopt;
}

QImage drawn(TestChart chart, QSize size) {
  require(!size.isEmpty(), "a test chart of {}x{} pixels", size.width(), size.height());
  QImage picture(size, QImage::Format_RGBX8888);
  uchar* bits = picture.bits();
  qsizetype stride = picture.bytesPerLine();
  parallelFor(0, static_cast<std::size_t>(size.height()), 16, [&](std::size_t row) {
    int y = static_cast<int>(row);
    uchar* line = bits + y * stride;
    for (int x = 0; x < size.width(); ++x, line += 4) {
      QRgb colour = colourOf(chart, {x, y}, size);
      line[0] = static_cast<uchar>(qRed(colour));
      line[1] = static_cast<uchar>(qGreen(colour));
      line[2] = static_cast<uchar>(qBlue(colour));
      line[3] = 255;
    }
  });
  return picture;
}

ContentPicture TestChartContent::at(ContentTime) {
  if (frame_.image.isNull()) frame_ = {drawn(chart_, size_), nextFrameNumber()};
  return frame_;
}

}  // namespace relucent::gui
