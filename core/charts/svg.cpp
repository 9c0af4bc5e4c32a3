// SPDX-License-Identifier: MIT
#include "relucent/charts/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace relucent::charts {
namespace {

constexpr double numberHeight = 14.0, digitWidth = 7.0;  // of letters 11 pixels high: Inter's widest digits
constexpr double fullWidth = 12.0;                       // of full-width characters in a legend

std::string open(std::string_view style, Extent extent, const std::string& title) {
  return fmt::format(
      R"(<svg class="{}" viewBox="0 0 {:g} {:g}" role="img" aria-label="{}"><title>{}</title>)", style,
      extent.width, extent.height, escaped(title), escaped(title));
}

std::string text(std::string_view style, Point at, std::string_view anchor, std::string_view content) {
  return fmt::format(R"(<text class="{}" x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", style, at.x,
                     at.y, anchor, escaped(content));
}

std::string line(std::string_view style, Point from, Point to) {
  return fmt::format(R"(<line class="{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)", style, from.x,
                     from.y, to.x, to.y);
}

std::string rectangle(std::string_view style, Point corner, Extent extent) {
  return fmt::format(R"(<rect class="{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)", style,
                     corner.x, corner.y, extent.width, extent.height);
}

/// The curve can be told without its colour.
std::string markerSvg(const Curve& curve, Point at) {
  constexpr double r = 3.5;
  switch (curve.marker) {
    case Marker::none:
      return {};
    case Marker::circle:
      return fmt::format(R"(<circle class="{} point" cx="{:.1f}" cy="{:.1f}" r="{}"/>)", curve.style, at.x,
                         at.y, r);
    case Marker::square:
      return rectangle(curve.style + " point", {at.x - r, at.y - r}, {2.0 * r, 2.0 * r});
    case Marker::triangle:
      return fmt::format(R"(<path class="{} point" d="M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z"/>)",
                         curve.style, at.x, at.y - r - 0.5, at.x + r + 0.5, at.y + r - 0.5, at.x - r - 0.5,
                         at.y + r - 0.5);
    case Marker::diamond:
      return fmt::format(
          R"(<path class="{} point" d="M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z"/>)",
          curve.style, at.x, at.y - r - 1.0, at.x + r + 1.0, at.y, at.x, at.y + r + 1.0, at.x - r - 1.0,
          at.y);
  }
  return {};
}

std::string hexOf(const image::Rgb8& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

/// By its characters, whatever their number of bytes in UTF-8. From U+3000 on are those of Chinese, Japanese
/// and Korean, which are full-width: as wide as they are high.
double widthOf(std::string_view words) {
  double width = 0.0;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) != 0x80U) width += byte < 0xE3U ? digitWidth : fullWidth;
  }
  return width;
}

/// A chart on its way to SVG.
class Drawn {
 public:
  Drawn(const Chart& chart, const Drawing& drawing)
      : chart_(chart),
        drawing_(drawing),
        rows_(chart.y.ticks(std::max(1, static_cast<int>(drawing.extent.height / 42.0)))) {
    double left = 8.0;
    for (const Tick& tick : rows_) left = std::max(left, widthOf(drawing.tickText(chart.y, tick)) + 12.0);
    double top = chart.y.title.empty() ? 8.0 : numberHeight + 10.0;
    double bottom = numberHeight + 8.0 + (chart.x.title.empty() ? 0.0 : numberHeight + 4.0);
    plot_ = {left, top, std::max(0.0, drawing.extent.width - left - 12.0),
             std::max(0.0, drawing.extent.height - top - bottom)};
  }

  const PlotArea& plot() const { return plot_; }

  std::string axes() const {
    constexpr double ascent = 11.0, middle = 4.0;  // of numbers: from their top and from their middle
    std::string svg;
    if (!chart_.y.title.empty()) svg += text("title", {0.0, ascent}, "start", chart_.y.title);
    if (!chart_.x.title.empty())
      svg += text("title", {plot_.left + plot_.width / 2.0, bottom() + numberHeight + 8.0 + ascent}, "middle",
                  chart_.x.title);
    for (const Tick& tick : rows_) {
      double y = placeOf({chart_.x.low, tick.value}).y;
      svg += line("grid", {plot_.left, y}, {right(), y});
      svg += text("number", {plot_.left - 8.0, y + middle}, "end", drawing_.tickText(chart_.y, tick));
    }
    svg += line("axis", {plot_.left, bottom()}, {right(), bottom()});
    for (const Tick& tick : chart_.x.ticks(std::max(1, static_cast<int>(plot_.width / 90.0)))) {
      double x = placeOf({tick.value, chart_.y.low}).x;
      svg += line("axis", {x, bottom()}, {x, bottom() + 4.0});
      svg += text("number", {x, bottom() + 5.0 + ascent}, "middle", drawing_.tickText(chart_.x, tick));
    }
    return svg;
  }

