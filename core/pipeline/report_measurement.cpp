// SPDX-License-Identifier: MIT
#include "relucent/pipeline/report_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/image/colour.h"
#include "relucent/pipeline/report_charts.h"
#include "relucent/pipeline/report_html.h"
#include "relucent/pipeline/report_pictures.h"

namespace relucent::pipeline {
namespace {

/// What was tried to find how strongly the inverse has to be damped.
std::string ridge(const ReportData& data) {
  if (data.ridgeCurve.empty()) return "";
  std::vector<Bar> bars;
  for (const compensation::RidgeTrial& trial : data.ridgeCurve)
    bars.push_back({fmt::format("{:.3g}", trial.ridge), std::max(0.0, trial.psnr),
                    fmt::format("{:.2f} dB", trial.psnr), trial.ridge == data.ridge});
  return fmt::format(
      "<h3>Damping of the inverse</h3><p>Pictures were compensated with several dampings and sent through "
      "the "
      "measured transport; {:.3g} is used, the strongest that is as good as the best.</p>{}",
      data.ridge, barChart(bars, "PSNR by damping of the inverse"));
}

}  // namespace

std::string measuredPictures(const ReportData& data) {
  if (data.flood.empty()) return {};
  std::array<float, 3> white =
      data.comparisons.empty() ? percentileWhite(data.flood, 0.85) : data.comparisons.front().white;
  image::Image reach = reachableLight(data.flood, data.black, white);
  for (float& value : reach.data()) value = value > 0.0f ? std::log2(value) : -100.0f;

  std::string body = "<div class=\"pictures\">";
  body += figure(image::viewed(data.flood, percentileWhite(data.flood, 0.99)), "Floodlight image",
                 "what the camera sees when every pixel of the projector is fully lit.");
  body +=
      figure(painted(reach, image::ColourMap::viridis, -4.0, 2.0), "Reachable light",
             "the brightest that each place can get, in the colour that is hardest there; 1 is the picture's "
             "white.",
             legend(image::ColourMap::viridis, {"1/16", "1/4", "1", "4"},
                    "Reachable light from 1/16 to 4 times white"));
  if (!data.black.empty())
    body += figure(
        image::viewed(data.black, percentileWhite(data.black, 0.99)), "Black level",
        "room light and the projector's black, brightened to be seen: nothing can be darker than this.");
  if (data.flagged.size() == data.flood.pixels()) {
    image::Image mask(data.flood.size(), 1);
    for (std::size_t i = 0; i < data.flagged.size(); ++i) mask.data()[i] = data.flagged[i] != 0 ? 1.0f : 0.0f;
    body += figure(
        painted(mask, image::ColourMap::cividis, 0.0, 1.0), "Flagged pixels",
        fmt::format("bright: {} of the camera's pixels did not pass the verification and are not relied "
                    "on.",
                    percent(data.result.flaggedShare)));
  }
  return section("What the camera measured", "", body + "</div>");
}

std::string responses(const ReportData& data) {
  if (data.responses.empty()) return {};
  std::string body = "<div class=\"charts\">";
  for (std::size_t projector = 0; projector < data.responses.size(); ++projector) {
    std::string title = fmt::format("Response of projector {}", projector + 1);
    body += "<div><h3>" + title + "</h3>" + responseChart(data.responses[projector], title);
    if (projector < data.additivityError.size())
      body += fmt::format(
          "<p>Red, green and blue together differ from white by at most {}. Up to 2 % is good; more "
          "means a white segment or a picture mode in the projector's menu.</p>",
          percent(data.additivityError[projector]));
    body += "</div>";
  }
  std::string times;
  for (double exposure : data.exposures)
    times += (times.empty() ? "" : ", ") + fmt::format("{:.4g} s", exposure);
  if (!times.empty()) body += "<div><h3>Exposures</h3><p>" + times + "</p></div>";
  return section("Response of the projector", "How much light each level sent to the projector really gives.",
                 body + "</div>");
}

std::string transport(const ReportData& data) {
  std::vector<Bar> bars;
  for (std::size_t level = 0; level < data.leavesPerLevel.size(); ++level)
    bars.push_back({level == 0 ? "single pixels" : fmt::format("{0} × {0}", 1ULL << level),
                    std::log10(1.0 + static_cast<double>(data.leavesPerLevel[level])),
                    grouped(data.leavesPerLevel[level]), level == 0});
  std::string chart = bars.empty() ? ""
                                   : "<h3>Leaves by block size (logarithmic)</h3>" +
                                         barChart(bars, "Stored blocks of the light transport by their size");
  chart += ridge(data);
  std::string truth;
  if (data.evaluation)
    truth = fmt::format(
        "<p>Compared with the true transport: relative error {}, relighting a photograph {}, relighting "
        "noise {}.</p>",
        percent(data.evaluation->transport.frobenius), percent(data.evaluation->transport.relightNatural),
        percent(data.evaluation->transport.relightRandom));
  return section(
      "The light transport",
      "Every connection from a projector pixel to a camera pixel. Sharp light is kept pixel by pixel, light "
      "that arrives evenly from a wide area as one block.",
      fmt::format("<p>{} connections in {} stored blocks. {} of the light could not be attributed; held-out "
                  "patterns were predicted to within {}.</p>{}{}",
                  grouped(data.result.connections), grouped(data.result.leaves),
                  percent(data.result.unresolvedEnergy), percent(data.result.verificationError), truth,
                  chart));
}

}  // namespace relucent::pipeline
