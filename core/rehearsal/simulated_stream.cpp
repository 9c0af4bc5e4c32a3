// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/simulated_stream.h"

#include <fmt/format.h>

#include "relucent/image/picture_files.h"

namespace relucent::rehearsal {
namespace {

constexpr std::chrono::milliseconds betweenPictures{40};
constexpr std::size_t longestRequest = 8192;  // bytes

}  // namespace

SimulatedStream::SimulatedStream(const image::Image& encoded) {
  const std::string jpeg = image::encodeJpeg(encoded);
  part_ = fmt::format("--picture\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n{}\r\n",
                      jpeg.size(), jpeg);
  comeBack();
}

void SimulatedStream::comeBack() {
  server_ = std::make_unique<LoopbackServer>(port_, [this](Visitor& visitor) { serve(visitor); });
  port_ = server_->port();
}

void SimulatedStream::lose() {
  server_.reset();
}

std::string SimulatedStream::url() const {
  return fmt::format("http://127.0.0.1:{}/live", port_);
}

void SimulatedStream::serve(Visitor& visitor) const {
  for (std::string request; request.find("\r\n\r\n") == std::string::npos;)
    if (!visitor.receive(request) || request.size() > longestRequest) return;
  if (!visitor.send("HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\n\r\n"))
    return;
  while (visitor.send(part_) && visitor.pause(betweenPictures)) {
  }
}

}  // namespace relucent::rehearsal
