// SPDX-License-Identifier: MIT
#include "handover/page_places.h"

#include <algorithm>
#include <utility>

namespace relucent::gui {
namespace {

double shown(const PieceSize& piece, double pageHeight) {
  return std::min(piece.height, pageHeight);
}

/// The piece after the last one that has to stay with `first`.
qsizetype endOfGroup(const QList<PieceSize>& pieces, qsizetype first, bool withLiked) {
  qsizetype last = first;
  while (last + 1 < pieces.size() && (pieces[last].keepsNext || (withLiked && pieces[last].likesNext)))
    ++last;
  return last + 1;
}

double heightOf(const QList<PieceSize>& pieces, qsizetype first, qsizetype end, double pageHeight) {
  double height = shown(pieces[first], pageHeight);
  for (qsizetype i = first + 1; i < end; ++i) height += pieces[i].gap + shown(pieces[i], pageHeight);
  return height;
}

/// The places, and how much of the last page they fill.
std::pair<QList<PiecePlace>, double> filledPages(const QList<PieceSize>& pieces, double pageHeight) {
  constexpr double fairlyFull = 0.5;
  QList<PiecePlace> places;
  int page = 0;
  double filled = 0.0;
  qsizetype together = 0;  // what is before this was moved to a page with what is placed on it
  for (qsizetype i = 0; i < pieces.size(); ++i) {
    double gap = filled > 0.0 ? pieces[i].gap : 0.0;
    const auto fits = [&](qsizetype end) {
      return filled + gap + heightOf(pieces, i, end, pageHeight) <= pageHeight;
    };
    // Of what no page holds as much stays together as one does.
    const auto endOf = [&](bool withLiked) {
      qsizetype end = endOfGroup(pieces, i, withLiked);
      while (end > i + 1 && heightOf(pieces, i, end, pageHeight) > pageHeight) --end;
      return end;
    };
    const bool isFairlyFull = filled > fairlyFull * pageHeight;
    if (filled > 0.0 && i >= together && !fits(endOf(isFairlyFull))) {
      ++page;
      filled = gap = 0.0;
    }
    if (filled == 0.0) together = endOf(true);
    const double height = shown(pieces[i], pageHeight);
    places.append({page, filled + gap, pieces[i].height > 0.0 ? height / pieces[i].height : 1.0});
    filled += gap + height;
  }
  return {places, filled};
}

}  // namespace

QList<PiecePlace> placesOf(const QList<PieceSize>& pieces, double pageHeight) {
  constexpr double nextToNothing = 0.2, smallerGap = 0.5;
  auto [places, filled] = filledPages(pieces, pageHeight);
  if (places.isEmpty() || places.last().page == 0 || filled > nextToNothing * pageHeight) return places;
  QList<PieceSize> closer = pieces;
  for (PieceSize& piece : closer) piece.gap *= smallerGap;
  const QList<PiecePlace> fewer = filledPages(closer, pageHeight).first;
  return fewer.last().page < places.last().page ? fewer : places;
}

}  // namespace relucent::gui
