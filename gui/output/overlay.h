// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QStringList>
#include <optional>

#include "content/test_chart.h"
#include "output/player_statistics.h"

namespace relucent {

/// What the overlay tells.
struct OverlayState {
  PlayerStatistics statistics;
  bool compensated = true;
  bool frozen = false;
  std::optional<TestChart> chart;
};

/// Its lines: frame rate, frame time and late frames; clipped share, steps and whether it is compensated;
/// what else was switched.
QStringList overlayLines(const OverlayState& state);

/// Writes lines into the upper left corner, grey on black, as large as the picture allows them to be read.
void drawOverlay(QImage& picture, const QStringList& lines);

}  // namespace relucent
