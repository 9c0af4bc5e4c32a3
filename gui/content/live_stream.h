// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "content/canvas.h"
#include "content/live_source.h"
#include "content/stream_address.h"
#include "content/stream_decoder.h"

namespace relucent::gui {

/// When a stream that is lost is connected to again.
struct StreamPauses {
  std::chrono::milliseconds first{1'000}, longest{30'000};  // doubled with every failure in between
  std::chrono::milliseconds forgiven{10'000};               // of playing, after which the first one is due
};

/// A live picture from the network, without its sound. It is connected to, read, decoded and brought to the
/// canvas on a thread of its own, which nobody waits for. While it is lost its last picture stays, or black,
/// as the address has it, and it is connected to again and again; before its first picture it is black. A
/// stream that changes its size goes on.
class LiveStream : public LiveSource {
 public:
  explicit LiveStream(const StreamAddress& address, const Canvas& canvas, const StreamPatience& patience = {},
                      const StreamPauses& pauses = {});
  /// Its thread ends when it finds out.
  ~LiveStream() override;

  /// It has had a picture.
  bool isReady() const override;
  std::optional<LiveState> live() const override;

 protected:
  ContentPicture newest() override;

 private:
  class Connection;
  std::shared_ptr<Connection> connection_;
};

}  // namespace relucent::gui
