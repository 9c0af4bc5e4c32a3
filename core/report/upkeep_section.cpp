// SPDX-License-Identifier: MIT
#include "relucent/report/upkeep_section.h"

#include <fmt/format.h>

#include <ranges>

#include "relucent/report/number_text.h"

namespace relucent::report {
namespace {

std::string outcomeOf(const pipeline::NightRecord& night) {
  if (!night.skipped.empty()) return "skipped: " + englishSentence(night.skipped);
  std::string text = night.repair ? std::string(descriptionOf(*night.repair)) : "not looked at";
  for (const Message& what : night.what) text += "; " + english(what);
  if (night.perfected > 0)
    text += fmt::format("; {} {} perfected", night.perfected, night.perfected == 1 ? "picture" : "pictures");
  if (!night.alarm.empty()) text += ". Alarm: " + english(night.alarm);
  return text + ".";
}

std::string errorOf(const std::optional<pipeline::PictureError>& error) {
  return error ? fmt::format("{:.1f}", error->deltaE) : "–";
}

/// The view that gained least.
std::pair<double, double> deltaEOf(const pipeline::PerfectedFigures& figures) {
  std::pair<double, double> least{0.0, 0.0};
  const std::size_t views = std::min(figures.before.size(), figures.after.size());
  for (std::size_t view = 0; view < views; ++view) {
    const double before = figures.before[view].deltaE, after = figures.after[view].deltaE;
    if (view == 0 || before - after < least.first - least.second) least = {before, after};
  }
  return least;
}

}  // namespace

PageData upkeepSection(const ReportData& data) {
  PageData section, perfected(PageData::type::list), nights(PageData::type::list);
  for (const ReportPerfected& picture : data.perfected) {
    const auto [before, after] = deltaEOf(picture.figures);
    PageData row;
    row.set("picture", picture.name);
    row.set("when", localTime(picture.when));
    row.set("before", fmt::format("{:.1f}", before));
    row.set("after", fmt::format("{:.1f}", after));
    row.set("photographs", fmt::format("{}", picture.figures.photographs));
    perfected << row;
  }
  for (const pipeline::NightRecord& night : data.nights | std::views::reverse) {
    PageData row;
    row.set("when", localTime(night.when));
    row.set("outcome", outcomeOf(night));
    row.set("measured", errorOf(night.measured));
    row.set("predicted", errorOf(night.predicted));
    nights << row;
  }
  const auto table = [](const PageData& rows) {
    PageData one;
    one.set("rows", rows);
    return one;
  };
  if (!data.perfected.empty()) section.set("perfected", table(perfected));
  if (!data.nights.empty()) section.set("nights", table(nights));
  return section;
}

void addAlarm(const ReportData& data, PageData& warnings) {
  if (data.nights.empty() || data.nights.back().alarm.empty()) return;
  const pipeline::NightRecord& night = data.nights.back();
  warnings << PageData(
      fmt::format("Alarm of the night of {}: {}", localTime(night.when), englishSentence(night.alarm)));
}

}  // namespace relucent::report
