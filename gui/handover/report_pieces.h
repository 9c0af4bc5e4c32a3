// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QList>
#include <QString>

namespace relucent::gui {

/// A part of the report that no page breaks, in the HTML that Qt's text documents know.
struct ReportPiece {
  QString html;
  double gap = 0.0;        // above it, points
  bool keepsNext = false;  // a heading and the words below it stand with what they are about
  bool hasRule = false;    // a line above it parts it from what was before
  bool likesNext = false;  // of one figure with the next
};

struct ReportPieces {
  QString title;
  QList<ReportPiece> pieces;  // in the report's order
  QList<QImage> pictures;     // named pictureName(index) in the HTML
};

/// `width`: of a page, at 96 dots an inch. Throws: Error{format} if `html` is not well-formed or holds a
/// picture that cannot be read.
ReportPieces reportPieces(const QString& html, double width);

QString pictureName(qsizetype index);

}  // namespace relucent::gui
