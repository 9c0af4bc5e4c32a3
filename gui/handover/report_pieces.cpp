// SPDX-License-Identifier: MIT
#include "handover/report_pieces.h"

#include <QRegularExpression>
#include <QXmlStreamReader>
#include <algorithm>
#include <cmath>

#include "handover/chart_picture.h"
#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr double cellMargin = 12.0;

/// Qt's text documents know tables and no grids, pictures by name and no drawings: the report said so.
class Parser {
 public:
  Parser(const QString& html, double width) : xml_(html), pageWidth_(width) {}

  ReportPieces pieces() {
    while (!xml_.atEnd()) {
      switch (xml_.readNext()) {
        case QXmlStreamReader::StartElement:
          begin(xml_.name().toString(), xml_.attributes().value("class").toString());
          break;
        case QXmlStreamReader::EndElement:
          end();
          break;
        case QXmlStreamReader::Characters:
          out_ += xml_.text().toString().toHtmlEscaped();
          break;
        default:
          break;
      }
    }
    if (xml_.hasError())
      throw Error(ErrorKind::format,
                  RELUCENT_ENGLISH_MESSAGE("report.not-well-formed", "the report is not well-formed ({})")
                      .with(xml_.errorString().toStdString()),
                  RELUCENT_ENGLISH_MESSAGE("report.write-again", "write it again"), "");
    return std::move(found_);
  }

 private:
  struct Open {
    QString end;               // what closes it
    int columns = 0;           // a grid
    int cells = 0;             // of its row, so far
    bool hasRow = false;       // before that
    double width = 0.0;        // of what stands in it, at 96 dots an inch
    bool isList = false;       // names and values
    bool rowsBreak = false;    // a long table: every row is a piece
    bool beginsPiece = false;  // all of it is one
  };

  double width() const { return open_.isEmpty() ? pageWidth_ : open_.last().width; }
  bool isInPiece() const {
    return std::any_of(open_.begin(), open_.end(),
                       [](const Open& open) { return open.beginsPiece || open.columns > 0; });
  }
  bool isInLongTable() const {
    return std::any_of(open_.begin(), open_.end(), [](const Open& open) { return open.rowsBreak; });
  }
  Open& open(const QString& begin, const QString& end) {
    out_ += begin;
    Open opened;
    opened.end = end;
    opened.width = width();
    open_.append(opened);
    return open_.last();
  }
  /// What stands in a piece is part of that.
  void openPiece(const ReportPiece& piece, const QString& begin, const QString& end) {
    if (isInPiece()) {
      open(begin, end);
      return;
    }
    out_.clear();
    piece_ = piece;
    open(begin, end).beginsPiece = true;
  }
  void keepPiece() {
    piece_.html = std::exchange(out_, {});
    found_.pieces.append(piece_);
  }

  /// A child of a grid is one of its cells, a row of which is a piece.
  void openCell() {
    Open& grid = open_.last();
    if (grid.cells == 0) {
      out_ = "<table width=\"100%\" cellpadding=\"4\"><tr>";
      // Its rows are one figure: at best none stands on the next page, away from the heading.
      if (grid.hasRow) found_.pieces.last().likesNext = true;
    }
    ++grid.cells;
    out_ += QString("<td width=\"%1%\" valign=\"top\">").arg(100 / grid.columns);
    const double inner = grid.width / grid.columns - cellMargin;
    open({}, "</td>").width = inner;
  }
  void endRow(Open& grid) {
    if (grid.cells == 0) return;
    for (int cell = grid.cells; cell < grid.columns; ++cell)
      out_ += QString("<td width=\"%1%\"></td>").arg(100 / grid.columns);
    out_ += "</tr></table>";
    piece_ = {{}, 4.0, false, false};
    keepPiece();
    grid.cells = 0;
    grid.hasRow = true;
  }

  void place(const QImage& picture, double wanted) {
    found_.pictures.append(picture);
    const double shown = std::min(wanted, width());
    out_ += QString("<p><img src=\"%1\" width=\"%2\" height=\"%3\"></p>")
                .arg(pictureName(found_.pictures.size() - 1))
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
    place(picture.scaled(picture.size() * factor, Qt::IgnoreAspectRatio, Qt::FastTransformation), pageWidth_);
  }

  void placeChart(bool isLegend) {
    const bool alone = !isInPiece();
    if (alone) {
      out_.clear();
      piece_ = {{}, 4.0, false, false};
    }
    place(chartPicture(xml_, 3.0), isLegend ? 240.0 : 440.0);
    if (alone) keepPiece();
  }

