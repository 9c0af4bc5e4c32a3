// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <memory>

namespace relucent::gui {

struct FreeAnswer {
  void operator()(void* answer) const { std::free(answer); }
};
/// A reply of the X server, owned by the caller. nullptr: none.
template <typename Reply>
using Answer = std::unique_ptr<Reply, FreeAnswer>;
template <typename Reply>
Answer<Reply> owned(Reply* reply) {
  return Answer<Reply>(reply);
}

}  // namespace relucent::gui
