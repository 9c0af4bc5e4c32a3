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
  std::uint64_t free = 0;  // of the machine's, without moving anything to the disk; 0: not known
};

/// What a program takes, may take or would take. Bytes.
struct MemoryUse {
  std::uint64_t resident = 0;  // without files that are mapped: the system takes that back when it runs short
  std::uint64_t addressSpace = 0;  // with them
  std::uint64_t ofFiles = 0;       // what of these is in memory now
  bool operator==(const MemoryUse&) const = default;
};

/// As the system says. `root`: where its /proc and /sys are.
MemoryLimits memoryLimits(const std::filesystem::path& root = "/");
/// Of this program, now.
MemoryUse memoryUse();

/// What the program may still take within these limits:
///   resident = min(0.8 machine, group) - resident,      addressSpace = addressSpace - mapped - 128 MiB,
/// at least 0, since other programs need the machine as well, and threads and heaps map more than they use.
MemoryUse memoryLeft(const MemoryLimits& limits, const MemoryUse& use);
/// Now.
MemoryUse memoryLeft();

/// Whether so many bytes may be taken for good, beside what this program has: afterwards half of the
/// machine's and of the control group's memory is still free, and at least 8 GiB.
bool isPlenty(std::uint64_t bytes, const MemoryLimits& limits, const MemoryUse& use);
/// Now.
bool isPlenty(std::uint64_t bytes);

/// Whether what is needed is left.
inline bool fits(const MemoryUse& needed, const MemoryUse& left) {
  return needed.resident <= left.resident && needed.addressSpace <= left.addressSpace;
}

}  // namespace relucent::platform
