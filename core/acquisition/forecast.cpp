// SPDX-License-Identifier: MIT
#include "relucent/acquisition/forecast.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "relucent/acquisition/children.h"
#include "relucent/multiplexing/row.h"
#include "relucent/transport/node_layout.h"

namespace relucent::acquisition {
namespace {

constexpr PatternRange usualColours{3.0, 30.0, 100.0};
// A finer level's footprints are more compact than the last one's: fewer conflicts, at worst some more.
constexpr PatternRange nextColours{0.2, 0.7, 1.5};
// A level of which more blocks than this have a colour of their own says nothing about the next.
constexpr double limitedByBlocks = 0.5;
constexpr int enoughShots = 40;
constexpr double enoughPatterns = 20.0;
// Of dense patterns, at the first level, the following ones and the finest; what venues took at 0.012.
constexpr struct {
  PatternRange first, middle, finest;
} densePatterns{{32.0, 32.0, 64.0}, {8.0, 14.0, 40.0}, {16.0, 40.0, 96.0}};
// How they grow with the threshold, and the fewest of a level.
constexpr double densePower = -0.5;
constexpr double fewestDense = 8.0;
// Shots of black and the reference picture: before and after levels, and between so many patterns.
constexpr double denseChecks = 10.0, densePatternsACheck = 25.0;
// Of four dense patterns one at most has another exposure.
constexpr double denseExposures = 1.2;

constexpr double leavesPerPixel = 120.0;
constexpr double bytesPerLeaf = 22.0;
// The level under way: some 40 active pairs a camera pixel, each with 4 children of 36 bytes.
constexpr double childrenBytes = 40.0 * 4.0 * 36.0;
// Between dense patterns rows are solved for: of a measurement in all, on two processors of an older laptop.
constexpr double denseComputing = 1.2e-3;  // seconds a camera pixel

// Of dense patterns: T and rows of a camera pixel, the patterns' means of a projector pixel. Both have a
// camera pixel's colours of near and far light of each projector. What else there is of a row: its
// references, and a mark for each leaf while the level's are divided.
constexpr double denseLeaves = 75.0;
constexpr double denseKeptLeaves = 25.0;  // once neighbours share them
constexpr double denseBytesPerLeaf = 10.0;
constexpr double coloursBytes = 2.0 * 36.0;
constexpr double rowBytesPerLeaf = 12.0;
constexpr double besideRowBytes = 200.0 + denseLeaves;
constexpr double meansBytes = 300.0;
// Of a camera pixel's photograph as it is stored: half of three 16-bit codes.
constexpr double compressedBytes = 3.0;
constexpr double programBytes = 60e6;
constexpr double framesInMemory = 8.0;  // radiance, variance, validity of merged brackets, and raw ones

double blocksOf(const transport::NodeLayout& layout, int level) {
  double blocks = 0.0;
  for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector)
    if (level < layout.levels(projector))
      blocks += static_cast<double>(layout.gridSize(projector, level).count());
  return blocks;
}

/// Shots of black and the reference picture during that many patterns: a pair before every `interval` but the
/// first, as Watch does.
double checksWithin(double patterns, int interval) {
  return 2.0 * std::max(0.0, std::floor((patterns - 1.0) / std::max(1, interval)));
}

std::vector<PatternRange> densePatternsOf(const Rasters& projectors, double threshold,
                                          std::span<const int> known) {
  static const double usual = settingsOf(AcquisitionMode::multiplexed).relativeThreshold;
  double factor = threshold > 0.0 ? std::pow(threshold / usual, densePower) : 1.0;
  auto scaled = [&](const PatternRange& range) {
    return PatternRange{range.least, std::max(fewestDense, factor * range.likely),
                        std::max(fewestDense, factor * range.most)};
  };
  transport::NodeLayout layout(projectors);
  std::vector<PatternRange> patterns;
  for (int level = multiplexing::startingLevel(layout); level >= 0; --level) {
    if (patterns.size() < known.size()) {
      double count = known[patterns.size()];
      patterns.push_back({count, count, count});
    } else {
      patterns.push_back(patterns.empty() ? densePatterns.first
                         : level > 0      ? scaled(densePatterns.middle)
                                          : scaled(densePatterns.finest));
    }
  }
  return patterns;
}

/// Shots of the checks among so many dense patterns, and patterns among so many shots that are either.
///   checks = 10 + patterns / 25
double denseChecksAmong(double patterns) {
  return denseChecks + patterns / densePatternsACheck;
}
double patternsAmong(double shots) {
  return std::max(0.0, (shots - denseChecks) / (1.0 + 1.0 / densePatternsACheck));
}

/// What is still to be photographed by one camera, and how long each of it is exposed on average.
struct Photographs {
  double count = 0.0, meanExposure = 0.0;
};

/// Of dense patterns: references and checks have all exposures, the patterns between them few. Of those what
/// was seen so far counts, as far as these shots were taken, not read.
///   count = exposures * references and checks + exposures a pattern * patterns
Photographs densePhotographsLeft(const ForecastDevices& devices, double references, double all, double left,
                                 const AcquisitionState& state) {
  const auto whole = static_cast<double>(devices.exposures), shots = static_cast<double>(state.shots);
  // The checks come evenly.
  const double checks = denseChecksAmong(patternsAmong(all - references));
  const double through = std::clamp((shots - references) / (all - references), 0.0, 1.0);
  const double seen = std::min(shots, references) + checks * through;
  const double bracketed = std::clamp(references + checks - seen, 0.0, left);
  double each = std::min(denseExposures, whole), exposure = devices.meanExposure;
  const double patterns = state.times.shots - seen;
  if (state.times.shots >= state.shots && patterns >= enoughPatterns) {
    const auto cameras = static_cast<double>(devices.cameras.devices());
    const double taken = static_cast<double>(state.times.exposures) / cameras - whole * seen;
    const double asked = state.times.asked / cameras - whole * devices.meanExposure * seen;
    each = std::clamp(taken / patterns, 1.0, whole);
    if (taken > 0.0 && asked > 0.0) exposure = asked / taken;
  }
  const double ofReferences = whole * bracketed, ofPatterns = each * (left - bracketed);
  const double count = ofReferences + ofPatterns;
  return {count, count > 0.0 ? (ofReferences * devices.meanExposure + ofPatterns * exposure) / count : 0.0};
}

}  // namespace

