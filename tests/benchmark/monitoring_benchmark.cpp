// SPDX-License-Identifier: MIT
// relucent-monitoring-benchmark: after how long trouble is told while shows play in simulated venues, and
// what is told without a reason: the figures of core/monitoring/README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "relucent/base/error.h"
#include "relucent/pipeline/monitoring_rehearsal.h"

using namespace relucent;
using namespace relucent::pipeline;
using monitoring::FindingKind;

namespace {

struct Options {
  std::string venue = "statue", projector = "40x30", camera = "32x24", cache;
  std::vector<std::string> contents{"still", "film", "slides"};
  std::vector<std::uint64_t> seeds{1};
  double hours = 0.0, interval = 2.0, every = 60.0;
  int paths = 64;
};

Size sizeOf(const std::string& text) {
  Size size;
  if (std::sscanf(text.c_str(), "%dx%d", &size.width, &size.height) != 2)
    throw Error(ErrorKind::usage, Message::plain("a size is WIDTHxHEIGHT"), Message::plain("write 48x36"));
  return size;
}

ShownContent contentOf(const std::string& name) {
  for (const auto& one : shownContentNames)
    if (name == one.name) return one.value;
  throw Error(ErrorKind::usage, Message::plain("no such content"),
              Message::plain("still, film, dark or slides"));
}

struct Trouble {
  const char* name;
  RehearsedTrouble what;
};

RehearsedTrouble moved(double x, double y) {
  RehearsedTrouble trouble{.expected = FindingKind::moved};
  trouble.changes.emplace().cameras = {{0, x, y, 0.0}};
  return trouble;
}

/// Of the last projector what is left, of all others everything.
RehearsedTrouble lamps(std::size_t projectors, float left, FindingKind expected) {
  RehearsedTrouble trouble{.expected = expected};
  trouble.lamps.assign(projectors, {1.0f, 1.0f, 1.0f});
  trouble.lamps.back() = {left, left, left};
  return trouble;
}

RehearsedTrouble shadow() {
  RehearsedTrouble trouble{.expected = FindingKind::shadowed};
  trouble.shadows = {{0, 0.4, 0.5, 0.1, 0.18}};
  return trouble;
}

std::vector<Trouble> troublesOf(std::size_t projectors) {
  return {{"moved by 0.3 pixels across", moved(0.3, 0.0)},
          {"moved by 0.3 pixels askew", moved(0.21, -0.21)},
          {"a lamp faded by 5 %", lamps(projectors, 0.95f, FindingKind::faded)},
          {"a shadow that stays", shadow()},
          {"a projector dead", lamps(projectors, 0.0f, FindingKind::dark)}};
}

void tellAll(const std::vector<ToldFinding>& told) {
  for (const ToldFinding& one : told)
    fmt::print("    after {:.0f} s: {}\n", one.seconds, english(sentenceOf(one.finding)));
}

/// Each trouble by itself.
void trouble(MonitoringRehearsal& rehearsal, const std::string& content, std::size_t projectors) {
  constexpr double minutesAfter = 2.0;
  Progress quiet;
  for (const auto& [name, what] : troublesOf(projectors)) {
    const RehearsalResult result =
        rehearsal.run(contentOf(content), what.at + 60.0 * minutesAfter, what, {}, quiet);
    const std::optional<double> after = result.toldAfter(what);
    const std::vector<ToldFinding> others = result.falseAlarms(what);
    fmt::print("  {}, {}: {}{}\n", content, name, after ? fmt::format("{:.0f} s", *after) : "not told",
               others.empty() ? "" : ", beside it:");
    tellAll(others);
    std::fflush(stdout);
  }
}

/// Hours without any, with dusk and a lamp that loses 2 %.
void day(MonitoringRehearsal& rehearsal, const std::string& content, double hours) {
  Progress quiet;
  const RehearsalResult result =
      rehearsal.run(contentOf(content), 3600.0 * hours, {.at = 1e12}, {0.02, 0.9}, quiet);
  fmt::print("  {}, {:g} hours: {} photographs, {} used, {:.1f} ms each; told {}\n", content, hours,
             result.photographs, result.used, 1e3 * result.seconds / std::max(1, result.photographs),
             result.told.size());
  tellAll(result.told);
  std::fflush(stdout);
}

void benchmark(const Options& options) {
  RehearsalSettings settings;
  settings.venue.name = options.venue;
  settings.venue.projector = sizeOf(options.projector);
  settings.venue.camera = sizeOf(options.camera);
  settings.venue.pathsPerPixel = options.paths;
  settings.interval = options.interval;
  settings.visitorsEvery = options.every;
  Progress quiet;
  MonitoringRehearsal rehearsal(settings, options.cache, quiet);
  std::size_t projectors = 1;
  for (const venue::VenueDescription& one : venue::venues())
    if (one.name == options.venue) projectors = static_cast<std::size_t>(one.projectors);
  for (std::uint64_t seed : options.seeds) {
    rehearsal.setSeed(seed);
    fmt::print("{} {} / {}, seed {}\n", options.venue, options.projector, options.camera, seed);
    for (const std::string& content : options.contents)
      if (options.hours > 0.0)
        day(rehearsal, content, options.hours);
      else
        trouble(rehearsal, content, projectors);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Watches shows in simulated venues.");
  Options options;
  app.add_option("--venue", options.venue);
  app.add_option("--projector", options.projector);
  app.add_option("--camera", options.camera);
  app.add_option("--content", options.contents, "still, film, dark, slides");
  app.add_option("--seed", options.seeds);
  app.add_option("--hours", options.hours, "of a day without trouble, instead of troubles");
  app.add_option("--interval", options.interval, "seconds between photographs");
  app.add_option("--every", options.every, "seconds between visitors; 0: there are none");
  app.add_option("--paths", options.paths);
  app.add_option("--cache", options.cache)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    benchmark(options);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
