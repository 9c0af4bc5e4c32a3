// SPDX-License-Identifier: MIT
#include "handover/report_pdf.h"

#include <QFile>
#include <QPageSize>
#include <QPdfWriter>
#include <QRegularExpression>
#include <QTextDocument>
#include <QXmlStreamReader>
#include <cmath>

#include "handover/chart_picture.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::gui {
namespace {

/// Qt's text documents know tables and no grids, pictures by name and no drawings: the report said so.
class Paper {
 public:
  Paper(QXmlStreamReader& xml, QTextDocument& document) : xml_(xml), document_(document) {}

  QString text() {
    while (!xml_.atEnd()) {
      switch (xml_.readNext()) {
        case QXmlStreamReader::StartElement:
          begin(xml_.name().toString(), xml_.attributes().value("class").toString());
          break;
        case QXmlStreamReader::EndElement:
          end(xml_.name().toString());
          break;
        case QXmlStreamReader::Characters:
          out_ += xml_.text().toString().toHtmlEscaped();
          break;
        default:
          break;
      }
    }
    return out_;
  }

 private:
  struct Open {
    QString end;          // what closes it
    int columns = 0;      // a grid
    int cells = 0;        // of it, so far
    double width = 640;   // of what stands in it, at 96 dots an inch
    bool isCell = false;  // of the grid round it
  };

  void open(const QString& begin, const QString& end) {
    out_ += begin;
    open_.append({end, 0, 0, width(), false});
  }
  double width() const { return open_.isEmpty() ? 640.0 : open_.last().width; }

  /// A child of a grid is one of its cells.
  void openCell(const QString& begin, const QString& end) {
    Open& grid = open_.last();
    if (grid.cells > 0 && grid.cells % grid.columns == 0) out_ += "</tr><tr>";
    ++grid.cells;
    double inner = grid.width / grid.columns - 12.0;
    out_ += QString("<td width=\"%1%\" valign=\"top\">").arg(100 / grid.columns) + begin;
    open_.append({end + "</td>", 0, 0, inner, true});
  }

  void openGrid(int columns) {
    double inner = width();
    out_ += "<table width=\"100%\" cellpadding=\"4\"><tr>";
    open_.append({"</tr></table>", columns, 0, inner, false});
  }

  void place(const QImage& picture, double wanted) {
    QString name = QString("picture-%1").arg(++pictures_);
    document_.addResource(QTextDocument::ImageResource, QUrl(name), picture);
    double shown = std::min(wanted, width());
    out_ += QString("<img src=\"%1\" width=\"%2\" height=\"%3\">")
                .arg(name)
                .arg(std::lround(shown))
                .arg(std::lround(shown * picture.height() / std::max(1, picture.width())));
  }

  /// Pixels stay pixels: none is blurred.
  void placePicture() {
    QByteArray source = xml_.attributes().value("src").toString().section("base64,", 1).toLatin1();
    QImage picture = QImage::fromData(QByteArray::fromBase64(source));
    if (picture.isNull())
      throw Error(ErrorKind::format,
                  RELUCENT_ENGLISH_MESSAGE("report.picture-unreadable",
                                           "the report holds a picture that cannot be read"),
                  RELUCENT_ENGLISH_MESSAGE("report.write-again", "write it again"), "");
    int factor = std::max(1, 640 / std::max(1, picture.width()));
    place(picture.scaled(picture.size() * factor, Qt::IgnoreAspectRatio, Qt::FastTransformation), 640.0);
  }

  void begin(const QString& name, const QString& style) {
    bool inGrid = !open_.isEmpty() && open_.last().columns > 0;
    if (name == "head") {
      xml_.skipCurrentElement();
    } else if (name == "svg") {
      bool legend = style == "legend";
      place(chartPicture(xml_, 3.0), legend ? 240.0 : 440.0);
    } else if (name == "img") {
      open({}, {});
      placePicture();
    } else if (style == "pictures") {
      openGrid(3);
    } else if (style == "charts") {
      openGrid(2);
    } else if (name == "dl") {
      open("<table cellpadding=\"3\">", "</table>");
    } else if (inGrid) {
      openCell("", "");
    } else {
      beginPlain(name);
    }
  }

  void beginPlain(const QString& name) {
    bool inList = !open_.isEmpty() && open_.last().end == "</table>";
    if (name == "div" && inList)
      open("<tr>", "</tr>");
    else if (name == "dt" || name == "dd")
      open(name == "dt" ? "<td>" : "<td><b>", name == "dt" ? "</td>" : "</b></td>");
    else if (name == "figcaption")
      open("<p>", "</p>");
    else if (name == "caption")
      open("<tr><td colspan=\"7\"><i>", "</i></td></tr>");
    else if (name == "table")
      open("<table cellpadding=\"3\">", "</table> ");
    else if (name == "br")
      open("<br>", "");
    else if (QStringList{"h1", "h2", "h3", "p", "ul", "li", "b", "tr", "th", "td"}.contains(name))
      open('<' + name + '>', "</" + name + '>');
    else
      open("", "");
  }

  void end(const QString& name) {
    if (name == "head" || name == "svg" || open_.isEmpty()) return;
    out_ += open_.takeLast().end;
  }

  QXmlStreamReader& xml_;
  QTextDocument& document_;
  QList<Open> open_;
  QString out_;
  int pictures_ = 0;
};

/// What HTML may leave open and XML may not.
QString asXml(QString html) {
  static const QRegularExpression lone("<(meta|img|br)([^>]*?)/?>");
  html.remove("<!DOCTYPE html>");
  return html.replace(lone, "<\\1\\2/>");
}

const char* const style =
    "body{font-family:Inter,'Noto "
    "Sans',sans-serif;font-size:9pt;color:#111}h1{font-size:18pt}h2{font-size:13pt}"
    "h3{font-size:10pt}p{margin-bottom:4px}";

}  // namespace

void writeReportPdf(const QString& html, const QString& file) {
  QTextDocument document;
  document.setDefaultStyleSheet(style);
  document.setDefaultFont(QFont(QStringList{"Inter", "Noto Sans"}, 9));
  QXmlStreamReader xml(asXml(html));
  QString text = Paper(xml, document).text();
  if (xml.hasError())
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("report.not-well-formed", "the report is not well-formed ({})")
                    .with(xml.errorString().toStdString()),
                RELUCENT_ENGLISH_MESSAGE("report.write-again", "write it again"), "");
  document.setHtml("<body>" + text + "</body>");

  writeFileAtomically(file.toStdString(), [&](const std::filesystem::path& temporary) {
    QPdfWriter writer(QString::fromStdString(temporary.string()));
    writer.setPageSize(QPageSize(QPageSize::A4));
    writer.setResolution(300);
    writer.setCreator("Relucent");
    writer.setTitle(document.metaInformation(QTextDocument::DocumentTitle));
    document.print(&writer);
  });
  if (QFile(file).size() == 0)
    throw Error(ErrorKind::disk, RELUCENT_MESSAGE("report.cannot-write", "the report cannot be written"),
                RELUCENT_MESSAGE("report.free-some-space", "free some space"), file.toStdString());
}

}  // namespace relucent::gui
