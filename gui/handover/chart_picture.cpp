// SPDX-License-Identifier: MIT
#include "handover/chart_picture.h"

#include <QPainter>
#include <QSvgRenderer>
#include <QXmlStreamWriter>

namespace relucent::gui {
namespace {

/// The classes of core/charts/svg.h as they are on paper.
constexpr const char* paperStyle =
    "text{font-family:Inter,'Noto Sans';font-size:12px;fill:#222222}"
    ".red{stroke:#b5382e}.green{stroke:#2f7a4a}.blue{stroke:#2a5fa8}"
    ".red,.green,.blue{fill:none;stroke-width:1.6}.point{fill:#ffffff}"
    ".grid{stroke:#c8c0b8}.axis{stroke:#444444}.bar{fill:#9a9088}.accent{fill:#c0602a}"
    ".before{stroke:#2a5fa8;fill:#2a5fa8;fill-opacity:0.35}"
    ".after{stroke:#c0602a;fill:#c0602a;fill-opacity:0.45}";

}  // namespace

QImage chartPicture(QXmlStreamReader& xml, double dots) {
  QByteArray svg;
  QXmlStreamWriter writer(&svg);
  writer.writeCurrentToken(xml);
  writer.writeTextElement("style", paperStyle);
  while (!(xml.isEndElement() && xml.name() == u"svg") && !xml.atEnd()) {
    xml.readNext();
    if (!xml.hasError()) writer.writeCurrentToken(xml);
  }
  QSvgRenderer chart(svg);
  QSize size = (chart.viewBoxF().size() * dots).toSize();
  QImage image(size.expandedTo({1, 1}).boundedTo({8192, 8192}), QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.setFont(QFont("Inter", 10));  // in points: views/chart_drawing.cpp says why
  chart.render(&painter);
  return image;
}

}  // namespace relucent::gui
