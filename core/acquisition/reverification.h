// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "relucent/acquisition/acquisition.h"
#include "relucent/base/message.h"

namespace relucent::acquisition {

/// What a second look at a measured venue finds. Errors are relative,
///   |measured - e - T p| / |measured - e|,
/// with e as it is now, so that they judge T alone; what became of e is `ambient`.
struct Reverification {
  double error = 0.0;                               // of all patterns
  std::array<double, verificationSizes> errorOf{};  // per block size
  /// Power of the lamp as a share of what it was, by least squares: sum (measured - e) T p / sum |T p|^2.
  double lamp = 1.0;
  double adapted = 0.0;  // error of all patterns, the lamp's change taken out
  /// Mean change of e, as a share of the mean flood image.
  double ambient = 0.0;
  /// Camera pixels that see something else than predicted, the lamp's change taken out: wrong as a share of
  /// their light and beyond their noise. Pixels that were flagged when T was measured do not count.
  CameraMask changed;
  double changedShare = 0.0;  // of the pixels that count
  std::vector<CameraStack>
      residual;  // per block size: root of the mean square of measured - e - T p, radiance
  int patterns = 0;
  int exposures = 0;
};

/// Photographs black and the held-out patterns of the verification again, and compares them with T p. About
/// ten patterns; nothing of the calibration is changed. Nothing is watched meanwhile, so the run needs
/// neither handler nor observer. Throws: Error{device, input}; Cancelled; require() that the sizes are those
/// of T.
Reverification verifyAgain(const AcquisitionRun& run, const transport::Acquisition& acquisition,
                           Progress& progress);

/// What follows from it.
enum class Verdict {
  stillGood,   // T predicts the venue as it did
  remeasure,   // part of the view, the room's light or the lamp has changed: measure T again
  startAgain,  // hardly anything fits: aim, focus and measure everything again
};
/// "still_good", "remeasure", "start_again".
std::string_view toString(Verdict verdict);

/// Whether there is enough of the projector's light to judge anything by: `lamp` of what is found.
bool isLightSeen(double lamp);
/// Whether the room's light alone is another than T can be used with: `ambient` of what is found.
bool isRoomChanged(double ambient);

struct Judgement {
  Verdict verdict = Verdict::stillGood;
  Message sentence;
};
/// `errorThen`: of the same patterns when T was measured.
Judgement judge(const Reverification& found, double errorThen);

}  // namespace relucent::acquisition
