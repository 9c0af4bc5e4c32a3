// SPDX-License-Identifier: MIT
#pragma once

namespace relucent::transport {

/// How well pictures are expected to be shown with a T, before one has been: PSNR of *refined* where the
/// picture can be reached, dB, mean of three pictures of different kinds.
struct ExpectedQuality {
  double now = 0.0;      // with T as it is
  double whole = 0.0;    // once it is measured to the end ...
  int photographs = 0;   // ... which takes about so many more ...
  double seconds = 0.0;  // ... in about this time
};

/// Even to the end pictures will be no better than where nothing is corrected, which reaches 16 to 18 dB
/// (core/compensation/README.md): what was measured does not fit together, as after a bump that nobody saw.
inline bool isPoor(const ExpectedQuality& expected) {
  constexpr double uncorrected = 16.0;  // dB
  return expected.whole < uncorrected;
}

}  // namespace relucent::transport