std::vector<PatternRange> levelPatterns(const Rasters& projectors, std::size_t lights,
                                        std::span<const int> known, double factor) {
  transport::NodeLayout layout(projectors);
  double each = quadrants * static_cast<double>(lights);
  PatternRange colours{std::min(1.0, factor) * usualColours.least, factor * usualColours.likely,
                       factor * usualColours.most};
  std::vector<PatternRange> patterns;
  for (int level = layout.levels() - 1; level > 0; --level) {
    double blocks = blocksOf(layout, level);
    if (patterns.size() < known.size()) {
      double count = known[patterns.size()], used = count / each;
      patterns.push_back({count, count, count});
      if (used < limitedByBlocks * blocks)
        colours = {nextColours.least * used, nextColours.likely * used, nextColours.most * used};
      continue;
    }
    auto atMost = [&](double wanted) { return each * std::clamp(wanted, 1.0, blocks); };
    patterns.push_back({each, atMost(colours.likely), atMost(colours.most)});
    if (colours.least > 1.0) patterns.back().least = atMost(colours.least);
  }
  return patterns;
}

double colourFactor(double relativeThreshold) {
  constexpr double power = -0.73;
  static const double usual = AcquisitionSettings().relativeThreshold;
  return relativeThreshold > 0.0 ? std::pow(relativeThreshold / usual, power) : 1.0;
}

std::vector<PatternRange> levelPatterns(const Rasters& projectors, const AcquisitionSettings& settings,
                                        std::span<const int> known) {
  if (settings.scheme == AcquisitionScheme::multiplexed)
    return densePatternsOf(projectors, settings.relativeThreshold, known);
  std::size_t lights = settings.colours == LitColours::white ? 1 : 3;
  return levelPatterns(projectors, lights, known, colourFactor(settings.relativeThreshold));
}

ForecastDevices forecastDevices(const rig::Rig& rig, const std::vector<double>& exposures) {
  double mean = exposures.empty() ? 0.0
                                  : std::accumulate(exposures.begin(), exposures.end(), 0.0) /
                                        static_cast<double>(exposures.size());
  return {rig.cameraRasters(), rig.projectorRasters(), exposures.size(), mean};
}

