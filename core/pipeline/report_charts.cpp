// SPDX-License-Identifier: MIT
#include "relucent/pipeline/report_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relucent::pipeline {
namespace {

std::string open(int width, int height, const std::string& title) {
  return fmt::format(R"(<svg class="chart" viewBox="0 0 {} {}" role="img" aria-label="{}"><title>{}</title>)",
                     width, height, escaped(title), escaped(title));
}

std::string text(double x, double y, std::string_view anchor, std::string_view content) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor,
                     escaped(content));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view style) {
  return fmt::format(R"(<line class="{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)", style, x1, y1,
                     x2, y2);
}

/// A circle, a square or a triangle: the channel can be told without its colour.
std::string mark(std::size_t channel, double x, double y) {
  if (channel == 0) return fmt::format(R"(<circle class="c0" cx="{:.1f}" cy="{:.1f}" r="3.2"/>)", x, y);
  if (channel == 1)
    return fmt::format(R"(<rect class="c1" x="{:.1f}" y="{:.1f}" width="5.6" height="5.6"/>)", x - 2.8,
                       y - 2.8);
  return fmt::format(R"(<path class="c2" d="M{:.1f} {:.1f}l3.4 6h-6.8z"/>)", x, y - 3.6);
}

std::string hexOf(const image::Rgb8& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

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

std::string responseChart(const linearization::ProjectorResponse& response, const std::string& title) {
  constexpr double left = 44, top = 16, width = 400, height = 240;
  auto x = [&](double drive) { return left + width * drive; };
  auto y = [&](double light) { return top + height * (1.0 - light); };
  std::string svg = open(470, 310, title);
  for (int tick = 0; tick <= 4; ++tick) {
    double share = tick / 4.0;
    svg += line(left, y(share), left + width, y(share), "grid");
    svg += text(left - 8, y(share) + 4, "end", fmt::format("{:.0f}", 100.0 * share));
    svg += text(x(share), top + height + 18, "middle", fmt::format("{:.0f}", 100.0 * share));
  }
  svg += text(left + width / 2, top + height + 38, "middle", "Level sent to the projector, % of full");
  svg += text(left + 8, top + 8, "start", "Light, % of full");

  constexpr const char* names[] = {"Red", "Green", "Blue"};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const hdr::ResponseCurve& curve = response.channels[channel];
    std::string path;
    for (int i = 0; i <= 64; ++i)
      path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x(i / 64.0), y(curve(i / 64.0)));
    svg += fmt::format(R"(<path class="c{} curve" d="{}"/>)", channel, path);
    for (int i = 0; i <= 8; ++i) svg += mark(channel, x(i / 8.0), y(curve(i / 8.0)));
    double row = top + 30 + 20 * static_cast<double>(channel);
    svg += mark(channel, left + 20, row) + text(left + 32, row + 4, "start", names[channel]);
  }
  return svg + "</svg>";
}

std::string barChart(const std::vector<Bar>& bars, const std::string& title) {
  constexpr double left = 110, width = 300, row = 30;
  double most = 1e-12;
  for (const Bar& bar : bars)
    if (std::isfinite(bar.value)) most = std::max(most, bar.value);
  std::string svg = open(500, static_cast<int>(row * static_cast<double>(bars.size())) + 8, title);
  double y = 4;
  for (const Bar& bar : bars) {
    double share = std::isfinite(bar.value) ? std::max(bar.value, 0.0) / most : bar.value > 0.0 ? 1.0 : 0.0;
    svg += text(left - 10, y + 18, "end", bar.label);
    svg += fmt::format(R"(<rect class="{}" x="{}" y="{:.1f}" width="{:.1f}" height="18" rx="3"/>)",
                       bar.highlighted ? "bar accent" : "bar", left, y + 5, std::max(1.0, width * share));
    svg += text(left + width * share + 8, y + 18, "start", bar.text);
    y += row;
  }
  return svg + "</svg>";
}

std::string histogram(const std::vector<float>& before, const std::vector<float>& after, double most,
                      const std::string& unit, const std::string& title) {
  constexpr std::size_t bins = 40;
  constexpr double left = 20, top = 36, width = 430, height = 160;
  auto sharesOf = [&](const std::vector<float>& values) {
    std::vector<double> shares(bins, 0.0);
    double count = 0.0;
    for (float value : values)
      if (!std::isnan(value)) {
        double place = static_cast<double>(bins) * static_cast<double>(value) / most;
        shares[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins - 1)))] += 1.0;
        count += 1.0;
      }
    for (double& share : shares) share /= std::max(count, 1.0);
    return shares;
  };
  std::vector<double> shares[] = {sharesOf(before), sharesOf(after)};
  double highest = 1e-12;
  for (const auto& set : shares) highest = std::max(highest, *std::max_element(set.begin(), set.end()));

  std::string svg = open(470, 250, title);
  constexpr const char* styles[] = {"before", "after"};
  constexpr const char* names[] = {"Uncompensated", "Compensated"};
  for (std::size_t set = 0; set < 2; ++set) {
    std::string path = fmt::format("M{:.1f} {:.1f}", left, top + height);
    for (std::size_t bin = 0; bin < bins; ++bin) {
      double y = top + height * (1.0 - shares[set][bin] / highest);
      double x = left + width * static_cast<double>(bin) / bins;
      path += fmt::format("L{:.1f} {:.1f}L{:.1f} {:.1f}", x, y, x + width / bins, y);
    }
    path += fmt::format("L{:.1f} {:.1f}Z", left + width, top + height);
    svg += fmt::format(R"(<path class="{}" d="{}"/>)", styles[set], path);
    double column = left + 140 * static_cast<double>(set);
    svg += fmt::format(R"(<rect class="{}" x="{:.1f}" y="8" width="14" height="10"/>)", styles[set], column);
    svg += text(column + 22, 17, "start", names[set]);
  }
  svg += line(left, top + height, left + width, top + height, "axis");
  for (int tick = 0; tick <= 4; ++tick)
    svg += text(left + width * tick / 4.0, top + height + 18, "middle",
                fmt::format("{:.0f}{}", most * tick / 4.0, tick == 4 ? "+" : ""));
  svg += text(left + width / 2, top + height + 40, "middle", unit);
  return svg + "</svg>";
}

std::string legend(image::ColourMap map, const std::vector<std::string>& ticks, const std::string& title) {
  constexpr double left = 24, width = 252;
  constexpr int cells = 42;
  std::string svg =
      fmt::format(R"(<svg class="legend" viewBox="0 0 300 32" role="img" aria-label="{}"><title>{}</title>)",
                  escaped(title), escaped(title));
  for (int cell = 0; cell < cells; ++cell)
    svg += fmt::format(R"(<rect x="{:.1f}" y="2" width="{:.1f}" height="10" fill="{}"/>)",
                       left + width * cell / cells, width / cells + 0.3,
                       hexOf(image::colourAt(map, (cell + 0.5) / cells)));
  for (std::size_t tick = 0; tick < ticks.size(); ++tick) {
    double share = ticks.size() > 1 ? static_cast<double>(tick) / static_cast<double>(ticks.size() - 1) : 0.0;
    svg += text(left + width * share, 28, "middle", ticks[tick]);
  }
  return svg + "</svg>";
}

}  // namespace relucent::pipeline
