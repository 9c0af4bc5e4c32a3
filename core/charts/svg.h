// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/charts/chart.h"
#include "relucent/image/colour_map.h"

/// Charts as SVG. Colours and type come from a style sheet, by classes: `grid`, `axis`, `number`, `title`,
/// `legend`, `mark`, `bar`, and those of the curves and columns; `point` is a curve's marker.
namespace relucent::charts {

struct Extent {
  double width = 0.0, height = 0.0;
};

/// Within a drawing, from its upper left corner; y points down.
struct PlotArea {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

struct Drawing {
  Extent extent;                        // in pixels, where letters are 11 to 12 pixels high
  std::string styleSheet{};             // CSS; empty: the page that the drawing stands in has one
  TickText tickText = englishTickText;  // numbers along the axes
};

/// Where x and y map to: the rest is titles and numbers. Digits are taken to be as wide as those of Inter.
PlotArea plotOf(const Chart& chart, const Drawing& drawing);

/// Axes with grid and titles, columns, curves, the mark and a legend.
std::string svgOf(const Chart& chart, const Drawing& drawing);

std::string svgOf(const std::vector<Bar>& bars, const std::string& title);

/// A colour bar with ticks evenly spaced from its left to its right end.
std::string colourBarSvg(image::ColourMap map, const std::vector<std::string>& ticks,
                         const std::string& title);

/// & < > " ' as entities.
std::string escaped(std::string_view text);

}  // namespace relucent::charts
