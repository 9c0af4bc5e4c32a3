// SPDX-License-Identifier: MIT
#include "relucent/transport/npz_rasters.h"

namespace relucent::transport {

void addRasters(NpzWriter& writer, const std::string& name, const Rasters& rasters) {
  std::vector<std::int32_t> sizes;
  for (Size size : rasters.sizes()) sizes.insert(sizes.end(), {size.width, size.height});
  writer.add(name, sizes, {rasters.devices(), 2});
}

Rasters readRasters(const NpzReader& reader, const std::string& name) {
  std::vector<std::int64_t> values = reader.integers(name);
  std::vector<Size> sizes;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    constexpr std::int64_t largest = 1 << 16;
    if (values[i] < 1 || values[i + 1] < 1 || values[i] > largest || values[i + 1] > largest)
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.device-size-impossible",
                                           "names a device of an impossible size"));
    sizes.push_back({static_cast<int>(values[i]), static_cast<int>(values[i + 1])});
  }
  if (sizes.empty() || values.size() % 2 != 0)
    reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.no-devices", "names no devices"));
  return Rasters(std::move(sizes));
}

}  // namespace relucent::transport
