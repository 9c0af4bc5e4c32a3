// SPDX-License-Identifier: MIT
#include "relucent/image/exr_stream.h"

#include <Iex.h>

#include <algorithm>
#include <cstring>

namespace relucent::image::detail {

MemoryInput::MemoryInput(std::string_view content, const std::string& name)
    : IStream(name.c_str()), content_(content) {}

bool MemoryInput::read(char bytes[], int count) {
  std::uint64_t wanted = static_cast<std::uint64_t>(std::max(count, 0));
  if (position_ > content_.size() || wanted > content_.size() - position_)
    throw Iex::InputExc("unexpected end of file");
  std::memcpy(bytes, content_.data() + position_, wanted);
  position_ += wanted;
  return position_ < content_.size();
}

void MemoryOutput::write(const char bytes[], int count) {
  std::uint64_t end = position_ + static_cast<std::uint64_t>(count);
  if (end > content_.size()) content_.resize(end);
  std::memcpy(content_.data() + position_, bytes, static_cast<std::size_t>(count));
  position_ = end;
}

}  // namespace relucent::image::detail
