// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>

namespace relucent::clustering {

/// The brightest connection of a projector pixel in one number, which threads raise without locks: the
/// brighter is the higher, of equals the one to the lower camera pixel. 0: there is none.
class Brightest {
 public:
  /// Contract: luminance > 0.
  void raise(float luminance, std::uint32_t row) {
    std::uint64_t key = std::uint64_t{std::bit_cast<std::uint32_t>(luminance)} << 32 | ~row;
    std::atomic_ref<std::uint64_t> shared(key_);
    std::uint64_t known = shared.load(std::memory_order_relaxed);
    while (known < key && !shared.compare_exchange_weak(known, key, std::memory_order_relaxed)) {
    }
  }
  explicit operator bool() const { return key_ != 0; }
  float luminance() const { return std::bit_cast<float>(static_cast<std::uint32_t>(key_ >> 32)); }
  std::uint32_t row() const { return ~static_cast<std::uint32_t>(key_); }

 private:
  std::uint64_t key_ = 0;
};

}  // namespace relucent::clustering
