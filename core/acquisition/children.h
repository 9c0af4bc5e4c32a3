// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "relucent/transport/block_sparse.h"

namespace relucent::acquisition {

inline constexpr int quadrants = 4;

/// The children of all active pairs while they are being measured, and what stays with their parents.
class Children {
 public:
  using Code = transport::BlockSparseWriter::Code;

  Children(std::size_t pairs, bool mayDivide, bool restToParent)
      : code_(quadrants * pairs),
        spread_(mayDivide ? quadrants * pairs : 0),
        rest_(restToParent ? pairs : 0),
        active_(pairs, 0) {}

  void set(std::size_t pair, int quadrant, const Code& code) { code_[at(pair, quadrant)] = code; }
  void setRest(std::size_t pair, const Code& code) { rest_[pair] = code; }
  void activate(std::size_t pair, int quadrant, const Code& spread) {
    spread_[at(pair, quadrant)] = spread;
    active_[pair] = static_cast<std::uint8_t>(active_[pair] | (1 << quadrant));
  }
  const Code& code(std::size_t pair, int quadrant) const { return code_[at(pair, quadrant)]; }
  const Code& spread(std::size_t pair, int quadrant) const { return spread_[at(pair, quadrant)]; }
  Code rest(std::size_t pair) const { return rest_.empty() ? Code{} : rest_[pair]; }
  bool active(std::size_t pair, int quadrant) const { return (active_[pair] >> quadrant & 1) != 0; }
  std::size_t actives() const {
    std::size_t count = 0;
    for (std::uint8_t bits : active_) count += static_cast<std::size_t>(std::popcount(bits));
    return count;
  }
  std::size_t leaves() const {
    auto count = static_cast<std::size_t>(
        std::count_if(rest_.begin(), rest_.end(), [](const Code& code) { return code != Code{}; }));
    for (std::size_t i = 0; i < code_.size(); ++i)
      if (code_[i] != Code{} && !active(i / quadrants, static_cast<int>(i % quadrants))) ++count;
    return count;
  }

 private:
  static std::size_t at(std::size_t pair, int quadrant) {
    return quadrants * pair + static_cast<std::size_t>(quadrant);
  }
  std::vector<Code> code_, spread_;
  std::vector<Code> rest_;            // per pair, a leaf at its own level
  std::vector<std::uint8_t> active_;  // per pair, a bit a quadrant
};

}  // namespace relucent::acquisition
