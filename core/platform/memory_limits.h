// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>

namespace relucent::platform {

inline constexpr std::uint64_t noMemoryLimit = std::numeric_limits<std::uint64_t>::max();

/// What limits the memory of this program. Bytes; noMemoryLimit where nothing does, or nothing is known.
struct MemoryLimits {
  std::uint64_t machine = noMemoryLimit;       // that it has
  std::uint64_t group = noMemoryLimit;         // of the control group, and of those that it is in
  std::uint64_t addressSpace = noMemoryLimit;  // of this program: what is mapped, used or not
};

/// What this program takes now. Bytes.
struct MemoryUse {
  std::uint64_t resident = 0;
  std::uint64_t addressSpace = 0;
};

/// As the system says. `root`: where its /proc and /sys are.
MemoryLimits memoryLimits(const std::filesystem::path& root = "/");
MemoryUse memoryUse();

/// What the program may still take within these limits:
///   min(0.8 machine - resident, group - resident, addressSpace - mapped - 128 MiB), at least 0
/// since other programs need the machine as well, and threads and heaps map more than they use.
std::uint64_t memoryLeft(const MemoryLimits& limits, const MemoryUse& use);
/// Now.
std::uint64_t memoryLeft();

}  // namespace relucent::platform
