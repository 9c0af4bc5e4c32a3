// SPDX-License-Identifier: MIT
#include "relucent/pipeline/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/image/colour.h"
#include "relucent/pipeline/report_charts.h"
#include "relucent/pipeline/report_html.h"
#include "relucent/pipeline/report_measurement.h"
#include "relucent/pipeline/report_pictures.h"
#include "relucent/pipeline/report_style.h"

namespace relucent::pipeline {
namespace {

constexpr double deltaEScale = 20.0;  // right end of the error maps: far beyond what nobody could miss

double meanOf(const image::Image& values) {
  double sum = 0.0;
  double count = 0.0;
  for (float value : values.data())
    if (!std::isnan(value)) {
      sum += static_cast<double>(value);
      count += 1.0;
    }
  return sum / std::max(count, 1.0);
}

std::string head(const ReportData& data) {
  double seconds =
      data.result.seconds.linearization + data.result.seconds.acquisition + data.result.seconds.inverse;
  std::string cards =
      card("Photographs", grouped(static_cast<std::uint64_t>(std::max(0, data.result.exposures)))) +
      card("Time", duration(seconds)) + card("Connections of light", grouped(data.result.connections)) +
      card("Pixels flagged", percent(data.result.flaggedShare));
  if (data.evaluation) cards += card("Can be reached", percent(data.evaluation->reachable));
  return fmt::format(
      "<header><h1>{}</h1><p class=\"soft\">{}<br>Projector {} × {}, camera {} × {}. Measured {} by {}.</p>"
      "<dl class=\"cards\">{}</dl></header>\n",
      escaped(data.title), escaped(data.venue), data.projector.width, data.projector.height,
      data.camera.width, data.camera.height, escaped(data.measured), escaped(data.software), cards);
}

std::string findings(const ReportData& data) {
  std::string items;
  for (const Message& finding : data.result.findings)
    items += fmt::format("<li class=\"note amber\">{}</li>", escaped(englishSentence(finding)));
  if (items.empty())
    items = "<li class=\"note good\">Nothing stands out: the measurement is as it should be.</li>";
  return section("Findings", "", "<ul class=\"notes\">" + items + "</ul>");
}

std::string comparison(const ReportComparison& shown) {
  require(
      shown.wanted.size() == shown.uncompensated.size() && shown.wanted.size() == shown.compensated.size(),
      "the pictures of '{}' differ in size", shown.name);
  image::Image before = deltaEMap(shown.uncompensated, shown.wanted, shown.white, shown.inside);
  image::Image after = deltaEMap(shown.compensated, shown.wanted, shown.white, shown.inside);
  std::string bar = legend(image::ColourMap::cividis, {"0", "5", "10", "15", "20+"},
                           "Colour error from 0 to 20, CIEDE2000");
  std::string how = shown.truth ? "through the true light transport" : "predicted from the measurement";

  std::string body = "<div class=\"pictures\">";
  body += figure(image::viewed(shown.wanted, shown.white), "Wanted", "the picture as it should appear.");
  body +=
      figure(image::viewed(shown.uncompensated, shown.white), "Uncompensated", "only placed, " + how + ".");
  body += figure(image::viewed(shown.compensated, shown.white), "Compensated",
                 fmt::format("method {}, {}.", nameOf(shown.method), how));
  body += figure(painted(before, image::ColourMap::cividis, 0.0, deltaEScale), "Error uncompensated",
                 fmt::format("mean colour error ΔE {:.1f}.", meanOf(before)), bar);
  body += figure(painted(after, image::ColourMap::cividis, 0.0, deltaEScale), "Error compensated",
                 fmt::format("mean colour error ΔE {:.1f}.", meanOf(after)), bar);
  body += "<figure>" +
          histogram(before.data(), after.data(), deltaEScale, "Colour error ΔE (CIEDE2000)",
                    "Share of the pixels by colour error, uncompensated and compensated") +
          "<figcaption><b>Errors</b> further left is better.</figcaption></figure></div>";
  return section(
      "Before and after: " + shown.name,
      fmt::format("{} of the picture can be reached. An error ΔE of 1 is just visible side by side, 5 is "
                  "plain to see.",
                  percent(shown.reachable)),
      body);
}

/// Means over all images, in the order of the first.
std::vector<MethodScore> meanScores(const EvaluateResult& evaluation) {
  std::vector<MethodScore> means;
  for (const ImageScore& image : evaluation.images)
    for (const MethodScore& score : image.methods) {
      auto mean =
          std::find_if(means.begin(), means.end(), [&](const auto& m) { return m.method == score.method; });
      if (mean == means.end()) mean = means.insert(means.end(), MethodScore{score.method});
      auto share = 1.0 / static_cast<double>(evaluation.images.size());
      mean->psnrReachable += share * score.psnrReachable;
      mean->psnrAll += share * score.psnrAll;
      mean->ssim += share * score.ssim;
      mean->deltaE += share * score.deltaE;
      mean->seconds += share * score.seconds;
    }
  return means;
}

std::string verification(const ReportVerification& shown) {
  std::string body = "<div class=\"pictures\">" +
                     figure(shown.wanted, "Wanted", "the picture as it should appear.") +
                     figure(shown.before, "Photograph, uncompensated",
                            fmt::format("mean colour error ΔE {:.1f}.", shown.deltaEBefore)) +
                     figure(shown.after, "Photograph, compensated",
                            fmt::format("mean colour error ΔE {:.1f}.", shown.deltaEAfter)) +
                     "</div>";
  return section("Verification", fmt::format("Projected in the venue and photographed, {}.", shown.taken),
                 body);
}

std::string methodTable(const std::vector<MethodScore>& scores, double best) {
  std::string rows;
  for (const MethodScore& score : scores)
    rows += fmt::format(
        "<tr{}><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{:.3f}</td><td>{:.1f}</td><td>{}</td><td "
        "style=\"text-align:left;white-space:normal\">{}</td></tr>",
        score.psnrReachable == best ? " class=\"best\"" : "", nameOf(score.method),
        decibels(score.psnrReachable), decibels(score.psnrAll), score.ssim, score.deltaE,
        duration(score.seconds), escaped(std::string(descriptionOf(score.method))));
  return "<div class=\"scroll\"><table><caption>Mean over the pictures</caption><thead><tr><th "
         "scope=\"col\">Method</th><th scope=\"col\">PSNR, reachable</th><th scope=\"col\">PSNR, all</th><th "
         "scope=\"col\">SSIM</th><th scope=\"col\">Colour error ΔE</th><th scope=\"col\">Time a "
         "picture</th><th "
         "scope=\"col\" style=\"text-align:left\">What it does</th></tr></thead><tbody>" +
         rows + "</tbody></table></div>";
}

std::string methodComparison(const EvaluateResult& evaluation) {
  std::vector<MethodScore> scores = meanScores(evaluation);
  double best = -std::numeric_limits<double>::infinity();
  for (const MethodScore& score : scores) best = std::max(best, score.psnrReachable);
  std::vector<Bar> bars;
  for (const MethodScore& score : scores)
    bars.push_back({std::string(nameOf(score.method)), score.psnrReachable, decibels(score.psnrReachable),
                    score.psnrReachable == best});
  return section(
      "Methods compared",
      "Through the true light transport of the simulated venue, in linear light, where the picture can be "
      "reached. Three decibels more halve the squared error.",
      barChart(bars, "PSNR of each method") + methodTable(scores, best));
}

std::string limits() {
  return section(
      "What no compensation can do", "",
      "<ul><li><b>Not darker than black.</b> Room light and the projector's own black stay. Darken the room, "
      "or lift the "
      "blacks of the content.</li>"
      "<li><b>Not brighter than full.</b> Dark or steep surfaces and the rim of the picture get less light "
      "than the "
      "rest. A darker picture reaches more of the surface; more light or a second projector reaches all of "
      "it.</li>"
      "<li><b>No light in a shadow.</b> Where the projector does not reach, only bounced light can help.</li>"
      "<li><b>No colour that the surface swallows.</b> A saturated red wall returns almost no blue.</li>"
      "<li><b>No detail finer than the projector's pixels</b>, and less where the projector is out of "
      "focus.</li>"
      "<li><b>Right for one place.</b> Glossy surfaces look different from elsewhere: the camera's place is "
      "the sweet "
      "spot. Nothing may move afterwards.</li></ul>");
}

std::string settingsAndTimes(const ReportData& data) {
  const CalibrateResult& result = data.result;
  std::string times = fmt::format(
      "<div class=\"scroll\"><table><caption>Cost</caption><tbody>"
      "<tr><th scope=\"row\">Linearization</th><td>{}</td></tr><tr><th "
      "scope=\"row\">Acquisition</th><td>{}</td></tr>"
      "<tr><th scope=\"row\">Inverse</th><td>{}</td></tr><tr><th scope=\"row\">Patterns</th><td>{}</td></tr>"
      "<tr><th scope=\"row\">Photographs</th><td>{}</td></tr><tr><th scope=\"row\">Most memory "
      "used</th><td>{:.0f} MB"
      "</td></tr></tbody></table></div>",
      duration(result.seconds.linearization), duration(result.seconds.acquisition),
      duration(result.seconds.inverse), result.patterns, result.exposures,
      static_cast<double>(result.peakMemoryBytes) / 1e6);
  std::string rows;
  for (const StoredSetting& setting : data.settings)
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>", escaped(setting.name),
                        escaped(setting.value));
  std::string settings =
      rows.empty()
          ? ""
          : "<h3>Settings</h3><details><summary>All settings</summary><div class=\"scroll\"><table><tbody>" +
                rows + "</tbody></table></div></details>";
  std::string versions;
  for (const LibraryVersion& library : data.libraries)
    versions += (versions.empty() ? "" : ", ") + escaped(library.name + " " + library.version);
  if (!versions.empty())
    versions = fmt::format("<h3>Versions</h3><p>Written by Relucent {}, made with {}.</p>",
                           escaped(relucentVersion()), versions);
  return section("Settings and times", "", times + settings + versions);
}

}  // namespace

std::string reportHtml(const ReportData& data) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{} – Relucent "
      "report</title><style>{}</style></head><body>\n",
      escaped(data.title), reportStyle);
  html += head(data) + "<main>\n" + findings(data);
  if (data.verification) html += verification(*data.verification);
  for (const ReportComparison& shown : data.comparisons) html += comparison(shown);
  if (data.evaluation && !data.evaluation->images.empty()) html += methodComparison(*data.evaluation);
  html += measuredPictures(data) + responses(data) + transport(data) + limits() + settingsAndTimes(data);
  return html +
         "</main><footer>Relucent: projection on any surface as if it were a white "
         "screen.</footer></body></html>\n";
}

void writeReport(const std::filesystem::path& path, const ReportData& data) {
  writeFileAtomically(path, reportHtml(data));
}

}  // namespace relucent::pipeline
