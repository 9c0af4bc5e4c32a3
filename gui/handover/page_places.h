// SPDX-License-Identifier: MIT
#pragma once

#include <QList>

namespace relucent::gui {

/// What is known of a piece of a document before it stands on a page. One length unit throughout.
struct PieceSize {
  double height = 0.0;
  double gap = 0.0;        // above it, unless it is the first on its page
  bool keepsNext = false;  // a heading: what follows stands on the same page
  bool likesNext = false;  // the same, unless that leaves half of a page empty
};

/// Where it stands.
struct PiecePlace {
  int page = 0;
  double top = 0.0;
  double scale = 1.0;  // below 1: of what is higher than a page
};

/// Fills pages from top to bottom, in order. Pieces that keep their next ones move to the next page together,
/// unless that page has no room for them either. Where the last page would hold next to nothing, gaps are
/// smaller if that spares it.
QList<PiecePlace> placesOf(const QList<PieceSize>& pieces, double pageHeight);

}  // namespace relucent::gui
