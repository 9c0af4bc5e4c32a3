// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/monitoring/shadow_tracker.h"
#include "relucent/pipeline/rehearsed_content.h"
#include "relucent/venue/played_show.h"
#include "relucent/venue/venue.h"

namespace relucent::pipeline {

struct ShadowRehearsalSettings {
  venue::VenueSettings venue;  // as it was measured
  double photographs = 10.0;   // a second
  double latency = 0.04;       // seconds from the end of an exposure until the projectors follow it
  int steps = 2;               // of a frame's refinement
  std::uint64_t seed = 1;      // of scenes
  monitoring::ShadowSettings shadows{};
};

/// Who stands where at a time.
using InTheWay = std::function<std::vector<venue::Silhouette>(double seconds)>;

/// The picture when a photograph began, from the camera's place, as light truly is.
struct ShadowedPicture {
  double seconds = 0.0;
  std::size_t shadowed = 0;  // pixels of the picture that a shadow takes a tenth of their light or more
  // CIEDE2000 to what is wanted, the mean over these: as it is, without filling, as well as it could be
  // filled by who knows every pixel in whose light somebody stands, and if nobody were there.
  double filled = 0.0, unfilled = 0.0, possible = 0.0, unshadowed = 0.0;
  // The mean over all other pixels of the picture, likewise; and over all, with and without filling.
  double beside = 0.0, besideUnshadowed = 0.0;
  double all = 0.0, allUnfilled = 0.0;
  std::size_t cells = 0;  // that are filled as of this photograph
  bool isOther = false;   // other cells than before it
};

struct ShadowRehearsalResult {
  std::vector<ShadowedPicture> pictures;  // one a photograph
  double seconds = 0.0;                   // of work, all photographs
  double followSeconds = 0.0;             // of the engine's following, all frames that did
  int followed = 0;                       // frames
  int falseFills =
      0;  // photographs after which cells are filled that nobody has stood in or near for a while
  std::vector<std::vector<std::uint32_t>> words;  // of the frames, where they are kept
};

/// A simulated venue, measured, whose shadows are filled while a simulated show plays: what `bench shadows`
/// and tests share. The tracker and the engine know photographs alone.
class ShadowRehearsal {
 public:
  /// Measures the venue. Throws: as calibrate().
  ShadowRehearsal(const ShadowRehearsalSettings& settings, const std::filesystem::path& cache,
                  Progress& progress);
  ~ShadowRehearsal();

  struct Run {
    ShownContent content = ShownContent::still;
    double duration = 5.0;  // seconds
    InTheWay inTheWay{};    // nobody, if empty
    bool fills = true;      // false: nobody watches
    bool judges = true;     // false: pictures have no errors
    bool keepsWords = false;
  };
  ShadowRehearsalResult run(const Run& run, Progress& progress);
  void setSeed(std::uint64_t seed);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relucent::pipeline