  std::string columns() const {
    std::string svg;
    for (const Column& column : chart_.columns) {
      Point from = placeOf({column.from, column.height});
      double width = placeOf({column.to, chart_.y.low}).x - from.x;
      double height = std::max(0.02 * plot_.height, bottom() - from.y);
      svg += rectangle(column.style, {from.x + 1.0, bottom() - height}, {std::max(1.0, width - 2.0), height});
    }
    return svg;
  }

  std::string curve(const Curve& curve) const {
    std::string path;
    for (const Point& value : curve.line) {
      if (!isWithin(value)) continue;
      Point at = placeOf(value);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at.x, at.y);
    }
    if (curve.filled && !path.empty())
      path += fmt::format("L{:.1f} {:.1f}L{:.1f} {:.1f}Z", placeOf(curve.line.back()).x, bottom(),
                          placeOf(curve.line.front()).x, bottom());
    std::string svg;
    if (!path.empty()) svg = fmt::format(R"(<path class="{}" d="{}"/>)", curve.style, path);
    for (const Point& value : curve.points)
      if (isWithin(value)) svg += markerSvg(curve, placeOf(value));
    return svg;
  }

  std::string mark() const {
    double x = placeOf({chart_.mark, chart_.y.low}).x;
    return line("mark", {x, plot_.top}, {x, bottom()});
  }

  std::string legend() const {
    std::string svg;
    const PlotArea area = legendArea();
    const double width = rowWidth();
    // Where each corner has something in it, above the plot, behind the title.
    const bool isAbove = pointsIn(area) > 0 && width > 0.0 && widthOf(chart_.y.title) + width <= right();
    Point at{isAbove ? right() - width : area.left, isAbove ? 7.0 : area.top + 12.0};
    for (const Curve& curve : chart_.curves) {
      if (curve.name.empty()) continue;
      svg += curve.filled
                 ? rectangle(curve.style, {at.x + 6.0, at.y - 6.0}, {14.0, 12.0})
                 : line(curve.style, at, {at.x + 26.0, at.y}) + markerSvg(curve, {at.x + 13.0, at.y});
      svg += text("legend", {at.x + beforeName, at.y + 4.0}, "start", curve.name);
      if (isAbove)
        at.x += entryWidth(curve);
      else
        at.y += 22.0;
    }
    return svg;
  }

 private:
  double right() const { return plot_.left + plot_.width; }
  double bottom() const { return plot_.top + plot_.height; }

  static constexpr double beforeName = 36.0;

  static double entryWidth(const Curve& curve) {
    constexpr double apart = 18.0;
    return beforeName + widthOf(curve.name) + apart;
  }
  /// Of all entries side by side; 0: there is no row for them.
  double rowWidth() const {
    if (chart_.y.title.empty()) return 0.0;
    double width = 0.0;
    for (const Curve& curve : chart_.curves)
      if (!curve.name.empty()) width += entryWidth(curve);
    return width;
  }

  /// In the corner where least of the curves is in its way: upper left, if none is better.
  PlotArea legendArea() const {
    constexpr double row = 22.0, margin = 20.0;
    PlotArea least{0.0, 0.0, 0.0, 0.0};
    for (const Curve& curve : chart_.curves) {
      if (curve.name.empty()) continue;
      least.width = std::max(least.width, beforeName + widthOf(curve.name));
      least.height += row;
    }
    const double farLeft = plot_.left + margin, farRight = right() - least.width - margin;
    std::size_t hidden = std::numeric_limits<std::size_t>::max();
    for (double top : {plot_.top, bottom() - least.height - 4.0})
      for (double left : {farLeft, std::max(farLeft, farRight)}) {
        const PlotArea area{left, top, least.width, least.height};
        const std::size_t behind = pointsIn(area);
        if (behind >= hidden) continue;
        hidden = behind;
        least.left = left;
        least.top = top;
      }
    return least;
  }

  /// Of the curves, between their values too, and of the mark.
  std::size_t pointsIn(const PlotArea& area) const {
    constexpr int between = 64;
    auto isIn = [&](Point at) {
      return at.x > area.left - 8.0 && at.x < area.left + area.width + 8.0 && at.y > area.top - 8.0 &&
             at.y < area.top + area.height + 8.0;
    };
    std::size_t count = 0;
    if (!std::isnan(chart_.mark) && isIn({placeOf({chart_.mark, chart_.y.low}).x, area.top})) ++count;
    for (const Curve& curve : chart_.curves) {
      for (const Point& value : curve.points) count += isIn(placeOf(value)) ? 1 : 0;
      for (std::size_t i = 1; i < curve.line.size(); ++i) {
        const Point from = placeOf(curve.line[i - 1]), to = placeOf(curve.line[i]);
        for (int k = 0; k < between; ++k) {
          const double share = static_cast<double>(k) / between;
          count += isIn({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)}) ? 1 : 0;
        }
      }
    }
    return count;
  }

  /// Along x; up to rounding.
  bool isWithin(Point value) const {
    double share = chart_.x.place(value.x);
    return share > -1e-9 && share < 1.0 + 1e-9;
  }

  /// Values outside of the axes stay at their ends: nothing is drawn over titles and numbers, and SVG as Qt
  /// knows it cannot clip.
  Point placeOf(Point value) const {
    auto within = [](double share) { return std::isnan(share) ? 0.0 : std::clamp(share, 0.0, 1.0); };
    return {plot_.left + within(chart_.x.place(value.x)) * plot_.width,
            bottom() - within(chart_.y.place(value.y)) * plot_.height};
  }

  const Chart& chart_;
  const Drawing& drawing_;
  std::vector<Tick> rows_;
  PlotArea plot_;
};

}  // namespace

