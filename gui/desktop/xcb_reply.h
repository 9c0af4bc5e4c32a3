// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <memory>

namespace relucent::gui {

struct FreeReply {
  void operator()(void* answer) const { std::free(answer); }
};
/// A reply of the X server, owned by the caller. nullptr: none.
template <typename Reply>
using XcbReply = std::unique_ptr<Reply, FreeReply>;
template <typename Reply>
XcbReply<Reply> owned(Reply* reply) {
  return XcbReply<Reply>(reply);
}

}  // namespace relucent::gui
