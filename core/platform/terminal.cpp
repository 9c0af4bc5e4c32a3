// SPDX-License-Identifier: MIT
#include "relucent/platform/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

namespace relucent::platform {

int errorTerminalWidth() {
  if (::isatty(STDERR_FILENO) == 0) return 0;
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return static_cast<int>(size.ws_col);
}

}  // namespace relucent::platform
