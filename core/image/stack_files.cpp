// SPDX-License-Identifier: MIT
#include "relucent/image/stack_files.h"

#include <fmt/format.h>

#include "relucent/image/exr.h"

namespace relucent::image {
namespace fs = std::filesystem;

std::string stackFileName(const std::string& name, std::size_t device) {
  return fmt::format("{}-{}.exr", name, device + 1);
}

std::vector<fs::path> writeStack(const fs::path& folder, const std::string& name, const Stack& stack,
                                 const Rasters& rasters, const std::string& units, ExrPacking packing) {
  std::vector<fs::path> files;
  for (std::size_t device = 0; device < rasters.devices(); ++device) {
    files.push_back(folder / stackFileName(name, device));
    writeExr(files.back(), imageFromStack(stack, rasters, device), ExrType::floatType,
             {{exr_attribute::units, units}}, packing);
  }
  return files;
}

Stack stackFromFlags(const std::vector<std::uint8_t>& flags) {
  Stack stack(3 * flags.size());
  for (std::size_t i = 0; i < stack.size(); ++i) stack[i] = flags[i / 3] != 0 ? 1.0f : 0.0f;
  return stack;
}

}  // namespace relucent::image
