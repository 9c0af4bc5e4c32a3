// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/base/message.h"
#include "relucent/photography/references.h"

namespace relucent::acquisition {

/// Block sizes of the verification patterns, in turn: 1, 2, 4, 8 pixels.
inline constexpr int verificationSizes = 4;

/// What decides which nodes of the tree are divided and what is stored: see scheme.h.
enum class AcquisitionScheme { adaptive, sen, multiplexed };
inline constexpr EnumName<AcquisitionScheme> acquisitionSchemeNames[]{
    {AcquisitionScheme::adaptive, "adaptive"},
    {AcquisitionScheme::sen, "sen"},
    {AcquisitionScheme::multiplexed, "multiplexed"}};
constexpr EnumNames<AcquisitionScheme> namesOf(AcquisitionScheme) {
  return {"acquisition scheme", acquisitionSchemeNames};
}

/// Light that patterns are shown in: red, green and blue in turn, or white, unmixed afterwards.
enum class LitColours { rgb, white };
inline constexpr EnumName<LitColours> litColoursNames[]{
    {LitColours::rgb, "rgb", "red, green and blue in turn"}, {LitColours::white, "white", "at once"}};
constexpr EnumNames<LitColours> namesOf(LitColours) {
  return {"choice of colours", litColoursNames};
}

struct AcquisitionSettings {
  AcquisitionScheme scheme = AcquisitionScheme::adaptive;
  LitColours colours = LitColours::rgb;
  bool singleExposure = false;       // only the shortest: quick, noisy where it is dim
  double relativeThreshold = 0.008;  // tau_i = max(this * F_i, noise floor); 0.006 fine, 0.02 fast
  double absoluteThreshold = 0.0;    // of sen, radiance; 0: what adaptive follows in the dimmest pixels
  double dimShare = 0.2;     // pixels dimmer than this share of the typical F are resolved as if they had it
  double noiseSigmas = 4.0;  // the noise floor of tau, in standard deviations of a frame
  int references = 4;        // black and flood shots averaged
  int checkInterval = 40;    // shots between two checks of e, the lamp and the view
  bool mayBeMirrored = false;    // pictures are meant to appear mirrored: rear projection, a mirror
  int verificationPatterns = 8;  // held-out random patterns, block sizes 1, 2, 4, 8
  double flagRelative = 0.1;     // a pixel is flagged when its residual exceeds this share of its light
  double flagSigmas = 3.0;       // and this many standard deviations
  std::uint64_t seed = 1;        // of the verification patterns
};
/// Sentences about what is wrong with settings; empty: nothing.
std::vector<Message> problems(const AcquisitionSettings& settings);

/// Settings that go together. Fast is adaptive, white, one exposure, a looser threshold, fewer references.
/// Multiplexed, the default of calibrations, has its own patterns, see multiplexed.h; the threshold is also
/// how well it predicts what it has not seen: 0.03 for a first look, 0.006 fine.
enum class AcquisitionMode { adaptive, sen, fast, multiplexed };
inline constexpr EnumName<AcquisitionMode> acquisitionModeNames[]{
    {AcquisitionMode::adaptive, "adaptive"},
    {AcquisitionMode::sen, "sen", "the reference"},
    {AcquisitionMode::fast, "fast", "a first look"},
    {AcquisitionMode::multiplexed, "multiplexed", "dense coloured patterns"}};
constexpr EnumNames<AcquisitionMode> namesOf(AcquisitionMode) {
  return {"acquisition mode", acquisitionModeNames};
}
AcquisitionSettings settingsOf(AcquisitionMode mode);

/// How often black and floods are photographed. Of several projectors the floods of a dense measurement share
/// these rounds: its patterns tell T 1 better than they do, and show all projectors at once.
photography::ReferenceRounds referenceRounds(const AcquisitionSettings& settings, std::size_t projectors);

}  // namespace relucent::acquisition
