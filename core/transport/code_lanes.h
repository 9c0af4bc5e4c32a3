// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>

/// Four lanes of GCC's vector extensions, supported by Clang too: SSE on x86-64, NEON on arm64. Shared by the
/// inner loops over 16-bit codes and over nodes; no other file includes this.
namespace relucent::transport::detail {

using Floats [[gnu::vector_size(16)]] = float;
using Integers [[gnu::vector_size(16)]] = std::int32_t;
using Longs [[gnu::vector_size(16)]] = std::int64_t;
using Codes [[gnu::vector_size(16)]] = std::int16_t;

// A code in the upper half of 32 bits: one instruction on every processor, unlike sign extension.
inline constexpr float lanesToCodes = 0x1.0p-16f;

// Inlined into each version of a loop, so that each compiles it for its own instruction set.
#define RELUCENT_KERNEL [[gnu::always_inline]] inline

RELUCENT_KERNEL Floats load(const float* from) {
  Floats values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

RELUCENT_KERNEL Floats floatsOf(Codes halves) {
  return __builtin_convertvector(reinterpret_cast<Integers>(halves), Floats);
}

}  // namespace relucent::transport::detail
