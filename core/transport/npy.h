// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace relucent::transport {

/// Type and shape of an array in a NumPy file: `type` as NumPy writes it ("<f4", "<i8", "|S3"), C order.
struct NpyHeader {
  std::string type;
  std::vector<std::uint64_t> shape;

  std::uint64_t count() const;
  std::size_t itemBytes() const;
};

/// The first bytes of a .npy file, version 1.0: padded so that the data begins at a multiple of 64 bytes.
std::string npyText(const NpyHeader& header);

/// Reads exactly `bytes`; false at the end of the file.
using ReadBytes = std::function<bool(char* out, std::uint64_t bytes)>;

/// The dictionary in the header of a .npy file; empty if it has none.
std::optional<std::string> readNpyDictionary(const ReadBytes& read);
/// The array that a dictionary describes; empty for Fortran order and for types without a size.
std::optional<NpyHeader> parseNpyDictionary(const std::string& dictionary);

}  // namespace relucent::transport
