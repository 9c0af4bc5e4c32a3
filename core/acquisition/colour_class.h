// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "acquisition/estimate.h"
#include "acquisition/frames.h"
#include "acquisition/tree.h"
#include "acquisition/watch.h"

namespace relucent {

/// The blocks that one colour of the schedule lights together: their quadrants are measured one after the
/// other, then sorted by the scheme.
class ColourClass {
 public:
  /// Keeps references: all outlive it.
  ColourClass(Tree& tree, std::span<const Seen> seen, const References& references, const Scheme& scheme);

  /// Photographs one quadrant in every light of the scheme. `lit`: as from litPixels().
  void measure(int quadrant, const std::vector<std::uint8_t>& lit, Watch& watch, const Progress& progress);

  /// After all quadrants: whether many camera pixels contradict what their parents sent before, which is what
  /// a disturbance during some of the photographs looks like. Those are measured anew by the next measure()
  /// of all quadrants, the others keep their values.
  bool contradictsParents();

  /// To be called when all quadrants have been measured.
  void settle(Children& children);

 private:
  std::vector<Demand> demands(const Light& light) const;
  void extract(int quadrant, const Light& light, const HdrFrame& frame);
  bool contradictsParent(std::size_t i) const;
  void settle(std::size_t i, Children& children) const;
  /// A value as codes of a row, what the rounding leaves over handed on to the row's next leaf.
  BlockSparseWriter::Code leafCode(std::size_t row, const ColourBlock& value) const;
  std::size_t projectorOf(const Seen& seen) const;

  Tree& tree_;
  std::span<const Seen> seen_;
  const References& references_;
  const Scheme& scheme_;
  std::vector<ColourBlock> predicted_;  // as seen_, in the quadrant under way
  std::vector<Estimate> measured_;      // as seen_, four each
  std::vector<std::uint8_t> wanted_;    // as seen_: to be measured
};

}  // namespace relucent
