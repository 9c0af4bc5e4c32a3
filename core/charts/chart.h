// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "relucent/charts/axis.h"

namespace relucent::charts {

/// Markers of a curve's points, so that curves differ not only in colour.
enum class Marker { none, circle, square, triangle, diamond };

struct Point {
  double x = 0.0, y = 0.0;
};

struct Curve {
  std::string name;   // in the legend; empty: not there
  std::string style;  // a class of the style sheet: red, green, blue, accent, amber, information, ...
  Marker marker = Marker::none;
  std::vector<Point> line{};    // drawn through
  std::vector<Point> points{};  // marked
  bool filled = false;          // down to the axis
};

/// A bar of a histogram, standing on the axis.
struct Column {
  double from = 0.0, to = 0.0;
  double height = 0.0;
  std::string style;
};

/// What a chart shows, whatever it is drawn on: a window, a page of HTML, paper.
struct Chart {
  std::string title;  // a sentence for screen readers
  Axis x, y;
  std::vector<Curve> curves{};
  std::vector<Column> columns{};
  double mark = std::numeric_limits<double>::quiet_NaN();  // a dashed vertical line; NaN: none
};

/// Of a chart that is not measured along axes: horizontal bars from zero, one below the other.
struct Bar {
  std::string label;
  double value = 0.0;
  std::string text;  // the value as it is written at the bar
  bool highlighted = false;
};

}  // namespace relucent::charts
