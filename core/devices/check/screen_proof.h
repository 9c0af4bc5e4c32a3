// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/progress.h"
#include "relucent/devices/check/check_verdict.h"
#include "relucent/devices/check/latency.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

struct ScreenProofSettings {
  int mostLate = 2;          // photographs that a picture may come too late and still be recognised
  double explained = 0.7;    // of what changes at a pixel, so much must be the code
  double leastStep = 0.005;  // signal, full scale 1, that the code must change a pixel by
  double leastShare = 0.01;  // of the camera's pixels that must see it
};
std::vector<Message> problems(const ScreenProofSettings& settings);

/// What a camera sees of one screen.
struct ScreenSight {
  double share = 0.0;     // of its pixels that follow the screen's code
  int late = 0;           // photographs by which pictures come too late
  bool mirrored = false;  // left and right, or top and bottom, are exchanged (not both: that is a turn)
};

/// Which output a camera sees.
struct ScreenProof {
  ScreenSight sight;
  bool isSeen = false;
  double exposure = 0.0;  // seconds, of the photographs that saw it
  std::string instead{};  // the name of another screen that the camera sees; empty: none
  std::vector<CheckVerdict> verdicts{};
};

/// The code: in each quarter of the picture (top left, top right, bottom left, bottom right) the maximal
/// length sequence of 31 bits, begun 0, 8, 16 and 24 bits in, white for 1.
///   x^5 + x^2 + 1
/// Shifted copies of it are uncorrelated but for -1/31.  Source: Golomb, Shift Register Sequences, 1967.
inline constexpr int screenCodeLength = 31;
image::Image screenCode(Size size, int number);

/// What the photographs say of a screen that showed screenCode(0), (1), ... one for each, going round.
/// For each pixel the series of its brightness s is fitted by the four codes of the quarters, delayed by
/// d = 0 ... mostLate; it follows the screen if they explain `explained` of the variance of s by at least
/// `leastStep`, with positive weight. The sight is that of the d with most such pixels; it is mirrored if
/// the quarters lie the other way round.
/// Shapes: screenCodeLength + mostLate photographs of one size.
ScreenSight sightOf(const std::vector<image::Image>& photographs, const ScreenProofSettings& settings);

/// At which a screen's white is well exposed, seconds: see devices/check/test_exposure.h.
using ScreenExposure = std::function<double(rig::Projector&)>;

/// Shows the code on `screen` and photographs it. If the camera does not see it, tries `others`, each with an
/// exposure of its own: where no light is seen, the first one's may be so long that any other screen dazzles.
/// At long exposures a screen whose white cannot be told from its black is not shown the code.
/// Throws: Cancelled; as the devices.
ScreenProof proveScreen(rig::Projector& screen, const std::vector<rig::Projector*>& others,
                        rig::Camera& camera, const ScreenExposure& exposure,
                        const ScreenProofSettings& settings, Progress& progress);

/// All devices answer, but the camera looks at something else than the screen.
class ScreenNotSeen : public Error {
  using Error::Error;
};

/// Throws: ScreenNotSeen{device} that says what the camera sees instead, unless it sees the screen.
void requireSeen(const ScreenProof& proof, const rig::Projector& screen, const rig::Camera& camera);

}  // namespace relucent::devices