std::string escaped(std::string_view raw) {
  std::string result;
  for (char c : raw) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

PlotArea plotOf(const Chart& chart, const Drawing& drawing) {
  return Drawn(chart, drawing).plot();
}

std::string svgOf(const Chart& chart, const Drawing& drawing) {
  Drawn drawn(chart, drawing);
  std::string svg = open("chart", drawing.extent, chart.title);
  if (!drawing.styleSheet.empty()) {
    // It stands alone: programs ask for the name of the language, which pages of HTML know.
    svg.insert(svg.find(' '), R"( xmlns="http://www.w3.org/2000/svg")");
    svg += "<style>" + drawing.styleSheet + "</style>";
  }
  svg += drawn.axes() + drawn.columns();
  if (!std::isnan(chart.mark)) svg += drawn.mark();
  for (const Curve& curve : chart.curves) svg += drawn.curve(curve);
  return svg + drawn.legend() + "</svg>";
}

std::string svgOf(const std::vector<Bar>& bars, const std::string& title) {
  constexpr double left = 110.0, width = 300.0, row = 30.0;
  double most = 1e-12;
  for (const Bar& bar : bars)
    if (std::isfinite(bar.value)) most = std::max(most, bar.value);
  std::string svg = open("chart", {500.0, row * static_cast<double>(bars.size()) + 8.0}, title);
  double y = 4.0;
  for (const Bar& bar : bars) {
    double share = std::isfinite(bar.value) ? std::max(bar.value, 0.0) / most : bar.value > 0.0 ? 1.0 : 0.0;
    svg += text("number", {left - 10.0, y + 18.0}, "end", bar.label);
    svg += rectangle(bar.highlighted ? "bar accent" : "bar", {left, y + 5.0},
                     {std::max(1.0, width * share), 18.0});
    svg += text("number", {left + width * share + 8.0, y + 18.0}, "start", bar.text);
    y += row;
  }
  return svg + "</svg>";
}

std::string colourBarSvg(image::ColourMap map, const std::vector<std::string>& ticks,
                         const std::string& title) {
  constexpr double left = 24.0, width = 252.0;
  constexpr int cells = 42;
  std::string svg = open("legend", {300.0, 32.0}, title);
  for (int cell = 0; cell < cells; ++cell)
    svg += fmt::format(R"(<rect x="{:.1f}" y="2" width="{:.1f}" height="10" fill="{}"/>)",
                       left + width * cell / cells, width / cells + 0.3,
                       hexOf(image::colourAt(map, (cell + 0.5) / cells)));
  for (std::size_t tick = 0; tick < ticks.size(); ++tick) {
    double share = ticks.size() > 1 ? static_cast<double>(tick) / static_cast<double>(ticks.size() - 1) : 0.0;
    svg += text("number", {left + width * share, 28.0}, "middle", ticks[tick]);
  }
  return svg + "</svg>";
}

}  // namespace relucent::charts
