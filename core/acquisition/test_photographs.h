// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/acquisition/verification.h"

namespace relucent::acquisition {

/// Photographs of test patterns: each is taken once, when the first T is compared with it, and any other T
/// may be compared with the same.
class TestPhotographs {
 public:
  /// `first`: the number of the first pattern. Keeps references: both outlive it.
  TestPhotographs(const TreeContext& context, const AcquisitionSettings& settings, int first)
      : context_(context), settings_(settings), first_(first) {}

  /// Throws: as Watch::check().
  sentinels::Interruptible<Verification> compared(const transport::TransportMatrix& transport,
                                                  const CameraMask& rows, Progress& progress);

  /// What was photographed so far, in the patterns' order.
  const std::vector<ProjectorStack>& patterns() const { return patterns_; }
  const std::vector<SeenLight>& light() const { return light_; }

 private:
  const TreeContext& context_;
  const AcquisitionSettings& settings_;
  int first_;
  std::vector<ProjectorStack> patterns_;
  std::vector<SeenLight> light_;
};

}  // namespace relucent::acquisition
