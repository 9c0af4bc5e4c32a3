// SPDX-License-Identifier: MIT
#include "relucent/report/measured_charts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relucent::report {
namespace {

constexpr std::size_t bins = 40;

std::array<double, bins> percentInBins(const std::vector<float>& values, double most) {
  std::array<double, bins> shares{};
  double count = 0.0;
  for (float value : values)
    if (!std::isnan(value)) {
      double place = static_cast<double>(bins) * static_cast<double>(value) / most;
      shares[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins - 1)))] += 100.0;
      count += 1.0;
    }
  for (double& share : shares) share /= std::max(count, 1.0);
  return shares;
}

}  // namespace

charts::Chart responseChart(const linearization::ProjectorResponse& response, const std::string& title) {
  struct Channel {
    const char *name, *style;
    charts::Marker marker;
  };
  constexpr Channel channels[] = {{"Red", "red", charts::Marker::circle},
                                  {"Green", "green", charts::Marker::square},
                                  {"Blue", "blue", charts::Marker::triangle}};
  charts::Chart chart{title,
                      {0.0, 100.0, false, "Level sent to the projector, % of full"},
                      {0.0, 100.0, false, "Light, % of full"}};
  for (std::size_t c = 0; c < 3; ++c) {
    const hdr::ResponseCurve& light = response.channels[c];
    charts::Curve curve{channels[c].name, channels[c].style, channels[c].marker};
    auto at = [&](double drive) { return charts::Point{100.0 * drive, 100.0 * light(drive)}; };
    for (int i = 0; i <= 64; ++i) curve.line.push_back(at(i / 64.0));
    for (int i = 0; i <= 8; ++i) curve.points.push_back(at(i / 8.0));
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

charts::Chart histogram(const std::vector<float>& before, const std::vector<float>& after, double most,
                        const std::string& unit) {
  charts::Chart chart{"Share of the pixels by colour error, uncompensated and compensated",
                      {0.0, most, false, unit},
                      {0.0, 1.0, false, "Pixels, %"}};
  for (auto [name, style, values] :
       {std::tuple("Uncompensated", "before", &before), std::tuple("Compensated", "after", &after)}) {
    charts::Curve outline{name, style};
    outline.filled = true;
    std::array<double, bins> shares = percentInBins(*values, most);
    for (std::size_t bin = 0; bin < bins; ++bin)
      for (std::size_t end : {bin, bin + 1})
        outline.line.push_back({most * static_cast<double>(end) / bins, shares[bin]});
    chart.y.high = std::max(chart.y.high, *std::max_element(shares.begin(), shares.end()));
    chart.curves.push_back(std::move(outline));
  }
  return chart;
}

}  // namespace relucent::report
