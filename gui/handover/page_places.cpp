// SPDX-License-Identifier: MIT
#include "handover/page_places.h"

#include <algorithm>

namespace relucent::gui {
namespace {

double shown(const PieceSize& piece, double pageHeight) {
  return std::min(piece.height, pageHeight);
}

/// The piece after the last one that has to stay with `first`.
qsizetype endOfGroup(const QList<PieceSize>& pieces, qsizetype first) {
  qsizetype last = first;
  while (pieces[last].keepsNext && last + 1 < pieces.size()) ++last;
  return last + 1;
}

double heightOf(const QList<PieceSize>& pieces, qsizetype first, qsizetype end, double pageHeight) {
  double height = shown(pieces[first], pageHeight);
  for (qsizetype i = first + 1; i < end; ++i) height += pieces[i].gap + shown(pieces[i], pageHeight);
  return height;
}

}  // namespace

QList<PiecePlace> placesOf(const QList<PieceSize>& pieces, double pageHeight) {
  QList<PiecePlace> places;
  int page = 0;
  double filled = 0.0;
  auto place = [&](const PieceSize& piece, double wanted) {
    double gap = filled > 0.0 ? piece.gap : 0.0;
    if (filled > 0.0 && filled + gap + wanted > pageHeight) {
      ++page;
      filled = gap = 0.0;
    }
    const double height = shown(piece, pageHeight);
    places.append({page, filled + gap, piece.height > 0.0 ? height / piece.height : 1.0});
    filled += gap + height;
  };
  for (qsizetype i = 0; i < pieces.size(); ++i) {
    qsizetype end = endOfGroup(pieces, i);
    // Of what no page holds as much stays together as one does.
    while (end > i + 1 && heightOf(pieces, i, end, pageHeight) > pageHeight) --end;
    place(pieces[i], heightOf(pieces, i, end, pageHeight));
  }
  return places;
}

}  // namespace relucent::gui