WorkLeft forecast(const ForecastDevices& devices, const AcquisitionSettings& settings,
                  const rig::ShotTimes& benchmark, const AcquisitionState& state) {
  const Rasters& cameras = devices.cameras;
  const Rasters& projectors = devices.projectors;
  auto projectorCount = static_cast<double>(projectors.devices());
  std::vector<PatternRange> levels = levelPatterns(projectors, settings, state.levels);
  // The finest level of dense patterns grows for as long as it is worth it.
  if (settings.scheme == AcquisitionScheme::multiplexed && state.levels.size() == levels.size()) {
    const PatternRange finest = levelPatterns(projectors, settings, {}).back();
    levels.back().likely = std::max(levels.back().likely, finest.likely);
    levels.back().most = std::max(levels.back().most, finest.most);
  }

  // Everything that is not the tree: references, the first look, the test patterns.
  double orientation = projectorCount > 1.0 ? projectorCount : 0.0;  // the only one's shows in the check
  const photography::ReferenceRounds rounds = referenceRounds(settings, projectors.devices());
  double references = rounds.black + rounds.floods * 3.0 * projectorCount + 3.0 + orientation;
  double testing =
      settings.verificationPatterns + checksWithin(settings.verificationPatterns, settings.checkInterval);
  constexpr double pair = 2.0;
  auto total = [&](auto member) {
    // One check before every level but the first, one before the test patterns and one after them.
    double all = references + testing + pair;
    if (settings.scheme == AcquisitionScheme::multiplexed) {
      double patterns = settings.verificationPatterns;
      for (const PatternRange& level : levels) patterns += level.*member;
      return references + patterns + denseChecksAmong(patterns);
    }
    for (const PatternRange& level : levels)
      if (level.*member > 0.0)
        all += pair + level.*member + checksWithin(level.*member, settings.checkInterval);
    return all;
  };
  auto left = [&](double all) { return static_cast<int>(std::max(0.0, std::round(all) - state.shots)); };

  WorkLeft work;
  work.shots = left(total(&PatternRange::likely));
  work.leastShots = left(total(&PatternRange::least));
  work.mostShots = left(total(&PatternRange::most));

  bool enough = state.times.shots >= enoughShots;
  const rig::ShotTimes& times = enough || benchmark.shots == 0 ? state.times : benchmark;
  bool all = settings.scheme == AcquisitionScheme::sen || settings.singleExposure;
  double usual =
      settings.singleExposure ? 1.0 : std::min<double>(2.0, static_cast<double>(devices.exposures));
  double perShot = all ? (settings.singleExposure ? 1.0 : static_cast<double>(devices.exposures)) : usual;
  Photographs ofCamera{perShot * work.shots, devices.meanExposure};
  if (settings.scheme == AcquisitionScheme::multiplexed && !settings.singleExposure)
    ofCamera = densePhotographsLeft(devices, references, total(&PatternRange::likely), work.shots, state);
  else if (enough)
    ofCamera = {static_cast<double>(state.times.exposures) / state.times.shots /
                    static_cast<double>(cameras.devices()) * work.shots,
                state.times.asked / state.times.exposures};
  const double photographs = ofCamera.count * static_cast<double>(cameras.devices());
  work.exposures = static_cast<int>(std::round(ofCamera.count));
  work.seconds =
      work.shots * times.shotSeconds() + photographs * times.exposureSeconds(ofCamera.meanExposure);
  // Little of it lies between the first patterns, and nothing between the benchmark's.
  if (settings.scheme == AcquisitionScheme::multiplexed && work.shots > 0) {
    const double computing = denseComputing * static_cast<double>(cameras.count()) * work.shots /
                             std::max(1.0, total(&PatternRange::likely));
    const double known = times.shots > 0 ? times.between / times.shots * work.shots : 0.0;
    work.seconds += std::max(0.0, computing - known);
  }

  double pixels = static_cast<double>(cameras.count());
  double bytes = times.exposures > 0 && times.bytes > 0
                     ? static_cast<double>(times.bytes) / times.exposures
                     : compressedBytes * pixels / static_cast<double>(cameras.devices());
  const bool dense = settings.scheme == AcquisitionScheme::multiplexed;
  double leaves = (dense ? denseLeaves * denseBytesPerLeaf + coloursBytes * projectorCount
                         : leavesPerPixel * bytesPerLeaf) *
                  pixels;
  // T, and what it is made from or made into: LargeVector.
  double mapped = dense ? leaves + (denseLeaves * rowBytesPerLeaf + coloursBytes * projectorCount) * pixels
                        : 2.0 * leaves;
  double underWay =
      mapped + (dense ? besideRowBytes * pixels + meansBytes * static_cast<double>(projectors.count())
                      : childrenBytes * pixels);
  work.mappedBytes = static_cast<std::uint64_t>(mapped);
  const double kept =
      dense ? (denseKeptLeaves * denseBytesPerLeaf + coloursBytes * projectorCount) * pixels : leaves;
  work.diskBytes = static_cast<std::uint64_t>(photographs * bytes + kept);
  work.memoryBytes = static_cast<std::uint64_t>(programBytes + underWay + framesInMemory * 27.0 * pixels +
                                                60.0 * static_cast<double>(projectors.count()));
  return work;
}

double expectedDeviation(const AcquisitionSettings& settings) {
  constexpr double usualThreshold = 0.012, usually = 0.009, power = 0.52;
  return usually * std::pow(settings.relativeThreshold / usualThreshold, power);
}

}  // namespace relucent::acquisition
