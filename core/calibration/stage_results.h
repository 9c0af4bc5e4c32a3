// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/base/raster.h"
#include "relucent/transport/expected_quality.h"
#include "relucent/transport/found_change.h"

/// What the results of the stages say, one struct a stage: what the manifest keeps of them for people and for
/// later stages. The large parts are files beside it (results.h). What a manifest of an earlier version lacks
/// has its default.
namespace relucent::calibration {

/// How well an import predicts the patterns that it held out: normalised root mean squares.
struct ImportScore {
  std::vector<int> heldOut;  // numbers of the patterns
  double oneToOne = 0.0;
  double mix = 0.0;
  double transport = 0.0;
};

/// What a measurement took.
struct StageCost {
  double seconds = 0.0;
  int patterns = 0;                       // shown
  int exposures = 0;                      // photographed
  std::optional<ImportScore> imported{};  // of photographs that were taken elsewhere
};

struct CameraCheckResult {
  std::vector<double> exposures;         // seconds
  std::optional<double> latencySeconds;  // of the projector; none: was not measured
  std::vector<Message> verdicts;         // sentences on projector and camera
  double tooBright = 0.0;  // share of the view in every exposure, of the camera that sees most of it
};

/// Curves and camera models: loadLinearization().
struct LinearizationResult {
  std::size_t projectors = 0;
  std::size_t cameras = 0;
  std::optional<StageCost> cost;
};

struct ContentResult {
  double reachable = 0.0;  // share of the content's camera pixels
  double deltaE = 0.0;     // mean CIEDE2000, predicted
  bool operator==(const ContentResult&) const = default;
};

/// That a measurement was made to fit what the venue had become, and of what.
struct RepairNote {
  std::string of;             // name of the folder of the result that it was made from, which stays
  std::vector<Message> what;  // had changed
  // Of a picture by photograph, in the view where it gained least: as the former measurement had it and as
  // this one has it.
  double deltaEBefore = 0.0, deltaEAfter = 0.0;  // mean CIEDE2000
  double psnrBefore = 0.0, psnrAfter = 0.0;      // dB
  StageCost cost;
  /// What of the settings says where content stands, as it was and as it went with the cameras' views: JSON,
  /// sections of the manifest's settings. Empty, or of earlier versions: it stayed.
  std::string contentBefore{}, contentAfter{};
  /// What was predicted of the content, and is by this one. None: nobody had placed it.
  std::optional<ContentResult> predictedBefore{}, predictedAfter{};
};

/// The light transport itself: loadAcquisition().
struct AcquisitionResult {
  std::vector<Size> projectors;
  std::vector<Size> cameras;
  std::optional<double> verificationError;  // on held-out patterns, relative
  int stoppedAt =
      0;  // side of the finest blocks, projector pixels, if it was stopped and kept; 0: as fine as asked for
  std::optional<transport::ExpectedQuality> expected;  // when it ended; of dense patterns
  std::vector<Message> findings;
  std::optional<StageCost> cost;                    // of the measurement; of a repaired one that of the first
  std::optional<RepairNote> repair;                 // none: it was measured, and nothing else
  std::optional<transport::FoundChange> changed{};  // with which it ended; none: nothing had changed
  // Shares of the camera pixels: that are left out of compensation, and that were too bright for every
  // exposure. 0 of measurements that did not tell.
  double leftOut = 0.0, overexposed = 0.0;
  /// It was not ended early, by somebody or by a change: there is nothing to go on with.
  bool isWhole() const { return stoppedAt == 0 && !changed; }
};

struct ThresholdResult {
  double energyKept = 1.0;  // share of the light
  std::uint64_t leaves = 0;
};

/// How the windows' ridge was found.
struct InverseResult {
  struct Trial {
    double ridge = 0.0;
    double psnr = 0.0;  // dB
  };
  std::optional<double> ridge;
  std::vector<Trial> curve;
  std::uint64_t bytes = 0;  // of the operator in memory
  std::optional<StageCost> cost;
};

struct ClusteringResult {
  std::uint64_t clusters = 0;
  std::uint32_t largest = 0;  // projector pixels
  double errorMedian = 0.0;   // relative RMS error of rows
};

}  // namespace relucent::calibration
