// SPDX-License-Identifier: MIT
#include "support/own_network.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <net/if.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace relucent::test {
namespace {

/// The same user as before, in a name space where that user may have a network.
bool enterUserNamespace() {
  const std::string user = std::to_string(::geteuid()), group = std::to_string(::getegid());
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  std::ofstream("/proc/self/setgroups") << "deny";
  std::ofstream("/proc/self/uid_map") << user + " " + user + " 1";
  std::ofstream("/proc/self/gid_map") << group + " " + group + " 1";
  return true;
}

bool startLoopback() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  const bool known = ::ioctl(socket, SIOCGIFFLAGS, &request) == 0;
  request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP | IFF_RUNNING);
  const bool started = known && ::ioctl(socket, SIOCSIFFLAGS, &request) == 0;
  ::close(socket);
  return started;
}

/// One more address of the loopback, 127.0.n.1/24.
bool addAddress(int machine) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  ifreq request{};
  std::strcpy(request.ifr_name, ("lo:" + std::to_string(machine)).c_str());
  const auto set = [&](unsigned long what, const std::string& value) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    ::inet_pton(AF_INET, value.c_str(), &address.sin_addr);
    std::memcpy(&request.ifr_addr, &address, sizeof(address));
    return ::ioctl(socket, what, &request) == 0;
  };
  const bool isThere = set(SIOCSIFADDR, ownAddress(machine)) && set(SIOCSIFNETMASK, "255.255.255.0");
  ::close(socket);
  return isThere;
}

}  // namespace

std::string ownAddress(int machine) {
  return "127.0." + std::to_string(machine) + ".1";
}

void enterOwnNetwork(int machines) {
  if ((::unshare(CLONE_NEWNET) == 0 || enterUserNamespace()) && startLoopback()) {
    for (int machine = 1; machine < machines && addAddress(machine);) ++machine;
    return;
  }
  // Held until the process ends.
  const std::string file = (std::filesystem::temp_directory_path() / "relucent-gige-test.lock").string();
  const int lock = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (lock >= 0) ::flock(lock, LOCK_EX);
}

}  // namespace relucent::test
