// SPDX-License-Identifier: MIT
#include "theme/icons.h"

#include <QFile>
#include <QGuiApplication>
#include <QSvgRenderer>
#include <QTemporaryDir>
#include <array>

namespace relucent::gui {
namespace {

/// Of the icons' files in resources/icons/controls, in the order of the enumeration.
constexpr std::array fileNames{
    "tick",      "lock",   "retry",       "failed", "back",        "next",    "play",     "pause",
    "save",      "stop",   "retry",       "folder", "plus",        "moon",    "settings", "help",
    "projector", "camera", "disk",        "sun",    "information", "warning", "clock",    "picture",
    "pulse",     "fit",    "actual-size", "pick",   "monitor",     "house",   "black",    "compare",
    "power",     "film",   "up",          "down",   "remove",      "report",  "drift"};
static_assert(fileNames.size() == static_cast<std::size_t>(Icon::drift) + 1);

/// The drawing, whose strokes are of `currentColor`, in a colour.
QByteArray drawingOf(Icon icon, const QColor& colour) {
  const char* name = fileNames[static_cast<std::size_t>(icon)];
  QFile file(QString(":/icons/controls/%1.svg").arg(name));
  if (!file.open(QIODevice::ReadOnly)) qFatal("the program was built without the icon %s", name);
  return file.readAll().replace("currentColor", colour.name().toLatin1());
}

}  // namespace

void drawIcon(QPainter& painter, Icon icon, const QRectF& square, const QColor& colour) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setOpacity(painter.opacity() * colour.alphaF());
  QSvgRenderer(drawingOf(icon, colour)).render(&painter, square);
  painter.restore();
}

QPixmap pixmapOf(Icon icon, const QColor& colour, int side, double devicePixelRatio) {
  QPixmap pixmap(QSize(side, side) * devicePixelRatio);
  pixmap.setDevicePixelRatio(devicePixelRatio);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  drawIcon(painter, icon, QRectF(0, 0, side, side), colour);
  return pixmap;
}

QString iconFile(Icon icon, const QColor& colour, int side) {
  static const QTemporaryDir folder;
  QString name =
      folder.filePath(QString("%1-%2-%3").arg(static_cast<int>(icon)).arg(colour.name().mid(1)).arg(side));
  if (QFile::exists(name + ".png")) return name + ".png";
  for (auto [ending, ratio] : {std::pair(".png", 1), std::pair("@2x.png", 2), std::pair("@3x.png", 3)}) {
    QImage image(QSize(side, side) * ratio, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    drawIcon(painter, icon, image.rect(), colour);
    painter.end();
    image.save(name + ending);
  }
  return name + ".png";
}

QIcon iconOf(Icon icon, const QColor& colour) {
  if (QGuiApplication::isRightToLeft())
    icon = icon == Icon::back ? Icon::next : icon == Icon::next ? Icon::back : icon;
  QIcon result;
  for (double ratio : {1.0, 2.0, 3.0}) result.addPixmap(pixmapOf(icon, colour, 18, ratio));
  return result;
}

}  // namespace relucent::gui
