// SPDX-License-Identifier: MIT
#pragma once

namespace relucent {

/// Whether the program runs under sanitizers, which take ten times as long and look at how memory is used,
/// not at what comes out: of many rows that take the same path, a part is enough for them.
inline constexpr bool isSanitized =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    true;
#else
    false;
#endif

}  // namespace relucent
