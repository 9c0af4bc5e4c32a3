// SPDX-License-Identifier: MIT
#pragma once

// A sanitizer's own function is there where what is tested was built with it, whatever this was built with.
extern "C" {
[[gnu::weak]] void __asan_init();
[[gnu::weak]] void __tsan_init();
}

namespace relucent {

/// Whether the program runs under sanitizers, which take ten times as long and look at how memory is used,
/// not at what comes out: of many rows that take the same path, a part is enough for them.
inline const bool isSanitized = __asan_init != nullptr || __tsan_init != nullptr;

}  // namespace relucent
