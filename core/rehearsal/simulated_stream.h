// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "relucent/image/image.h"
#include "relucent/rehearsal/loopback_server.h"

namespace relucent::rehearsal {

/// A live picture on the loopback network, Motion JPEG over HTTP, that can be lost and come back.
class SimulatedStream {
 public:
  /// `encoded`: what it shows, in sRGB.  Throws: as LoopbackServer.
  explicit SimulatedStream(const image::Image& encoded);

  /// "http://127.0.0.1:PORT/live"
  std::string url() const;
  void lose();
  /// Throws: as LoopbackServer.
  void comeBack();

 private:
  void serve(Visitor& visitor) const;

  std::string part_;  // a picture, as it is sent
  int port_ = 0;
  std::unique_ptr<LoopbackServer> server_;  // nullptr: it is lost
};

}  // namespace relucent::rehearsal
