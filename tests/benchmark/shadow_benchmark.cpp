// SPDX-License-Identifier: MIT
// relucent-shadow-benchmark: shadows of visitors that are filled in simulated venues: the figures of
// core/monitoring/README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "relucent/base/error.h"
#include "relucent/pipeline/shadow_rehearsal.h"

using namespace relucent;
using namespace relucent::pipeline;

namespace {

struct Options {
  std::string venue = "relief", projector = "48x36", camera = "40x30", content = "still", cache;
  std::vector<std::uint64_t> seeds{1};
  double minutes = 0.0, photographs = 10.0, every = 20.0;
  int paths = 64, steps = 2;
  bool isVerbose = false;
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

void tell(const ShadowRehearsalResult& result) {
  for (const ShadowedPicture& one : result.pictures)
    fmt::print(
        "  {:5.2f} s  {:4} pixels  filled {:6.2f}  unfilled {:6.2f}  possible {:6.2f}  alone {:6.2f}  beside "
        "{:5.2f} {:5.2f}  cells {}{}\n",
        one.seconds, one.shadowed, one.filled, one.unfilled, one.possible, one.unshadowed, one.beside,
        one.besideUnshadowed, one.cells, one.isOther ? " *" : "");
}

/// One shadow that comes and goes, for each projector and place.
void standing(ShadowRehearsal& rehearsal, const Options& options, std::size_t projector, double x) {
  constexpr double comes = 1.0, goes = 3.0;
  ShadowRehearsal::Run run{contentOf(options.content), 5.0, [=](double seconds) {
                             return seconds >= comes && seconds < goes
                                        ? std::vector<venue::Silhouette>{{projector, x, 0.6, 0.08, 0.3}}
                                        : std::vector<venue::Silhouette>{};
                           }};
  Progress quiet;
  const ShadowRehearsalResult result = rehearsal.run(run, quiet);
  if (options.isVerbose) tell(result);
  // Photographs from the first that shows the shadow until one that shows it filled; and until nothing is.
  int until = -1, back = -1, n = 0, away = 0, changes = 0;
  double before = 0.0, after = 0.0, possible = 0.0, alone = 0.0, beside = 0.0, besideAlone = 0.0, count = 0.0;
  for (const ShadowedPicture& one : result.pictures) {
    if (one.seconds >= comes && one.seconds < goes) {
      ++n;
      const double left = (one.filled - one.possible) / std::max(1e-9, one.unfilled - one.possible);
      if (until < 0 && left < 0.5) until = n;
      if (one.seconds > comes + 0.5) {
        before += one.unfilled;
        after += one.filled;
        alone += one.unshadowed;
        possible += one.possible;
        beside += one.beside;
        besideAlone += one.besideUnshadowed;
        changes += one.isOther;
        count += 1.0;
      }
    }
    if (one.seconds >= goes) {
      ++away;
      if (back < 0 && one.cells == 0) back = away;
    }
  }
  fmt::print(
      "projector {} at {:.2f}: photographs until filled {}, until taken back {}; dE {:.2f} -> {:.2f}, "
      "possible {:.2f}, alone {:.2f}; beside {:.2f}, alone {:.2f}; changes {}; "
      "false fills {}; {:.1f} ms a photograph, {:.1f} ms a frame's following\n",
      projector + 1, x, until, back, before / count, after / count, possible / count, alone / count,
      beside / count, besideAlone / count, changes, result.falseFills,
      1e3 * result.seconds / static_cast<double>(result.pictures.size()),
      1e3 * result.followSeconds / std::max(1, result.followed));
  std::fflush(stdout);
}

/// Minutes of visitors, or of nobody.
void walking(ShadowRehearsal& rehearsal, const Options& options, std::uint64_t seed, bool areThere,
             std::size_t projectors) {
  const venue::Visitors visitors({seed, options.every, projectors, 15.0});
  ShadowRehearsal::Run run{contentOf(options.content), 60.0 * options.minutes};
  if (areThere) run.inTheWay = [&](double seconds) { return visitors.at(seconds); };
  Progress quiet;
  const ShadowRehearsalResult result = rehearsal.run(run, quiet);
  if (options.isVerbose) tell(result);
  double filled = 0.0, unfilled = 0.0, alone = 0.0, pixels = 0.0, beside = 0.0, besideAlone = 0.0,
         possible = 0.0, all = 0.0, allUnfilled = 0.0;
  for (const ShadowedPicture& one : result.pictures) {
    const auto count = static_cast<double>(one.shadowed);
    filled += count * one.filled;
    unfilled += count * one.unfilled;
    alone += count * one.unshadowed;
    possible += count * one.possible;
    all += one.all / static_cast<double>(result.pictures.size());
    allUnfilled += one.allUnfilled / static_cast<double>(result.pictures.size());
    pixels += count;
    beside += one.beside / static_cast<double>(result.pictures.size());
    besideAlone += one.besideUnshadowed / static_cast<double>(result.pictures.size());
  }
  pixels = std::max(1.0, pixels);
  fmt::print(
      "{}: {} photographs, false fills {}; shadowed dE {:.2f} -> {:.2f}, possible {:.2f}, alone {:.2f}; "
      "beside {:.2f}, alone "
      "{:.2f}; all {:.2f} -> {:.2f}\n",
      areThere ? "visitors" : "nobody", result.pictures.size(), result.falseFills, unfilled / pixels,
      filled / pixels, possible / pixels, alone / pixels, beside, besideAlone, allUnfilled, all);
  std::fflush(stdout);
}

void benchmark(const Options& options) {
  ShadowRehearsalSettings settings;
  settings.venue.name = options.venue;
  settings.venue.projector = sizeOf(options.projector);
  settings.venue.camera = sizeOf(options.camera);
  settings.venue.pathsPerPixel = options.paths;
  settings.photographs = options.photographs;
  settings.steps = options.steps;
  Progress quiet;
  ShadowRehearsal rehearsal(settings, options.cache, quiet);
  std::size_t projectors = 1;
  for (const venue::VenueDescription& one : venue::venues())
    if (one.name == options.venue) projectors = static_cast<std::size_t>(one.projectors);
  for (std::uint64_t seed : options.seeds) {
    rehearsal.setSeed(seed);
    fmt::print("{}, {}, seed {}\n", options.venue, options.content, seed);
    if (options.minutes > 0.0) {
      for (bool areThere : {false, true}) walking(rehearsal, options, seed, areThere, projectors);
      continue;
    }
    for (std::size_t projector = 0; projector < projectors; ++projector)
      for (double x : {0.35, 0.65}) standing(rehearsal, options, projector, x);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fills shadows in simulated venues.");
  Options options;
  app.add_option("--venue", options.venue);
  app.add_option("--projector", options.projector);
  app.add_option("--camera", options.camera);
  app.add_option("--content", options.content, "still, film, dark or slides");
  app.add_option("--seed", options.seeds);
  app.add_option("--minutes", options.minutes, "of visitors and of nobody, instead of shadows that stand");
  app.add_option("--every", options.every, "seconds between visitors");
  app.add_option("--photographs", options.photographs, "a second");
  app.add_option("--paths", options.paths);
  app.add_option("--steps", options.steps);
  app.add_option("--cache", options.cache)->required();
  app.add_flag("--verbose", options.isVerbose);
  CLI11_PARSE(app, argc, argv);
  try {
    benchmark(options);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
