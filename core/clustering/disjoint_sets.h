// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace relucent::clustering {

/// Disjoint sets of 0 to size() - 1, joined by any number of threads at once without locks. A set's root is
/// its lowest element, whatever the order of the joins.
/// Union-find with path halving (Tarjan & van Leeuwen 1984). Parents are never above their children, so a
/// link is one compare-exchange that succeeds only while the higher root is still a root; and if another
/// thread overwrites a shortened path with a longer one, it still leads to the same root.
class DisjointSets {
 public:
  /// Resets every element to a set of its own; keeps the memory.
  void reset(std::size_t size) {
    parent_.resize(size);
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::size_t size() const { return parent_.size(); }

  std::uint32_t find(std::uint32_t element) {
    while (true) {
      std::uint32_t above = at(element).load(std::memory_order_relaxed);
      if (above == element) return element;
      std::uint32_t next = at(above).load(std::memory_order_relaxed);
      if (next == above) return above;
      at(element).store(next, std::memory_order_relaxed);
      element = next;
    }
  }

  /// Joins the sets of two elements; returns an element of the joined one near its root.
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    while (true) {
      a = find(a);
      b = find(b);
      if (a == b) return a;
      if (b < a) std::swap(a, b);
      std::uint32_t root = b;
      if (at(b).compare_exchange_strong(root, a, std::memory_order_relaxed)) return a;
    }
  }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t element) {
    return std::atomic_ref<std::uint32_t>(parent_[element]);
  }
  std::vector<std::uint32_t> parent_;
};

}  // namespace relucent::clustering
