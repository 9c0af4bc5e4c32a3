// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/message.h"

namespace relucent::pipeline {

/// Files that an operation wrote.
struct WrittenFiles {
  std::vector<std::filesystem::path> files;
  std::vector<Message> notes{};  // sentences that whoever reads the files should know
};

}  // namespace relucent::pipeline
