// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/compensation/perfecting.h"
#include "relucent/pipeline/prove.h"

namespace relucent::pipeline {

/// The camera, as the loop sees it: radiance, e included.
struct PerfectingCamera {
  std::function<hdr::BlackLevel()> black;
  /// Of linear drive.
  std::function<hdr::HdrFrame(const ProjectorStack& drive)> photograph;
};

/// What one photograph said of the picture that was shown.
struct PerfectingRound {
  compensation::WeighedError error;
  std::vector<PictureError> views;  // camera after camera
  double surprise = 0.0;            // |light - T p - b| / |light|, noise taken out
};

/// Why there are no more photographs.
enum class PerfectingEnd {
  atNoise,    // what was seen is what was expected, but for noise
  noGain,     // it did not get better any more
  allTaken,   // as many as were asked for
  stopped,    // by whoever waits
  disturbed,  // something is in the way: nothing is believed
};
inline constexpr EnumName<PerfectingEnd> perfectingEndNames[]{
    {PerfectingEnd::atNoise, "at-noise", "nothing but noise is left"},
    {PerfectingEnd::noGain, "no-gain", "further photographs gained nothing"},
    {PerfectingEnd::allTaken, "all-taken", "all photographs were taken"},
    {PerfectingEnd::stopped, "stopped", "stopped, and what was best by then kept"},
    {PerfectingEnd::disturbed, "disturbed", "something was in the way"}};
constexpr EnumNames<PerfectingEnd> namesOf(PerfectingEnd) {
  return {"end", perfectingEndNames};
}

struct PerfectingResult {
  compensation::Compensation picture;  // the best, or the one that there was
  bool better = false;                 // than that one, by more than noise, and colours are not worse
  PerfectingEnd end = PerfectingEnd::allTaken;
  Message disturbance;                  // what was in the way
  std::vector<PerfectingRound> rounds;  // from the picture that there was
  PerfectingRound before, after;        // that one and the best, photographed last, one after the other
  int photographs = 0;                  // of pictures, all told
};

inline constexpr int mostPerfectingPhotographs = 50;
inline Message perfectingPhotographsOutOfRange() {
  return RELUCENT_ENGLISH_MESSAGE("perfect.photographs-out-of-range",
                                  "a picture is perfected by 2 to {} photographs")
      .with(as::label(mostPerfectingPhotographs));
}

/// Corrects a picture by photographs of itself (compensation/perfecting.h): shows it, photographs it, learns
/// what T did not explain, solves again, and so on, at most `most` times. Then the picture that there was and
/// the one that was seen to be best are photographed once more, one after the other: the best is only taken
/// if it is seen to be better there. Room light is taken out as it is: black is photographed first, and again
/// before these two. What is seen must be what is expected, within limits that grow with how wrong T is: a
/// view that has moved by more than 0.3 pixels, light that is missing or too much, something before the
/// camera. Such a photograph is taken twice again, for somebody may just walk by; then the picture stays as
/// it was. `told`: after every photograph, of what was shown. Stop and keep: no more rounds.  Throws:
/// Cancelled; as the camera and Compensator::solve() do.
PerfectingResult perfected(
    const compensation::Compensator& compensator, const compensation::Target& target,
    compensation::Compensation start, const PerfectingCamera& camera, int most,
    const std::function<void(const PerfectingRound&, const ProjectorStack& drive)>& told, Progress& progress);

}  // namespace relucent::pipeline
