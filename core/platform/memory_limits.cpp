// SPDX-License-Identifier: MIT
#include "relucent/platform/memory_limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace relucent::platform {
namespace fs = std::filesystem;
namespace {

constexpr double shareOfMachine = 0.8;
constexpr std::uint64_t leastFree = std::uint64_t{8} << 30;
constexpr std::uint64_t mappedInVain = std::uint64_t{128} << 20;

struct MachineMemory {
  std::uint64_t whole = noMemoryLimit, free = 0;
};

MachineMemory memoryOfMachine(const fs::path& root) {
  constexpr std::uint64_t kibibyte = 1024;
  MachineMemory machine;
  std::ifstream info(root / "proc/meminfo");
  for (std::string name, rest; info >> name; std::getline(info, rest)) {
    std::uint64_t kibibytes = 0;
    if (name == "MemTotal:" && info >> kibibytes) machine.whole = kibibyte * kibibytes;
    if (name == "MemAvailable:" && info >> kibibytes) {
      machine.free = kibibyte * kibibytes;
      break;
    }
  }
  return machine;
}

/// The number in a file; none where there is a word ("max") or no file.
std::uint64_t limitIn(const fs::path& file) {
  std::ifstream stream(file);
  std::uint64_t limit = 0;
  return stream >> limit ? limit : noMemoryLimit;
}

/// The least of a group and all that it is in. A container sees its own as the mount's root, whatever path it
/// is told: groups that are not there count for nothing.
std::uint64_t leastLimit(const fs::path& mount, const fs::path& group, const char* file) {
  std::uint64_t least = limitIn(mount / file);
  for (fs::path at = group.relative_path(); !at.empty(); at = at.parent_path())
    least = std::min(least, limitIn(mount / at / file));
  return least;
}

/// Lines "0::/path" of version 2, "4:cpu,memory:/path" of version 1.
std::uint64_t limitOfGroup(const fs::path& root) {
  std::uint64_t least = noMemoryLimit;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const fs::path group = line.substr(second + 1), mount = root / "sys/fs/cgroup";
    if (controllers == ",,") least = std::min(least, leastLimit(mount, group, "memory.max"));
    if (controllers.find(",memory,") != std::string::npos)
      least = std::min(least, leastLimit(mount / "memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

std::uint64_t addressSpaceLimit() {
  rlimit limit{};
  const bool known = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return known ? std::uint64_t{limit.rlim_cur} : noMemoryLimit;
}

std::uint64_t less(std::uint64_t limit, std::uint64_t used) {
  if (limit == noMemoryLimit) return noMemoryLimit;
  return limit > used ? limit - used : 0;
}

}  // namespace

MemoryLimits memoryLimits(const fs::path& root) {
  const MachineMemory machine = memoryOfMachine(root);
  return {machine.whole, limitOfGroup(root), addressSpaceLimit(), machine.free};
}

MemoryUse memoryUse() {
  std::ifstream pages("/proc/self/statm");
  std::uint64_t mapped = 0, resident = 0, ofFiles = 0;
  pages >> mapped >> resident >> ofFiles;
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return {page * (resident - std::min(ofFiles, resident)), page * mapped, page * ofFiles};
}

MemoryUse memoryLeft(const MemoryLimits& limits, const MemoryUse& use) {
  const std::uint64_t machine =
      limits.machine == noMemoryLimit
          ? noMemoryLimit
          : static_cast<std::uint64_t>(shareOfMachine * static_cast<double>(limits.machine));
  return {less(std::min(machine, limits.group), use.resident),
          less(limits.addressSpace, use.addressSpace + mappedInVain)};
}

MemoryUse memoryLeft() {
  return memoryLeft(memoryLimits(), memoryUse());
}

bool isPlenty(std::uint64_t bytes, const MemoryLimits& limits, const MemoryUse& use) {
  const auto staysFree = [bytes](std::uint64_t whole, std::uint64_t free) {
    return free >= bytes && free - bytes >= std::max(leastFree, whole / 2);
  };
  return limits.machine != noMemoryLimit && staysFree(limits.machine, limits.free) &&
         (limits.group == noMemoryLimit || staysFree(limits.group, less(limits.group, use.resident)));
}

bool isPlenty(std::uint64_t bytes) {
  return isPlenty(bytes, memoryLimits(), memoryUse());
}

}  // namespace relucent::platform
