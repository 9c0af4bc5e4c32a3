// SPDX-License-Identifier: MIT
#include "desktop/termination.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr std::array endings{SIGTERM, SIGINT, SIGHUP};

// A signal handler may do little more than write a byte: the other end is read by Qt.
std::array<int, 2> ends{-1, -1};

extern "C" void signalled(int) {
  char byte = 1;
  [[maybe_unused]] auto written = write(ends[0], &byte, 1);
}

int opened() {
  require(ends[0] < 0, "only one at a time");
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw Error(ErrorKind::device,
                RELUCENT_ENGLISH_MESSAGE("program.no-termination-socket",
                                         "the system provides no socket for its termination signals"),
                RELUCENT_ENGLISH_MESSAGE("venue.close-other-programs", "close other programs"));
  return ends[1];
}

}  // namespace

Termination::Termination(QObject* parent) : QObject(parent), notifier_(opened(), QSocketNotifier::Read) {
  connect(&notifier_, &QSocketNotifier::activated, this, [this] {
    char byte = 0;
    [[maybe_unused]] auto count = read(ends[1], &byte, 1);
    Q_EMIT requested();
  });
  for (int number : endings) std::signal(number, signalled);
}

Termination::~Termination() {
  for (int number : endings) std::signal(number, SIG_DFL);
  for (int& end : ends) {
    close(end);
    end = -1;
  }
}

}  // namespace relucent::gui
