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

}  // namespace relucent::transport
