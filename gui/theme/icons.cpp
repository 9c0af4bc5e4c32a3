// SPDX-License-Identifier: MIT
#include "theme/icons.h"

#include <QFile>
#include <QGuiApplication>
#include <QPainterPath>
#include <QTemporaryDir>
#include <QTextStream>

namespace relucent {
namespace {

/// M move, L line, Q quadratic curve, C circle (centre, radius), R rectangle (place, size, corner radius), Z
/// close.
const char* strokesOf(Icon icon) {
  switch (icon) {
    case Icon::tick:
      return "M 5 12.5 L 10 17.5 L 19 7";
    case Icon::lock:
      return "R 6 11 12 9 2 M 8.5 11 L 8.5 8 Q 8.5 4.5 12 4.5 Q 15.5 4.5 15.5 8 L 15.5 11";
    case Icon::stale:
    case Icon::retry:
      return "M 19 12 Q 19 19 12 19 Q 5 19 5 12 Q 5 5 12 5 Q 16 5 18.5 8.5 M 19 4.5 L 18.7 8.8 L 14.5 8.6";
    case Icon::failed:
      return "M 8.5 3.5 L 15.5 3.5 L 20.5 8.5 L 20.5 15.5 L 15.5 20.5 L 8.5 20.5 L 3.5 15.5 L 3.5 8.5 Z M 12 "
             "8 L 12 "
             "12.5 M 12 16 L 12 16.2";
    case Icon::back:
      return "M 14.5 6 L 8.5 12 L 14.5 18";
    case Icon::next:
      return "M 9.5 6 L 15.5 12 L 9.5 18";
    case Icon::play:
      return "M 7.5 5 L 18.5 12 L 7.5 19 Z";
    case Icon::pause:
      return "M 9 5.5 L 9 18.5 M 15 5.5 L 15 18.5";
    case Icon::save:
      return "M 5 5 L 16 5 L 19 8 L 19 19 L 5 19 Z M 8 5 L 8 9.5 L 15 9.5 L 15 5 M 8 19 L 8 14 L 16 14 L 16 "
             "19";
    case Icon::stop:
      return "R 6 6 12 12 1.5";
    case Icon::folder:
      return "M 3.5 18.5 L 3.5 6 L 9.5 6 L 11.5 8.5 L 20.5 8.5 L 20.5 18.5 Z";
    case Icon::plus:
      return "M 12 4.5 L 12 19.5 M 4.5 12 L 19.5 12";
    case Icon::moon:
      return "M 19.5 14.5 Q 17.5 15.5 15.5 15 Q 9.5 13.5 9 8 Q 9 6 10 4 Q 4 6 4 12 Q 4 20 12 20 Q 17.5 20 "
             "19.5 14.5";
    case Icon::settings:
      return "M 4 7 L 13 7 M 17.5 7 L 20 7 C 15.2 7 2.2 M 4 12 L 6 12 M 10.5 12 L 20 12 C 8.2 12 2.2 M 4 17 "
             "L 12 17 M "
             "16.5 17 L 20 17 C 14.2 17 2.2";
    case Icon::help:
      return "C 12 12 8.5 M 9.5 9.7 Q 9.7 7.3 12 7.3 Q 14.5 7.3 14.5 9.6 Q 14.5 11.2 12 12.4 L 12 13.6 M 12 "
             "16.6 L 12 "
             "16.8";
    case Icon::projector:
      return "R 3 8 18 9 2 C 15.5 12.5 2.5 M 6 11 L 9 11 M 6 14 L 9 14 M 6 17 L 6 19 M 18 17 L 18 19";
    case Icon::camera:
      return "M 3.5 8 L 7.5 8 L 9 5.5 L 15 5.5 L 16.5 8 L 20.5 8 L 20.5 19 L 3.5 19 Z C 12 13.2 3.4";
    case Icon::disk:
      return "M 5 6.5 Q 5 4 12 4 Q 19 4 19 6.5 Q 19 9 12 9 Q 5 9 5 6.5 L 5 17.5 Q 5 20 12 20 Q 19 20 19 17.5 "
             "L 19 6.5 "
             "M 5 12 Q 5 14.5 12 14.5 Q 19 14.5 19 12";
    case Icon::sun:
      return "C 12 12 3.6 M 12 3 L 12 5 M 12 19 L 12 21 M 3 12 L 5 12 M 19 12 L 21 12 M 5.6 5.6 L 7 7 M 17 "
             "17 L 18.4 "
             "18.4 M 18.4 5.6 L 17 7 M 7 17 L 5.6 18.4";
    case Icon::information:
      return "C 12 12 8.5 M 12 11 L 12 16.5 M 12 7.7 L 12 7.9";
    case Icon::warning:
      return "M 12 4 L 21 19.5 L 3 19.5 Z M 12 10 L 12 14 M 12 16.8 L 12 17";
    case Icon::clock:
      return "C 12 12 8.5 M 12 7 L 12 12 L 15.5 14";
    case Icon::picture:
      return "R 3.5 5 17 14 2 C 8.5 9.5 1.5 M 4 17 L 9.5 12.5 L 13 15.5 L 16 13 L 20 16.5";
    case Icon::pulse:
      return "M 3 12 L 7.5 12 L 10 6 L 14 18 L 16.5 12 L 21 12";
    case Icon::fit:
      return "M 4.5 9 L 4.5 4.5 L 9 4.5 M 15 4.5 L 19.5 4.5 L 19.5 9 M 19.5 15 L 19.5 19.5 L 15 19.5 M 9 "
             "19.5 L 4.5 "
             "19.5 L 4.5 15";
    case Icon::actualSize:
      return "R 4 4 16 16 2 R 10 10 4 4 0";
    case Icon::pick:
      return "C 12 12 4.5 M 12 3 L 12 9 M 12 15 L 12 21 M 3 12 L 9 12 M 15 12 L 21 12";
    case Icon::monitor:
      return "R 3.5 4.5 17 12 2 M 12 16.5 L 12 19.5 M 8.5 19.5 L 15.5 19.5";
    case Icon::house:
      return "M 4 19.5 L 4 10.5 L 12 4 L 20 10.5 L 20 19.5 Z M 9.5 19.5 L 9.5 13.5 L 14.5 13.5 L 14.5 19.5";
    case Icon::black:
      return "R 4 5 16 14 2 M 4.5 18.5 L 19.5 5.5";
    case Icon::compare:
      return "R 4 5 16 14 2 M 12 3 L 12 21";
    case Icon::power:
      return "M 12 3.5 L 12 11 M 7.5 6.5 Q 4.5 9 4.5 12.8 Q 4.5 20 12 20 Q 19.5 20 19.5 12.8 Q 19.5 9 16.5 "
             "6.5";
    case Icon::film:
      return "R 4 5 16 14 2 M 8 5 L 8 19 M 16 5 L 16 19 M 8 12 L 16 12 M 4 9.5 L 8 9.5 M 4 14.5 L 8 14.5 M "
             "16 9.5 L 20 9.5 M 16 14.5 L 20 14.5";
    case Icon::up:
      return "M 6 14.5 L 12 8.5 L 18 14.5";
    case Icon::down:
      return "M 6 9.5 L 12 15.5 L 18 9.5";
    case Icon::remove:
      return "M 6.5 6.5 L 17.5 17.5 M 17.5 6.5 L 6.5 17.5";
    case Icon::report:
      return "M 6 3.5 L 14.5 3.5 L 18.5 7.5 L 18.5 20.5 L 6 20.5 Z M 9 10 L 15.5 10 M 9 13.5 L 15.5 13.5 M 9 "
             "17 L 13 17";
    case Icon::drift:
      return "M 4.5 6 L 4.5 18 M 8 12 L 20 12 M 15.5 7.5 L 20 12 L 15.5 16.5";
  }
  return "";
}

QPainterPath pathOf(Icon icon) {
  QPainterPath path;
  QString strokes = QString::fromLatin1(strokesOf(icon));
  QTextStream stream(&strokes);
  auto number = [&] {
    double value = 0.0;
    stream >> value;
    return value;
  };
  auto point = [&] {
    double x = number();
    return QPointF(x, number());
  };
  for (QString command; !(stream >> command, command.isEmpty()); command.clear()) {
    if (command == "M") {
      path.moveTo(point());
    } else if (command == "L") {
      path.lineTo(point());
    } else if (command == "Q") {
      QPointF control = point();
      path.quadTo(control, point());
    } else if (command == "C") {
      QPointF centre = point();
      double radius = number();
      path.addEllipse(centre, radius, radius);
    } else if (command == "R") {
      QPointF place = point(), size = point();
      double radius = number();
      path.addRoundedRect(QRectF(place, QSizeF(size.x(), size.y())), radius, radius);
    } else {
      path.closeSubpath();
    }
  }
  return path;
}

}  // namespace

void drawIcon(QPainter& painter, Icon icon, const QRectF& square, const QColor& colour) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(square.topLeft());
  painter.scale(square.width() / 24.0, square.height() / 24.0);
  painter.setPen(QPen(colour, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(pathOf(icon));
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

}  // namespace relucent
