// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "relucent/multiplexing/pattern_means.h"
#include "relucent/multiplexing/row.h"
#include "relucent/multiplexing/system_kernels.h"

namespace relucent::multiplexing {

/// What a camera pixel showed, less e, relative to its floods F_c: first under the floods of every projector
/// in red, green and blue, then under the patterns.
/// Shapes: 3 * projectors + patterns rows, a column for each camera channel.
struct RowLight {
  Eigen::ArrayX3f light;
  Eigen::ArrayX3f variance;                 // infinity: nothing was seen, as where it was saturated
  Eigen::Array3f offset{0.0f, 0.0f, 0.0f};  // standard deviation of what e is off by, in all of them alike
};

/// What the regression of a row found besides the light of its leaves.
struct RowFit {
  std::vector<transport::ColourBlock> blocks;  // of T, relative to F_c, a leaf each
  std::vector<transport::ColourBlock> sums;    // of blocks of near and far leaves, as Row::mixing
  Eigen::Array3f flood{0.0f, 0.0f, 0.0f};      // of T 1 in each channel, relative to F_c
  float misfit = 0.0f;                         // squared residual over its variance, mean
  float noise = 0.0f;                          // the variance that the photographs' noise gives, median
};

/// One row of T by Gaussian regression from photographs of dense patterns. With v the means of a pattern over
/// the nodes, the light in camera channel c is
///   y_c = sum_j sum_k T_jck v_jk + o_c + noise,      T_jck = x_j b_ck + w_j g_ck + d_jck,
/// x_j ~ N(expected_j, spread_j^2) the light of a leaf, g what the mixing b of near or of far light is off
/// by, w_j the light of the leaf as known before, d_jck ~ N(0, (r s_j (b_ck + 0.02))^2) the leaf's own
/// colours. x is common to the channels, g and d belong to one of them: they are eliminated channel by
/// channel, which leaves a system of as many unknowns as there are leaves. Only the leaves whose colours show
/// have a d; those of the others are noise, about their mean, which g follows. Units: everything relative to
/// F_c.  Source: core/multiplexing/README.md.
class RowRegression {
 public:
  /// Keeps a reference to `means`, which outlives it.
  RowRegression(const PatternMeans& means, const RowSettings& settings,
                const SystemKernels& kernels = systemKernels().back());

  /// Solves for `row`, whose leaves get their light and its deviation. Valid until the next call.
  /// Contract: `seen` has a row for each flood and each pattern.
  const RowFit& solve(Row& row, const RowLight& seen);
  /// What the last fit says that the patterns show, the offset of e included, seen or not: a row each.
  const Eigen::ArrayX3f& predict();
  /// Variance of the last fit's flood, of the same row.
  Eigen::Array3f floodVariance(const Row& row) const;

 private:
  using Columns = Eigen::MatrixXf;  // a row an equation, of which there is a multiple of `lanes`
  using Symmetric = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// The equations of one camera channel, in units of their standard deviations. Columns: the colours'
  /// unknowns, those of the light in units of their spread, what the expected light leaves over.
  struct Channel {
    Eigen::VectorXf amplitude;  // standard deviations of the colours' unknowns
    Columns columns;
    Symmetric system;         // of all unknowns and the right side; the colours are eliminated
    Eigen::VectorXf colours;  // the solution, in units of the amplitude
    double known = 0.0;       // about how many of them the photographs determine
    Eigen::Index seen = 0;    // patterns
  };

  void readDesign(const Row& row);
  void findNoise(const RowLight& seen);
  void chooseDetails(const Row& row);
  void gatherKinds(const Row& row);
  void fillColumns(const Row& row, const RowLight& seen, Eigen::Index c);
  void eliminateColours(Channel& channel);
  void solveLight(Row& row);
  void findColours(Channel& channel);
  void findMisfit();
  void adopt(Row& row);
  std::array<const float*, 3> designOf(Eigen::Index leaf) const;
  float colourSpread(const Row& row, Eigen::Index leaf) const;

  const PatternMeans& means_;
  RowSettings settings_;
  const SystemKernels& kernels_;
  Eigen::Index floods_, equations_ = 0, leaves_ = 0;
  std::array<Columns, 3> design_;      // [k]: leaves
  std::vector<Eigen::Index> kinds_;    // of the leaves
  std::vector<Eigen::Index> details_;  // leaves with colours of their own
  std::array<Columns, 3> known_;       // [k]: kinds, the light of their leaves
  std::array<Columns, 3> lumped_;      // [k]: kinds, squares of colours that are noise
  std::array<Channel, 3> channels_;
  Symmetric system_, inverse_;  // of the light and the right side
  Eigen::VectorXf light_;       // the solution, in units of the spread
  double determined_ = 0.0;
  std::vector<float> noise_;
  RowFit fit_;
  Eigen::ArrayX3f predictions_;
};

}  // namespace relucent::multiplexing
