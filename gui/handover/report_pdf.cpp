// SPDX-License-Identifier: MIT
#include "handover/report_pdf.h"

#include <QAbstractTextDocumentLayout>
#include <QFile>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QTextDocument>
#include <QUrl>
#include <memory>
#include <vector>

#include "handover/page_places.h"
#include "handover/report_pieces.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::gui {
namespace {

constexpr int resolution = 300;
constexpr QMarginsF margins(18.0, 16.0, 18.0, 16.0);  // millimetres
constexpr double contentWidth = 640.0;                // at 96 dots an inch: A4 less its margins
constexpr double footer = 18.0;                       // points, below what a page holds

const char* const style =
    "body{font-family:Inter,'Noto Sans',sans-serif;font-size:9pt;color:#111}"
    "h1,h2,h3,p,ul,li{margin-top:0;margin-bottom:0}h1{font-size:18pt}h2{font-size:13pt}h3{font-size:10pt}";

double dots(double points) {
  return points * resolution / 72.0;
}

/// Without the shapes that a type face has for the same character in different places, as Inter's colon
/// between digits: the file then knows what they look like and not what they say, to whoever searches or
/// copies.
QFont paperFont(double points) {
  QFont font(QStringList{"Inter", "Noto Sans"}, static_cast<int>(points));
  font.setStyleStrategy(QFont::PreferNoShaping);
  return font;
}

/// The report on the pages of a PDF file.
class Pages {
 public:
  Pages(const ReportPieces& report, QPdfWriter& writer)
      : report_(report), writer_(writer), height_(writer.height() - dots(footer)) {
    for (const ReportPiece& piece : report_.pieces) documents_.push_back(documentOf(piece));
    QList<PieceSize> sizes;
    for (qsizetype i = 0; i < report_.pieces.size(); ++i) {
      const ReportPiece& piece = report_.pieces[i];
      sizes.append({documents_[static_cast<std::size_t>(i)]->size().height(), dots(piece.gap),
                    piece.keepsNext, piece.likesNext});
    }
    places_ = placesOf(sizes, height_);
  }

  void paint() {
    QPainter painter(&writer_);
    int page = 0;
    paintFooter(painter, page);
    for (qsizetype i = 0; i < places_.size(); ++i) {
      if (places_[i].page > page) {
        writer_.newPage();
        paintFooter(painter, page = places_[i].page);
      }
      paintPiece(painter, i);
    }
  }

 private:
  std::unique_ptr<QTextDocument> documentOf(const ReportPiece& piece) const {
    auto document = std::make_unique<QTextDocument>();
    document->setUndoRedoEnabled(false);
    document->setDocumentMargin(0.0);
    document->setDefaultStyleSheet(style);
    document->setDefaultFont(paperFont(9.0));
    document->documentLayout()->setPaintDevice(&writer_);
    for (qsizetype i = 0; i < report_.pictures.size(); ++i)
      if (piece.html.contains('"' + pictureName(i) + '"'))
        document->addResource(QTextDocument::ImageResource, QUrl(pictureName(i)), report_.pictures[i]);
    document->setHtml("<body>" + piece.html + "</body>");
    document->setTextWidth(writer_.width());
    return document;
  }

  void paintPiece(QPainter& painter, qsizetype index) const {
    const PiecePlace& place = places_[index];
    if (report_.pieces[index].hasRule && place.top > 0.0) {
      painter.setPen(QPen(QColor("#C8C0B8"), dots(0.5)));
      const double y = place.top - 0.5 * dots(report_.pieces[index].gap);
      painter.drawLine(QPointF(0.0, y), QPointF(writer_.width(), y));
    }
    painter.save();
    painter.translate(0.0, place.top);
    painter.scale(place.scale, place.scale);
    QAbstractTextDocumentLayout::PaintContext context;
    context.palette.setColor(QPalette::Text, QColor("#111111"));
    documents_[static_cast<std::size_t>(index)]->documentLayout()->draw(&painter, context);
    painter.restore();
  }

  void paintFooter(QPainter& painter, int page) const {
    painter.setFont(paperFont(8.0));
    painter.setPen(QColor("#555555"));
    const QRectF line(0.0, height_, writer_.width(), writer_.height() - height_);
    painter.drawText(line, Qt::AlignLeft | Qt::AlignBottom, report_.title);
    const int last = places_.isEmpty() ? 0 : places_.last().page;
    painter.drawText(line, Qt::AlignRight | Qt::AlignBottom, QString("%1 / %2").arg(page + 1).arg(last + 1));
  }

  const ReportPieces& report_;
  QPdfWriter& writer_;
  double height_;  // of what a page holds
  std::vector<std::unique_ptr<QTextDocument>> documents_;
  QList<PiecePlace> places_;
};

}  // namespace

void writeReportPdf(const QString& html, const QString& file) {
  const ReportPieces report = reportPieces(html, contentWidth);
  writeFileAtomically(file.toStdString(), [&](const std::filesystem::path& temporary) {
    QPdfWriter writer(QString::fromStdString(temporary.string()));
    writer.setPageSize(QPageSize(QPageSize::A4));
    writer.setPageMargins(margins, QPageLayout::Millimeter);
    writer.setResolution(resolution);
    writer.setCreator("Relucent");
    writer.setTitle(report.title);
    Pages(report, writer).paint();
  });
  if (QFile(file).size() == 0)
    throw Error(ErrorKind::disk, RELUCENT_MESSAGE("report.cannot-write", "the report cannot be written"),
                RELUCENT_MESSAGE("report.free-some-space", "free some space"), file.toStdString());
}

}  // namespace relucent::gui
