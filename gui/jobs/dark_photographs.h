// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "relucent/rig/rig.h"

namespace relucent::gui {

/// Notices that photographs of lit projectors show next to nothing: a covered lens, a projector that went
/// dark. A photograph is compared with the earlier ones by the same camera of the same lit projectors, by
///   s / (t p),   s the mean signal, t the exposure time, p the mean light of the patterns, linear,
/// which hardly depends on the pattern where that is spread over the whole picture. It is dark below a
/// twentieth of the median. Not judged: patterns below a hundredth of full light. Never dark: a signal above
/// half the range somewhere, which long exposures may cut off.
class DarkPhotographs {
 public:
  /// `encodedPatterns`: what the projectors show.
  void add(std::size_t camera, const std::vector<image::Image>& encodedPatterns, const rig::RawFrame& frame);
  /// The last photographs of some camera were dark, two at least.
  bool last() const;
  void forget() { *this = {}; }

 private:
  using View = std::pair<std::size_t, std::vector<bool>>;  // camera; which projectors are lit
  std::map<View, std::vector<double>> usual_;              // of photographs that were not dark, as they came
  std::map<std::size_t, int> dark_;                        // per camera, since the last one that was not
};

}  // namespace relucent::gui
