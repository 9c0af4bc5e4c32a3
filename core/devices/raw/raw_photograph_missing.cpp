// SPDX-License-Identifier: MIT
// Stands in for raw_photograph.cpp where LibRaw is not installed.
#include "relucent/base/error.h"
#include "relucent/devices/raw/raw_photograph.h"

namespace relucent::devices {

bool hasRawPhotographs() {
  return false;
}

std::optional<std::time_t> timeTaken(const std::filesystem::path&) {
  return std::nullopt;
}

RawPhotograph rawPhotograph(const std::vector<std::uint8_t>&, const std::string& name) {
  throw Error(ErrorKind::format,
              RELUCENT_ENGLISH_MESSAGE("device.built-without-libraw",
                                       "this build of Relucent does not read raw files"),
              RELUCENT_ENGLISH_MESSAGE(
                  "device.install-libraw",
                  "install LibRaw (libraw-dev) and build again, or develop them linearly, as 16-bit TIFF"),
              name);
}

}  // namespace relucent::devices
