// SPDX-License-Identifier: MIT
#include "relucent/report/acquisition_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "relucent/charts/svg.h"

namespace relucent::report {
namespace {

constexpr charts::Extent extent{640.0, 360.0};
// Grey letters and strong colours: readable on light pages and on dark ones.
constexpr const char* styleSheet =
    "text{font:12px sans-serif;fill:#808080}.grid{stroke:#80808040}.axis{stroke:#808080}"
    ".red,.green,.blue,.amber{fill:none;stroke-width:2}.red{stroke:#d0584e}.green{stroke:#4f9460}"
    ".blue{stroke:#4a82b8}.amber{stroke:#c08a2e}.point{fill:#ffffff}";

/// One trial in all venues.
struct Trial {
  std::set<std::string> venues;
  double logExposures = 0.0, refined = 0.0;  // sums
};

using Mode = std::pair<acquisition::AcquisitionMode, acquisition::LitColours>;

std::string titleOf(const Mode& mode) {
  std::string name(nameOf(mode.first));
  bool isWhite =
      mode.first != acquisition::AcquisitionMode::fast && mode.second == acquisition::LitColours::white;
  return isWhite ? name + ", white" : name;
}

}  // namespace

std::string acquisitionChart(const pipeline::AcquisitionBenchResult& result) {
  std::map<Mode, std::map<double, Trial>> trials;  // by threshold
  std::set<std::string> venues;
  for (const pipeline::AcquisitionBenchRun& run : result.runs) {
    Trial& trial = trials[{run.mode, run.colours}][run.threshold];
    venues.insert(run.venue);
    trial.venues.insert(run.venue);
    trial.logExposures += std::log(static_cast<double>(run.exposures));
    trial.refined += run.refined;
  }

  charts::Chart chart{.title = "Quality of compensation against photographs",
                      .x = {1e99, 0.0, true, "Photographs"},
                      .y = {1e99, 0.0, false, "PSNR of refined, dB"}};
  constexpr std::array styles{"amber", "blue", "green", "red"};
  constexpr std::array markers{charts::Marker::circle, charts::Marker::square, charts::Marker::triangle,
                               charts::Marker::diamond};
  for (const auto& [mode, thresholds] : trials) {
    std::vector<charts::Point> points;
    for (const auto& [threshold, trial] : thresholds) {
      if (trial.venues.size() != venues.size()) continue;
      auto count = static_cast<double>(trial.venues.size());
      points.push_back({std::exp(trial.logExposures / count), trial.refined / count});
    }
    std::size_t number = chart.curves.size();
    if (points.empty()) continue;
    for (const charts::Point& point : points) {
      chart.x.low = std::min(chart.x.low, point.x / 1.3);
      chart.x.high = std::max(chart.x.high, point.x * 1.3);
      chart.y.low = std::min(chart.y.low, std::floor(2.0 * point.y - 0.2) / 2.0);
      chart.y.high = std::max(chart.y.high, std::ceil(2.0 * point.y + 0.2) / 2.0);
    }
    chart.curves.push_back(
        {titleOf(mode), styles[number % styles.size()], markers[number % markers.size()], points, points});
  }
  if (chart.curves.empty()) chart.x = chart.y = {};
  return charts::svgOf(chart, {extent, styleSheet});
}

}  // namespace relucent::report
