// SPDX-License-Identifier: MIT
#include "handover/report_chart.h"

#include <QPainter>
#include <QPainterPath>
#include <QRegularExpression>

namespace relucent::gui {
namespace {

struct Look {
  QPen pen = Qt::NoPen;
  QBrush brush = Qt::NoBrush;
};

QColor withAlpha(const char* name, double alpha) {
  QColor color(name);
  color.setAlphaF(static_cast<float>(alpha));
  return color;
}

/// The report's style sheet as it is on paper.
Look lookOf(const QXmlStreamAttributes& attributes) {
  QString style = attributes.value("class").toString();
  if (style.startsWith("c0")) return {QPen(QColor("#b5382e"), 1.6)};
  if (style.startsWith("c1")) return {QPen(QColor("#2f7a4a"), 1.6)};
  if (style.startsWith("c2")) return {QPen(QColor("#2a5fa8"), 1.6)};
  if (style == "grid") return {QPen(QColor("#c8c0b8"), 1.0)};
  if (style == "axis") return {QPen(QColor("#444444"), 1.0)};
  if (style == "bar accent") return {Qt::NoPen, QColor("#c0602a")};
  if (style == "bar") return {Qt::NoPen, QColor("#9a9088")};
  if (style == "before") return {QPen(QColor("#2a5fa8"), 1.0), withAlpha("#2a5fa8", 0.35)};
  if (style == "after") return {QPen(QColor("#c0602a"), 1.0), withAlpha("#c0602a", 0.45)};
  return {Qt::NoPen, QColor(attributes.value("fill").toString())};
}

/// Of the commands M, L, H, V, Z and their relative forms.
QPainterPath pathOf(const QString& data) {
  static const QRegularExpression part(R"(([MLHVZmlhvz])([^MLHVZmlhvz]*))");
  static const QRegularExpression number(R"(-?[0-9]*\.?[0-9]+)");
  QPainterPath path;
  QPointF at;
  for (auto parts = part.globalMatch(data); parts.hasNext();) {
    auto match = parts.next();
    QChar command = match.captured(1).at(0);
    QList<double> n;
    for (auto numbers = number.globalMatch(match.captured(2)); numbers.hasNext();)
      n << numbers.next().captured().toDouble();
    QPointF from = command.isLower() ? at : QPointF();
    switch (command.toUpper().toLatin1()) {
      case 'Z':
        path.closeSubpath();
        break;
      case 'H':
        if (!n.isEmpty()) path.lineTo(at = {from.x() + n[0], at.y()});
        break;
      case 'V':
        if (!n.isEmpty()) path.lineTo(at = {at.x(), from.y() + n[0]});
        break;
      default:
        for (qsizetype i = 0; i + 1 < n.size(); i += 2) {
          at = (command.isLower() ? at : QPointF()) + QPointF(n[i], n[i + 1]);
          i == 0 && command.toUpper() == 'M' ? path.moveTo(at) : path.lineTo(at);
        }
    }
  }
  return path;
}

void drawText(QPainter& painter, const QXmlStreamAttributes& attributes, const QString& text) {
  auto number = [&](const char* name) { return attributes.value(name).toDouble(); };
  QString anchor = attributes.value("text-anchor").toString();
  double width = QFontMetricsF(painter.font(), painter.device()).horizontalAdvance(text);
  double share = anchor == "end" ? 1.0 : anchor == "middle" ? 0.5 : 0.0;
  painter.setPen(QColor("#222222"));
  painter.drawText(QPointF(number("x") - share * width, number("y")), text);
}

void draw(QPainter& painter, QXmlStreamReader& xml) {
  QXmlStreamAttributes attributes = xml.attributes();
  QString name = xml.name().toString();
  auto number = [&](const char* key) { return attributes.value(key).toDouble(); };
  Look look = lookOf(attributes);
  painter.setPen(look.pen);
  painter.setBrush(look.brush);
  if (name == "line")
    painter.drawLine(QPointF(number("x1"), number("y1")), QPointF(number("x2"), number("y2")));
  else if (name == "rect")
    painter.drawRoundedRect(QRectF(number("x"), number("y"), number("width"), number("height")), number("rx"),
                            number("rx"));
  else if (name == "circle")
    painter.drawEllipse(QPointF(number("cx"), number("cy")), number("r"), number("r"));
  else if (name == "path")
    painter.drawPath(pathOf(attributes.value("d").toString()));
  else if (name == "text")
    drawText(painter, attributes, xml.readElementText());
}

}  // namespace

QImage chartOf(QXmlStreamReader& xml, double dots) {
  QStringList box = xml.attributes().value("viewBox").toString().split(' ');
  QSizeF size(box.value(2).toDouble(), box.value(3).toDouble());
  QImage image((size * dots).toSize().expandedTo({1, 1}).boundedTo({8192, 8192}), QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(dots, dots);
  QFont font(QStringList{"Inter", "Noto Sans"});
  font.setPixelSize(12);
  painter.setFont(font);
  while (!xml.atEnd()) {
    auto token = xml.readNext();
    if (token == QXmlStreamReader::StartElement) draw(painter, xml);
    if (token == QXmlStreamReader::EndElement && xml.name() == u"svg") break;
  }
  return image;
}

}  // namespace relucent::gui
