// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "relucent/transport/block_sparse.h"
#include "relucent/transport/node_layout.h"

namespace relucent::multiplexing {

/// A number that is kept in half precision and counts in single precision: there are a hundred million of
/// them at full scale.
class Half {
 public:
  Half(float value = 0.0f) : value_(value) {}  // NOLINT(google-explicit-constructor): it is one
  operator float() const { return static_cast<float>(value_); }  // NOLINT(google-explicit-constructor)

 private:
  Eigen::half value_;
};

/// One node of a camera pixel's row, as an unknown: its light as a share of all light that the pixel gets.
struct Leaf {
  std::uint32_t node = 0;
  Half expected;   // before the photographs: mean ...
  Half spread;     // ... and standard deviation
  Half light;      // after them: mean ...
  Half deviation;  // ... and standard deviation
};

/// What is known of a camera pixel's row of T. Values are relative to F_c, the pixel's flood in camera
/// channel c, all projectors and their channels summed.
struct Row {
  std::vector<Leaf> leaves;  // nodes ascending; they cover every projector once
  /// How the light of a leaf is divided among camera and projector channels, b(c, k), which sums to 1 over k:
  /// one for near and one for far light of every projector, [2 * projector + far].
  std::vector<transport::ColourBlock> mixing;
  float excess = 0.0f;  // variance of what the model lacks
};

/// Numbers that say how a row is modelled. They hold for all venues that were tried.
struct RowSettings {
  int nearLevels = 2;       // light of the finest levels is near: it comes straight from the projector
  float colours = 0.12f;    // relative deviation of a leaf's nine values from the row's mixing
  float anyColour = 0.02f;  // added to the mixing where that deviation is relative to it
  int details = 8;  // leaves whose nine values are unknowns of their own; for the others they are noise
  float leastExcess = 0.002f;  // standard deviation of what the model lacks, at least ...
  float mostExcess = 0.05f;    // ... and at most
  float faintest = 8e-4f;      // spread that every leaf keeps
};

/// Near or far light: index into Row::mixing.
inline std::size_t kindOf(const transport::Node& node, const RowSettings& settings) {
  return 2 * static_cast<std::size_t>(node.projector) + (node.level < settings.nearLevels ? 0 : 1);
}

/// Every node of the level `start`, or of a lower pyramid's last level, with light of its area and a spread
/// of `spread`.
std::vector<Leaf> startingLeaves(const transport::NodeLayout& layout, int start, float spread);

/// The coarsest level with at least `nodes` nodes in all projectors together, or the finest.
int startingLevel(const transport::NodeLayout& layout, int nodes = 24);

}  // namespace relucent::multiplexing
