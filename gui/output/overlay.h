// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QStringList>
#include <optional>

#include "content/test_chart.h"
#include "output/player_statistics.h"

namespace relucent::gui {

/// Contents of the overlay.
struct OverlayState {
  PlayerStatistics statistics;
  bool compensated = true;
  bool frozen = false;
  std::optional<TestChart> chart;
};

/// Its lines: frame rate, frame time and late frames; clipped share, steps and whether it is compensated;
/// other modes.
QStringList overlayLines(const OverlayState& state);

/// Writes lines into the upper left corner, grey on black, in a legible size.
void drawOverlay(QImage& picture, const QStringList& lines);

}  // namespace relucent::gui
