// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/base/error.h"

namespace relucent::image {

/// What is said where a picture's file cannot be read for that.
inline Error tooLittleMemory(const std::filesystem::path& path) {
  return Error(
      ErrorKind::memory,
      RELUCENT_ENGLISH_MESSAGE("image.not-enough-memory", "there is not enough memory to read the picture"),
      RELUCENT_ENGLISH_MESSAGE("image.free-memory-or-shrink-picture",
                               "close other programs, or make the picture smaller"),
      path.string());
}

}  // namespace relucent::image