  void begin(const QString& name, const QString& kind) {
    const bool isGridsChild = !open_.isEmpty() && open_.last().columns > 0;
    if (name == "title")
      found_.title = xml_.readElementText();
    else if (name == "style")
      xml_.skipCurrentElement();
    else if (isGridsChild)
      openCell();
    else if (name == "svg")
      placeChart(kind == "legend");
    else if (name == "img") {
      open({}, {});
      placePicture();
    } else if (kind.startsWith("pictures"))
      open({}, {}).columns = kind.contains("large") ? 2 : 3;
    else if (kind == "charts")
      open({}, {}).columns = 2;
    else if (name == "dl")
      beginCards();
    else
      beginText(name, kind);
  }

  void beginCards() {
    openPiece({{}, 8.0, false, false}, "<table width=\"100%\" cellpadding=\"4\"><tr>", "</tr></table>");
    open_.last().isList = true;
  }

  void beginText(const QString& name, const QString& kind) {
    const bool isInList = !open_.isEmpty() && open_.last().isList;
    if (name == "div" && isInList)
      open("<td bgcolor=\"#F1EDE8\">", "</td>");
    else if (name == "dt" || name == "dd")
      open(name == "dt" ? "<div style=\"color:#555\">" : "<div style=\"font-size:13pt\">", "</div>");
    else if (name == "h1")
      openPiece({{}, 0.0, true, false}, "<h1>", "</h1>");
    else if (name == "h2")
      openPiece({{}, 16.0, true, true}, "<h2>", "</h2>");
    else if (name == "h3")
      openPiece({{}, 8.0, true, false}, "<h3>", "</h3>");
    else if (name == "p")
      openPiece({{}, 3.0, kind == "soft", false}, kind == "soft" ? "<p style=\"color:#555\">" : "<p>",
                "</p>");
    else if (name == "li")
      beginItem(kind);
    else if (name == "table" || name == "tr")
      beginTable(name, kind);
    else
      beginWithin(name, kind);
  }

  void beginItem(const QString& kind) {
    if (!kind.startsWith("note")) return openPiece({{}, 2.0, false, false}, "<ul><li>", "</li></ul>");
    openPiece({{}, 4.0, false, false},
              QString("<table width=\"100%\" cellpadding=\"6\"><tr><td bgcolor=\"%1\">")
                  .arg(kind.contains("amber") ? "#FAEFD2" : "#E3F0E6"),
              "</td></tr></table>");
  }

  /// Rows of long tables stand in tables of their own, whose columns are as wide as those of the others.
  void beginTable(const QString& name, const QString& kind) {
    if (name == "table" && kind == "long")
      open({}, {}).rowsBreak = true;
    else if (name == "table")
      openPiece({{}, 6.0, false, false}, "<table width=\"100%\" cellpadding=\"3\">", "</table>");
    else if (isInLongTable())
      openPiece({{}, 0.0, false, false}, "<table width=\"100%\" cellpadding=\"2\"><tr>", "</tr></table>");
    else
      open("<tr>", "</tr>");
  }

  void beginWithin(const QString& name, const QString& kind) {
    if (name == "figcaption")
      open("<p>", "</p>");
    else if (name == "caption" || name == "summary" || name == "footer")
      xml_.skipCurrentElement();  // headings say it already
    else if (name == "br")
      open("<br>", "");
    else if (name == "th" || name == "td")
      open(cellOf(name, kind), "</td>");
    else if (name == "b")
      open("<b>", "</b>");
    else
      open({}, {});
  }
  QString cellOf(const QString& name, const QString& kind) const {
    // Figures are short and stay whole; what is read needs room, or it becomes a column of single words.
    if (!isInLongTable() && kind == "prose") return "<td width=\"25%\" style=\"font-size:7.5pt\">";
    const bool isWhole = name == "td" || xml_.attributes().value("scope") == QLatin1String("row");
    if (!isInLongTable())
      return QString("<td style=\"font-size:7.5pt%1\">").arg(isWhole ? ";white-space:nowrap" : "");
    return name == "th" ? "<td width=\"45%\" style=\"color:#555\">" : "<td width=\"55%\">";
  }

  void end() {
    if (open_.isEmpty()) return;
    Open ended = open_.takeLast();
    if (ended.columns > 0) endRow(ended);
    out_ += ended.end;
    if (ended.beginsPiece) keepPiece();
    if (!open_.isEmpty() && open_.last().columns > 0 && open_.last().cells == open_.last().columns)
      endRow(open_.last());
  }

  QXmlStreamReader xml_;
  double pageWidth_;
  QList<Open> open_;
  QString out_;
  ReportPiece piece_;
  ReportPieces found_;
};

/// What HTML may leave open and XML may not.
QString asXml(QString html) {
  static const QRegularExpression lone("<(meta|img|br)([^>]*?)/?>");
  html.remove("<!DOCTYPE html>");
  return html.replace(lone, "<\\1\\2/>");
}

}  // namespace

QString pictureName(qsizetype index) {
  return QString("picture-%1").arg(index);
}

ReportPieces reportPieces(const QString& html, double width) {
  return Parser(asXml(html), width).pieces();
}

}  // namespace relucent::gui
