// SPDX-License-Identifier: MIT
#include "relucent/platform/system_description.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace relucent::platform {

std::string systemDescription() {
  utsname name{};
  uname(&name);
  std::string text = fmt::format("{} {} {}\n{} cores\n", name.sysname, name.release, name.machine,
                                 std::thread::hardware_concurrency());
  for (const char* file : {"/etc/os-release", "/proc/meminfo"}) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("PRETTY_NAME") || line.starts_with("MemTotal")) text += line + '\n';
  }
  return text;
}

}  // namespace relucent::platform
