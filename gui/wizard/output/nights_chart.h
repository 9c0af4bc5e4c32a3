// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <vector>

#include "relucent/charts/chart.h"
#include "relucent/pipeline/night_record.h"

namespace relucent::gui {

/// What of a night's proof is drawn.
enum class NightFigure { colourError, psnr };

/// A chart of nights: what was photographed and what was predicted over the days before the last night, with
/// marks where something was repaired, and where somebody had to look.
struct NightsChart {
  charts::Axis x, y;
  std::vector<charts::Curve> curves;
  QString summary;  // for screen readers
};
/// `nights`: oldest first, of which the last twelve weeks are drawn.
NightsChart chartOf(const std::vector<pipeline::NightRecord>& nights, NightFigure figure);

/// When it was, and what came of it, in the user's language.
QString nightTime(const pipeline::NightRecord& night);
QString nightSentence(const pipeline::NightRecord& night);

}  // namespace relucent::gui
