// SPDX-License-Identifier: MIT
#pragma once

namespace relucent {

/// The largest magnitude of a 16-bit code of a signed value: code = value / step, step = largest value /
/// this.
inline constexpr float largestCode = 32767.0f;

}  // namespace relucent
