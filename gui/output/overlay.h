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

/// Lines for the upper left corner of a picture of this size, and no larger than that: grey on black,
/// legible.
QImage overlayPicture(QSize size, const QStringList& lines);

}  // namespace relucent::gui
