// SPDX-License-Identifier: MIT
#include "relucent/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relucent/base/require.h"
#include "relucent/charts/svg.h"
#include "relucent/image/colour.h"
#include "relucent/image/colour_map.h"
#include "relucent/report/measured_charts.h"
#include "relucent/report/number_text.h"
#include "relucent/report/pictures.h"
#include "relucent/report/proof_sections.h"
#include "relucent/report/templates.h"
#include "relucent/report/upkeep_section.h"

namespace relucent::report {
namespace {

using Data = PageData;

constexpr double deltaEScale = 20.0;     // right end of the error maps: far beyond what nobody could miss
constexpr double leastReachable = 0.95;  // of a picture: the wizard places content so that more is in reach
const charts::Drawing chartDrawing{{470.0, 300.0}};

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

std::string sizeText(Size size) {
  return fmt::format("{} × {}", size.width, size.height);
}

/// What it was measured with.
std::string devicesText(const ReportData& data) {
  const auto several = [](std::size_t count, const char* name, Size first) {
    return fmt::format("{} {}, the first {}", count, name, sizeText(first));
  };
  const std::string projector = data.projectors == 1 ? "Projector " + sizeText(data.projector)
                                                     : several(data.projectors, "projectors", data.projector);
  const std::string camera =
      data.cameras == 1 ? "camera " + sizeText(data.camera) : several(data.cameras, "cameras", data.camera);
  return projector + (data.projectors == 1 && data.cameras == 1 ? ", " : "; ") + camera;
}

std::uint64_t atLeastNone(int count) {
  return static_cast<std::uint64_t>(std::max(0, count));
}

/// Of all steps, and of the last repair.
calibration::StageCost costOf(const ReportData& data) {
  const pipeline::CalibrateResult& result = data.result;
  calibration::StageCost cost{
      result.seconds.linearization + result.seconds.acquisition + result.seconds.inverse, result.patterns,
      result.exposures};
  if (data.repaired) {
    cost.seconds += data.repaired->cost.seconds;
    cost.patterns += data.repaired->cost.patterns;
    cost.exposures += data.repaired->cost.exposures;
  }
  return cost;
}

Data cards(const ReportData& data) {
  const pipeline::CalibrateResult& result = data.result;
  const calibration::StageCost together = costOf(data);
  Data list(Data::type::list);
  list << named("Photographs, all steps", grouped(atLeastNone(together.exposures)))
       << named("Time, all steps", stageDuration(together.seconds))
       << named("Connections of light", grouped(result.connections))
       << named("Unreliable pixels", percent(result.flaggedShare));
  if (data.evaluation) list << named("Can be reached", percent(data.evaluation->reachable));
  return list;
}

/// Advice for whoever measures; a client reads what it means.
bool isAboutStopping(const Message& finding) {
  return finding.id().starts_with("acquisition.stopped-");
}

/// What most of it is that cannot be reached.
const char* stays(const ReportComparison& shown) {
  const bool isBright = shown.unreachable && shown.unreachable->tooBright > shown.unreachable->tooDark;
  return isBright ? "brighter than it should: black level and room light" : "darker than it should";
}

std::string repairSentence(const ReportRepair& repair) {
  std::string what;
  for (const Message& message : repair.what) what += englishSentence(message) + " ";
  return fmt::format(
      "Repaired on {}: the calibration was made to fit what had changed. {}The mean colour error ΔE of a "
      "photographed picture went from {:.1f} to {:.1f}.",
      localTime(repair.when), what, repair.deltaEBefore, repair.deltaEAfter);
}

/// With a capital, but for a device's address, "genicam:RL01".
std::string fullSentence(const Message& message) {
  std::string text = englishSentence(message);
  const std::size_t colon = text.find(':'), space = text.find(' ');
  const bool isAddress = colon != std::string::npos && colon + 1 < space;
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z' && !isAddress)
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// What stands out, and what was proved.
void setFindings(Data& page, const ReportData& data) {
  Data warnings(Data::type::list), assurances(Data::type::list);
  addAlarm(data, warnings);
  addVerdicts(data, warnings, assurances);
  if (data.repaired) assurances << Data(repairSentence(*data.repaired));
  for (const Message& finding : data.result.findings)
    if (!isAboutStopping(finding)) warnings << Data(fullSentence(finding));
  if (const int blocks = data.stoppedAt; blocks > 0)
    warnings << Data(fmt::format(
        "Measured coarsely: down to blocks of {0} × {0} pixels of the projector. Finer detail of the "
        "surface is not corrected.",
        blocks));
  for (const ReportComparison& shown : data.comparisons)
    if (shown.reachable < leastReachable)
      warnings << Data(fmt::format("{} of “{}” cannot be reached and stays {}.",
                                   percent(1.0 - shown.reachable), shown.name, stays(shown)));
  page.set("findings", warnings);
  page.set("assurances", assurances);
}

Data comparison(const ReportComparison& shown) {
  require(
      shown.wanted.size() == shown.uncompensated.size() && shown.wanted.size() == shown.compensated.size(),
      "the pictures of '{}' differ in size", shown.name);
  image::Image before = deltaEMap(shown.uncompensated, shown.wanted, shown.white, shown.inside);
  image::Image after = deltaEMap(shown.compensated, shown.wanted, shown.white, shown.inside);
  std::string bar = charts::colourBarSvg(image::ColourMap::cividis, {"0", "5", "10", "15", "20+"},
                                         "Colour error from 0 to 20, CIEDE2000");
  std::string how = shown.truth ? "through the true light transport" : "predicted from the measurement";
  auto errors = [&](const image::Image& map, const char* name) {
    return figure(painted(map, image::ColourMap::cividis, 0.0, deltaEScale), name,
                  fmt::format("mean colour error ΔE {:.1f}.", meanOf(map)), bar);
  };
  Data figures(Data::type::list);
  figures << figure(image::viewed(shown.wanted, shown.white), "Wanted", "the picture as it should appear.")
          << figure(image::viewed(shown.uncompensated, shown.white), "Uncompensated",
                    "only placed, " + how + ".")
          << figure(image::viewed(shown.compensated, shown.white), "Compensated", how + ".")
          << errors(before, "Error uncompensated") << errors(after, "Error compensated");
  Data section;
  section.set("name", shown.name);
  section.set("reachable", percent(shown.reachable));
  if (shown.uncertainty) section.set("uncertainty", percent(*shown.uncertainty));
  section.set("figures", figures);
  section.set("histogram", charts::svgOf(histogram(before.data(), after.data(), deltaEScale,
                                                   "Colour error ΔE (CIEDE2000)"),
                                         chartDrawing));
  return section;
}

/// Means over all images, in the order of the first; over those of which anything can be reached, where that
/// counts.
std::vector<pipeline::MethodScore> meanScores(const pipeline::EvaluateResult& evaluation) {
  std::vector<pipeline::MethodScore> means;
  const auto reached =
      std::ranges::count_if(evaluation.images, [](const auto& image) { return image.reachable > 0.0; });
  for (const pipeline::ImageScore& image : evaluation.images)
    for (const pipeline::MethodScore& score : image.methods) {
      auto mean =
          std::find_if(means.begin(), means.end(), [&](const auto& m) { return m.method == score.method; });
      if (mean == means.end()) mean = means.insert(means.end(), pipeline::MethodScore{score.method});
      auto share = 1.0 / static_cast<double>(evaluation.images.size());
      if (image.reachable > 0.0) mean->psnrReachable += score.psnrReachable / static_cast<double>(reached);
      mean->psnrAll += share * score.psnrAll;
      mean->encodedPsnrAll += share * score.encodedPsnrAll;
      mean->ssim += share * score.ssim;
      mean->multiScaleSsim += share * score.multiScaleSsim;
      mean->deltaE += share * score.deltaE;
      mean->deltaEPercentile += share * score.deltaEPercentile;
      mean->seconds += share * score.seconds;
    }
  return means;
}

Data methods(const pipeline::EvaluateResult& evaluation) {
  std::vector<pipeline::MethodScore> scores = meanScores(evaluation);
  double best = -std::numeric_limits<double>::infinity();
  for (const pipeline::MethodScore& score : scores) best = std::max(best, score.psnrReachable);
  std::vector<charts::Bar> bars;
  Data rows(Data::type::list);
  for (const pipeline::MethodScore& score : scores) {
    bool isBest = score.psnrReachable == best;
    bars.push_back(
        {std::string(nameOf(score.method)), score.psnrReachable, decibels(score.psnrReachable), isBest});
    Data row;
    row.set("best", isBest);
    row.set("method", std::string(nameOf(score.method)));
    row.set("psnrReachable", decibels(score.psnrReachable));
    row.set("psnrAll", decibels(score.psnrAll));
    row.set("encodedPsnr", decibels(score.encodedPsnrAll));
    row.set("ssim", fmt::format("{:.3f}", score.ssim));
    row.set("multiScaleSsim", fmt::format("{:.3f}", score.multiScaleSsim));
    row.set("deltaE", fmt::format("{:.1f}", score.deltaE));
    row.set("deltaEPercentile", fmt::format("{:.1f}", score.deltaEPercentile));
    row.set("time", duration(score.seconds));
    row.set("description", std::string(descriptionOf(score.method)));
    rows << row;
  }
  Data section;
  section.set("chart", charts::svgOf(bars, "PSNR of each method"));
  section.set("rows", rows);
  return section;
}

/// By how much the black level is brightened beside the floodlight image, a round number, so that both can be
/// seen and told apart: as much as leaves its brightest places within the picture.
double brightening(const image::Image& black, const std::array<float, 3>& white) {
  const std::array<float, 3> brightest = percentileWhite(black, 0.99);
  double share = 0.0;
  for (std::size_t c = 0; c < 3; ++c) share = std::max(share, static_cast<double>(brightest[c] / white[c]));
  double times = 1.0;
  for (double decade = 1.0; decade < 1e6; decade *= 10.0)
    for (double digit : {1.0, 2.0, 5.0})
      if (digit * decade * share <= 1.0) times = digit * decade;
  return times;
}

/// Floodlight image, reachable light, black level and flagged pixels.
Data measuredPictures(const ReportData& data) {
  std::array<float, 3> white =
      data.comparisons.empty() ? percentileWhite(data.flood, 0.85) : data.comparisons.front().white;
  image::Image reach = reachableLight(data.flood, data.black, white);
  for (float& value : reach.data()) value = value > 0.0f ? std::log2(value) : -100.0f;

  const std::array<float, 3> full = percentileWhite(data.flood, 0.99);
  Data figures(Data::type::list);
  figures << figure(image::viewed(data.flood, full), "Floodlight image",
                    "what the camera sees when every pixel of the projector is fully lit.")
          << figure(painted(reach, image::ColourMap::viridis, -4.0, 2.0), "Reachable light",
                    "the brightest that each place can get, in the colour that is hardest there; 1 is the "
                    "picture's white.",
                    charts::colourBarSvg(image::ColourMap::viridis, {"1/16", "1/4", "1", "4"},
                                         "Reachable light from 1/16 to 4 times white"));
  if (!data.black.empty()) {
    const double times = brightening(data.black, full);
    std::array<float, 3> dim = full;
    for (float& value : dim) value /= static_cast<float>(times);
    figures << figure(
        image::viewed(data.black, dim), "Black level",
        (times > 1.0
             ? fmt::format(
                   "room light and the projector's black, shown {} times as bright as in the floodlight "
                   "image: ",
                   grouped(static_cast<std::uint64_t>(times)))
             : std::string("room light and the projector's black, as bright as in the floodlight image: ")) +
            "nothing can be darker than this.");
  }
  if (data.flagged.size() == data.flood.pixels()) {
    image::Image mask(data.flood.size(), 1);
    for (std::size_t i = 0; i < data.flagged.size(); ++i) mask.data()[i] = data.flagged[i] != 0 ? 1.0f : 0.0f;
    figures << figure(
        painted(mask, image::ColourMap::cividis, 0.0, 1.0), "Flagged pixels",
        fmt::format("bright: {} of the camera's pixels did not pass the verification and are not relied on.",
                    percent(data.result.flaggedShare)));
  }
  Data section;
  section.set("figures", figures);
  return section;
}

/// The projectors' response curves, additivity and exposures.
Data response(const ReportData& data) {
  Data projectors(Data::type::list);
  for (std::size_t projector = 0; projector < data.responses.size(); ++projector) {
    std::string name = fmt::format("Response of projector {}", projector + 1);
    Data item;
    item.set("name", name);
    item.set("chart", charts::svgOf(responseChart(data.responses[projector], name), chartDrawing));
    if (projector < data.additivityError.size())
      item.set("additivity", percent(data.additivityError[projector]));
    projectors << item;
  }
  std::string times;
  for (double exposure : data.exposures) times += (times.empty() ? "" : ", ") + exposureTime(exposure);
  Data section;
  section.set("projectors", projectors);
  if (!times.empty()) section.set("exposures", times);
  return section;
}

std::string levelBars(const std::vector<std::uint64_t>& leavesPerLevel) {
  std::vector<charts::Bar> bars;
  for (std::size_t level = 0; level < leavesPerLevel.size(); ++level)
    bars.push_back({level == 0 ? "single pixels" : fmt::format("{0} × {0}", 1ULL << level),
                    std::log10(1.0 + static_cast<double>(leavesPerLevel[level])),
                    grouped(leavesPerLevel[level]), level == 0});
  return charts::svgOf(bars, "Connections of light by the size of their blocks");
}

/// What was tried to find how strongly the inverse has to be damped.
Data ridge(const ReportData& data) {
  std::vector<charts::Bar> bars;
  for (const compensation::RidgeTrial& trial : data.ridgeCurve)
    bars.push_back({fmt::format("{:.3g}", trial.ridge), std::max(0.0, trial.psnr),
                    fmt::format("{:.2f} dB", trial.psnr), trial.ridge == data.ridge});
  Data section;
  section.set("used", fmt::format("{:.3g}", data.ridge));
  section.set("chart", charts::svgOf(bars, "PSNR by how strongly the correction is damped"));
  return section;
}

/// T in figures: connections, leaves by block size, damping of the inverse, and errors where the truth is
/// known.
void setTransport(Data& page, const ReportData& data) {
  page.set("connections", grouped(data.result.connections));
  page.set("leaves", grouped(data.result.leaves));
  // Noise may find a little more light than there is.
  page.set("unresolved", percent(std::max(0.0, data.result.unresolvedEnergy)));
  page.set("verificationError", percent(data.result.verificationError));
  if (data.evaluation) {
    Data truth;
    truth.set("frobenius", percent(data.evaluation->transport.frobenius));
    truth.set("natural", percent(data.evaluation->transport.relightNatural));
    truth.set("random", percent(data.evaluation->transport.relightRandom));
    page.set("truth", truth);
  }
  if (!data.leavesPerLevel.empty()) page.set("levels", levelBars(data.leavesPerLevel));
  if (!data.ridgeCurve.empty()) page.set("ridge", ridge(data));
  page.set("hasDetails", !data.leavesPerLevel.empty() || !data.ridgeCurve.empty());
}

void setSettingsAndTimes(Data& page, const ReportData& data) {
  const pipeline::CalibrateResult& result = data.result;
  Data costs(Data::type::list);
  // By the steps that measured them, each as its page in the program counts it.
  const auto step = [](const calibration::StageCost& cost) {
    return fmt::format("{}, {} patterns, {} photographs", stageDuration(cost.seconds),
                       grouped(atLeastNone(cost.patterns)), grouped(atLeastNone(cost.exposures)));
  };
  costs << named("Colours and brightness (Linearize)",
                 step({result.seconds.linearization, data.linearizationPatterns,
                       result.linearizationExposures}))
        << named("Light transport (Acquire), with its checks and test patterns",
                 step({result.seconds.acquisition, result.patterns - data.linearizationPatterns,
                       result.exposures - result.linearizationExposures}))
        << named("Computing the correction", stageDuration(result.seconds.inverse));
  if (data.repaired) costs << named("Repair", step(data.repaired->cost));
  costs << named("Together", step(costOf(data)));
  // The wizard does not record it.
  if (result.peakMemoryBytes > 0)
    costs << named("Most memory used",
                   fmt::format("{:.0f} MB", static_cast<double>(result.peakMemoryBytes) / 1e6));
  page.set("costs", costs);
  Data rows(Data::type::list);
  for (const NamedText& setting : data.settings) rows << named(setting.name, setting.value);
  if (!rows.is_empty_list()) {
    Data settings;
    settings.set("rows", rows);
    page.set("settings", settings);
  }
  std::string libraries;
  for (const pipeline::LibraryVersion& library : data.libraries)
    libraries += (libraries.empty() ? "" : ", ") + library.name + " " + library.version;
  if (!libraries.empty()) {
    Data versions;
    versions.set("relucent", pipeline::relucentVersion());
    versions.set("libraries", libraries);
    page.set("versions", versions);
  }
}

}  // namespace

Data pageOf(const ReportData& data) {
  Data page;
  page.set("style", std::string(templates::style));
  page.set("figure", kainjow::mustache::partial([] { return std::string(templates::figure); }));
  page.set("title", data.title);
  page.set("venue", data.venue);
  page.set("devices", devicesText(data));
  page.set("measured", localTime(data.measured));
  page.set("repaired", data.repaired.has_value());
  page.set("software", data.software);
  page.set("cards", cards(data));
  setFindings(page, data);
  if (data.verification) page.set("verification", verificationSection(data));
  if (!data.perfected.empty() || !data.nights.empty()) page.set("upkeep", upkeepSection(data));
  Data comparisons(Data::type::list);
  for (const ReportComparison& shown : data.comparisons) comparisons << comparison(shown);
  page.set("comparisons", comparisons);
  if (data.evaluation && !data.evaluation->images.empty()) page.set("methods", methods(*data.evaluation));
  if (!data.flood.empty()) page.set("measuredPictures", measuredPictures(data));
  if (!data.responses.empty()) page.set("response", response(data));
  setTransport(page, data);
  setSettingsAndTimes(page, data);
  return page;
}

}  // namespace relucent::report
