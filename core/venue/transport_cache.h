// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "relucent/venue/traced_transport.h"

namespace relucent::venue {

/// Reads what writeTracedTransport() wrote under the same fingerprint and for the same shape. Empty if there
/// is no such file, or if it is of another version, foreign, truncated or corrupted: it is only a cache.
std::optional<TracedTransport> readTracedTransport(const std::filesystem::path& file,
                                                   const std::string& fingerprint, std::size_t nodes,
                                                   std::size_t cameraPixels);

/// Throws: Error{disk}; existing files stay intact.
void writeTracedTransport(const std::filesystem::path& file, const std::string& fingerprint,
                          const TracedTransport& traced);

}  // namespace relucent::venue
