// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "content/canvas.h"
#include "content/content_source.h"

namespace relucent::gui {

/// Test charts, drawn for the canvas pixel by pixel, never scaled.
enum class TestChart {
  grid,        // white lines of a pixel on black, squares; the border, a circle, both diagonals
  ramps,       // grey, red, green and blue from black to full, and sixteen steps of grey
  resolution,  // vertical and horizontal lines of 1, 2, 4 and 8 pixels
  patches,     // six colours full, half as bright, pale; six greys
  checker,     // squares as large as those of the grid
  white,
};
inline constexpr std::array allTestCharts{TestChart::grid,    TestChart::ramps,   TestChart::resolution,
                                          TestChart::patches, TestChart::checker, TestChart::white};

/// As in a playlist: "grid" in "chart:grid".
QString testChartName(TestChart chart);
std::optional<TestChart> testChartFromName(const QString& name);

/// Contract: the size is not empty.  Format_RGBX8888.
QImage drawn(TestChart chart, QSize size);

/// A test chart as a still picture. Drawn at the first request.
class TestChartContent : public ContentSource {
 public:
  TestChartContent(TestChart chart, const Canvas& canvas) : chart_(chart), size_(canvas.size) {}

  ContentPicture at(ContentTime) override;
  std::optional<ContentTime> length() const override { return std::nullopt; }

 private:
  TestChart chart_;
  QSize size_;
  ContentPicture frame_;
};

}  // namespace relucent::gui
