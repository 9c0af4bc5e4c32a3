// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relucent::fuzz {

using Bytes = std::span<const std::byte>;

/// How bytes are changed so that what comes of them gets past the first check of their reader.
enum class Form {
  bytes,     // anywhere
  json,      // a document's values as well
  jsonLine,  // likewise, of the first line
};

/// What reads bytes of strangers.
struct FuzzTarget {
  const char* name;
  void (*read)(Bytes);
  /// Sound ones, to be changed; made once.
  std::vector<std::string> (*seeds)();
  Form form = Form::bytes;
  int executions = 1000;             // in the tests
  std::vector<std::string> words{};  // that mean something to its reader
};

/// All of them, in the order of SECURITY.md.
const std::vector<FuzzTarget>& allTargets();

/// Largest input that is made.
inline constexpr std::size_t longestInput = std::size_t{1} << 17;
/// More than any reader may take at once for an input of that length.
inline constexpr std::size_t mostAtOnce = std::size_t{512} << 20;

/// Lets the target read; what is wrong with how that ended, empty: nothing. It may succeed, or throw the
/// project's own Error or WrongUsage with a sentence. Anything else that is thrown, and more memory at once
/// than mostAtOnce, is a finding; crashes, and what takes longer than half a minute of processor time, end
/// the program.
std::string findingOf(const FuzzTarget& target, Bytes input);

inline Bytes bytesOf(std::string_view text) {
  return std::as_bytes(std::span(text));
}
inline std::string_view textOf(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace relucent::fuzz
