// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/photography/bracket.h"
#include "relucent/photography/references.h"
#include "relucent/sentinels/observer.h"

namespace relucent::sentinels {

/// The picture that is repeated to see whether anything has changed: random blocks in red, the left half in
/// green, the upper half in blue. Its blocks tell shifts, its halves tell which way round it appears.
ProjectorStack referencePattern(const Rasters& projectors);
/// The same on one projector, the others dark.
ProjectorStack referencePattern(const Rasters& projectors, std::size_t projector);

/// What two photographs say, black and the reference picture, taken one after the other.
struct Check {
  hdr::BlackLevel black;
  hdr::ProjectedLight light;  // of the reference picture
};

/// What checks are compared with: the first one's light or, where a changed view was accepted, a later one's.
struct FirstCheck {
  hdr::BlackLevel black;
  hdr::LampLight light;
};

/// What a check is compared with.
struct Baseline {
  const photography::References& references;
  const hdr::BlackLevel& black;  // e as it was followed so far
  const FirstCheck& first;
  double power = 1.0;  // of the lamp, continued from the checks before
};

/// Total light of a check relative to the first one.
double lampPower(const Check& now, const FirstCheck& first, const photography::References& references);

/// A check in numbers, its shot, flicker and alarm left open: as inspect() compares them.
Reading readingOf(const Check& now, const Baseline& baseline);

/// Compares a check with what is expected. The most fundamental finding only; but of a view that moved while
/// the room's light changed, both.
std::optional<Alarm> inspect(const Check& now, const Baseline& baseline);

/// Whether anything is seen of a pattern, by the floods: before there is a check to compare with.
std::optional<Alarm> inspectDarkness(const Check& seen, const ProjectorStack& pattern,
                                     const photography::References& references);

/// Whether the reference picture on one projector appears at all, and the right way round. Its colours are
/// unmixed per camera pixel by the floods; the halves' centres of light span a frame, whose handedness tells.
std::optional<Alarm> inspectOrientation(const hdr::ProjectedLight& light, std::size_t projector,
                                        const photography::References& references, bool mayBeMirrored);

/// Photographs of one pattern differ by that share of their light, and the light is known to be why.
Alarm flickerAlarm(double apart);

/// Light of a pattern relative to what it would be if every camera pixel saw the pattern's mean, by the
/// floods:
///   sum_i L_i / sum_i sum_k root_i(k) m_k,     m_k: mean of projector channel k over the pattern
/// over valid values of some 60 000 usable pixels of a camera; the least of all cameras, at most 1. About 1
/// for random patterns, whose blocks are many; near 0 where a lens is covered or the projector shows nothing.
double lightShare(const hdr::LampLight& seen, const ProjectorStack& pattern,
                  const photography::References& references);

/// Less of it is dark: of two hundred random blocks, none is known to come near.
inline constexpr double darkShare = 0.2;

/// What made exposures of one pattern differ by that share of their light. A rigid movement that leaves less
/// than half of the difference which the brightness of all does not explain: something moved. One of them
/// dark: the lens was covered. By 8x6 places, to a quarter of their mean square: where they differ by one
/// share of their light, the light flickers; where by one share of the floods, or by the same everywhere, and
/// better so, the room's light changed. None of these: flicker or movement may be, and both are said.
Alarm inspectContradiction(double apart, const photography::ContradictoryViews& views,
                           const photography::References& references);

/// Compares all projectors at full light with the first of their floods, and with the mean of those after,
/// colour by colour: what moved, or came into the view, since the first photograph. Each colour's brightness
/// is taken out: lamps drift, and some projectors' white is brighter than their red, green and blue together.
std::optional<Alarm> inspectFloods(const hdr::ProjectedLight& white,
                                   const photography::References& references);

}  // namespace relucent::sentinels
