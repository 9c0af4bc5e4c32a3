// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relucent/linearization/linearization.h"
#include "relucent/pipeline/report_pictures.h"

namespace relucent::pipeline {

/// Charts as SVG to stand inside an HTML page whose style sheet colours them (report_style.h). Each has a
/// title that a screen reader says.

/// & < > " ' as entities.
std::string escaped(std::string_view text);

/// Light over drive of the three channels; colours and marks both differ.
std::string responseChart(const linearization::ProjectorResponse& response, const std::string& title);

struct Bar {
  std::string label;
  double value = 0.0;
  std::string text;  // the value as it is written at the bar
  bool highlighted = false;
};
/// Horizontal bars from zero.
std::string barChart(const std::vector<Bar>& bars, const std::string& title);

/// Two histograms over one another: shares of the values in bins of equal width from 0 to `most`.
std::string histogram(const std::vector<float>& before, const std::vector<float>& after, double most,
                      const std::string& unit, const std::string& title);

/// A colour bar with ticks evenly spaced from its left to its right end.
std::string legend(image::ColourMap map, const std::vector<std::string>& ticks, const std::string& title);

}  // namespace relucent::pipeline
