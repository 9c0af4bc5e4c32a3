// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "fuzz/fuzz_target.h"
#include "relucent/base/random.h"

namespace relucent::fuzz {

/// One of a target's seeds, changed in a few places: bits and bytes, numbers that programs forget (0, -1, the
/// largest, in any width, or written out), pieces left out, doubled, many times repeated or taken from
/// another seed, words of the format; of JSON also its values, by their places.
class Mutator {
 public:
  explicit Mutator(const FuzzTarget& target);

  /// The same for the same key.
  std::string input(Random& random) const;
  /// Of a seed or anything else.
  std::string changed(std::string bytes, Random& random) const;
  const std::vector<std::string>& seeds() const { return seeds_; }

 private:
  void changeBytes(std::string& bytes, Random& random) const;
  std::string changedJson(const std::string& text, Random& random) const;

  const FuzzTarget& target_;
  std::vector<std::string> seeds_;
};

}  // namespace relucent::fuzz
