// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "relucent/acquisition/estimate.h"
#include "relucent/acquisition/frames.h"
#include "relucent/acquisition/tree.h"
#include "relucent/acquisition/tree_context.h"

namespace relucent::acquisition {

/// One quadrant of the blocks of a colour, the same in every light.
struct LitQuadrant {
  int quadrant = 0;
  std::vector<std::uint8_t> lit;                  // as from litPixels()
  std::vector<transport::ColourBlock> predicted;  // what stored leaves send to each camera pixel of the class
};

/// A photograph to be taken: all that can be computed before it is.
struct ClassFrame {
  std::shared_ptr<const LitQuadrant> quadrant;
  LitChannels light{};
  ProjectorStack pattern;
  std::vector<photography::Demand> demands;  // empty: all exposures
};

/// The blocks that one colour of the schedule lights together: their quadrants are measured one after the
/// other, then sorted by the scheme. lit() and frame() may run while another frame is being photographed or
/// extracted.
class ColourClass {
 public:
  /// Keeps references: all outlive it.
  ColourClass(Tree& tree, std::span<const LitPair> seen, const TreeContext& context);

  std::shared_ptr<const LitQuadrant> lit(int quadrant, std::vector<std::uint8_t> pixels) const;
  ClassFrame frame(std::shared_ptr<const LitQuadrant> quadrant, const LitChannels& light) const;

  sentinels::Interruptible<hdr::LampLight> photograph(const ClassFrame& frame, const Progress& progress,
                                                      const photography::Meanwhile& meanwhile) const;

  /// What a photograph says about the children.
  void extract(const ClassFrame& frame, const hdr::LampLight& seen);

  /// After all quadrants: whether many camera pixels contradict what their parents sent before, which is what
  /// a disturbance during some of the photographs looks like. Those are extracted again from the next frames
  /// of all quadrants, the others keep their values.
  bool contradictsParents();

  /// To be called when all quadrants have been measured.
  void settle(Children& children);

 private:
  std::vector<photography::Demand> demands(const LitQuadrant& quadrant, const LitChannels& light) const;
  bool contradictsParent(std::size_t i) const;
  void settle(std::size_t i, Children& children) const;
  /// A value as codes of a row, what the rounding leaves over handed on to the row's next leaf.
  transport::BlockSparseWriter::Code leafCode(std::size_t row, const transport::ColourBlock& value) const;
  std::size_t projectorOf(const LitPair& seen) const;

  Tree& tree_;
  std::span<const LitPair> seen_;
  sentinels::Watch& watch_;
  const photography::References& references_;
  const Scheme& scheme_;
  std::vector<Estimate> measured_;    // as seen_, four each
  std::vector<std::uint8_t> wanted_;  // as seen_: to be measured
};

}  // namespace relucent::acquisition
