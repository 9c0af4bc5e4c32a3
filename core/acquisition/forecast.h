// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/acquisition/settings.h"
#include "relucent/base/progress.h"
#include "relucent/linearization/linearization.h"
#include "relucent/rig/shot.h"

namespace relucent::acquisition {

/// Patterns of one level, or what may be expected of it.
struct PatternRange {
  double least = 0.0, likely = 0.0, most = 0.0;
};

/// How many patterns each level of the tree will need, coarsest first. Levels that have begun are known; the
/// others follow from the colours of the last that is not limited by its few blocks, or, before there is one,
/// from what simulated venues needed at the usual threshold: a plain wall 3 colours a level, a corner 30, a
/// wine glass 64; others may need 100. At other thresholds `factor` times as many, see colourFactor().
///   patterns = 4 * lights * min(blocks, colours)
std::vector<PatternRange> levelPatterns(const Rasters& projectors, std::size_t lights,
                                        std::span<const int> known, double factor = 1.0);

/// How many more colours a tree needs at a threshold than at the usual one.
///   (relativeThreshold / 0.008)^-0.73
/// The power is that of the patterns of corner, depth, statue, glass and dome, 256x192 / 160x120, from 0.008
/// to 0.02: a factor of 0.44 to 0.58 each, and 1.18 to 1.34 at 0.006 (README).
double colourFactor(double relativeThreshold);

/// The same with the lights and the threshold of settings. Of dense patterns, down to single pixels: as many
/// as simulated venues took.
std::vector<PatternRange> levelPatterns(const Rasters& projectors, const AcquisitionSettings& settings,
                                        std::span<const int> known);

/// Where an acquisition stands.
struct AcquisitionState {
  std::vector<int> levels{};  // patterns of the levels that have begun, coarsest first
  int shots = 0;              // taken or read so far
  rig::ShotTimes times{};     // of the shots that it took
};

/// What of the devices decides how long an acquisition takes.
struct ForecastDevices {
  Rasters cameras, projectors;
  std::size_t exposures = 0;  // that a pattern may be photographed with
  double meanExposure = 0.0;  // seconds
};
ForecastDevices forecastDevices(const rig::Rig& rig, const std::vector<double>& exposures);

/// What an acquisition has still to do. Exact are the references and the verification, and the checks between
/// a known number of the tree's patterns; of dense patterns checks are about 10 + patterns / 25. Patterns are
/// as levelPatterns() says; what is measured again after an alarm or for flagged pixels comes on top. Before
/// it begins: with a state of nothing.
///   seconds = shots * (show + keep + compute) + exposures * (overhead + slope * exposure time),
/// all five measured from this acquisition's shots once there are enough, before that from `benchmark`: the
/// shots of the linearization, which are real photographs by the same devices. Of dense patterns, computing
/// is taken for no less than
///   compute = camera pixels * 1.2 ms / patterns,
/// since most of it is done between the last of them.
///   disk   = exposures * bytes of one + T;      memory = T twice, the level under way, what the program has
/// T is taken to hold 120 leaves of 22 bytes a camera pixel; simulated venues have 65 to 180. Dense patterns
/// need it once, with 75, and their rows.
/// Pure arithmetic, no devices: for a page that asks before anything is measured as well.
WorkLeft forecast(const ForecastDevices& devices, const AcquisitionSettings& settings,
                  const rig::ShotTimes& benchmark, const AcquisitionState& state);

/// By how much light that is predicted with dense patterns is about to be off the true light, relative:
///   0.009 (threshold / 0.012)^0.52
/// The medians of the errors of random patterns in the README's table, at 0.03, 0.012 and 0.006: 1.45 %,
/// 0.91 % and 0.63 %; glass has twice as much. Acquisition::verificationError is larger and hardly depends on
/// the threshold: most of it is noise of the test patterns' own photographs.
double expectedDeviation(const AcquisitionSettings& settings);

}  // namespace relucent::acquisition
