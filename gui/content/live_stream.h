// SPDX-License-Identifier: MIT
#pragma once

#include "content/live_link.h"
#include "content/stream_address.h"
#include "content/stream_decoder.h"

namespace relucent::gui {

/// A live picture from the network, without its sound. What is shown while it is lost its address tells.
class LiveStream : public LiveLink {
 public:
  explicit LiveStream(const StreamAddress& address, const Canvas& canvas, const StreamPatience& patience = {},
                      const LivePauses& pauses = {});
};

}  // namespace relucent::gui
