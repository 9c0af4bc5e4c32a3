// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>

namespace relucent::test {

/// A file or folder of the real data that lies beside the checkout, or an empty path if it is not there.
inline std::filesystem::path sharedData(const std::filesystem::path& name) {
  const char* folder = std::getenv("RELUCENT_SHARED_DATA");
  const std::filesystem::path path = std::filesystem::path(folder ? folder : "../shared/data") / name;
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? path : std::filesystem::path();
}

}  // namespace relucent::test
