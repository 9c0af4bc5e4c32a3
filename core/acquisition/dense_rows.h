// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "relucent/acquisition/dense_photographs.h"
#include "relucent/acquisition/measured_transport.h"
#include "relucent/acquisition/settings.h"
#include "relucent/multiplexing/pattern_means.h"
#include "relucent/multiplexing/regression.h"
#include "relucent/multiplexing/rows.h"
#include "relucent/transport/draft.h"
#include "relucent/transport/shared_colours.h"

namespace relucent::acquisition {

/// The rows of all camera pixels as dense patterns show them, and the photographs of those patterns: solved
/// by regression, divided level after level from some 24 to 48 blocks of the projectors to single pixels.
/// Source: core/multiplexing/README.md.
class DenseRows {
 public:
  /// What every level has at least.
  static constexpr int fewestPatterns = 8;

  /// Keeps references, which outlive it.  Throws: Error{disk}, as everything does that reads photographs.
  DenseRows(const photography::References& references, const AcquisitionSettings& settings);

  /// Every row as its floods say, with one leaf for each projector. What it has then is T of the floods.
  void beginWithRoots();
  /// Every row with equal leaves of one level, which is returned: the coarsest one whose patterns are shown.
  int begin();

  /// How many patterns serve nearly every row of the level under way; 0 if no camera pixel is usable.
  int patternsNeeded() const;
  /// The same of the next finer level, as the rows are now.
  int patternsNeededNext() const;

  /// A place on the disk for what a pattern shows. Rows do not know it before use(): they may be solved
  /// meanwhile.
  [[nodiscard]] DensePhotographs::Stored store(const hdr::LampLight& seen) {
    return photographs_.store(seen);
  }
  std::size_t stored() const { return photographs_.stored(); }
  /// A pattern of blocks of a level, and where its photograph lies.
  void use(int level, const std::vector<ProjectorStack>& patterns,
           const std::vector<DensePhotographs::Stored>& stored);
  /// Photographs that are used.
  std::size_t photographs() const { return photographs_.size(); }

  /// Forgets all photographs but the first `count`. Rows are divided anew, as those that are left would have
  /// had them divided: what the others said, in the dark or with something in the way, would stay in the rows
  /// as spreads and leaves otherwise.
  void beginAnew(std::size_t count);

  /// Solves every row, leaves without colours of their own: enough to judge and to count by.
  void solveLight();
  /// Solves every row.
  void solve();
  /// Solves those rows by which predictions are judged, see predict().
  void solveJudged();
  /// Solves once more without the last `heldOut` photographs, corrects the others for the lamp's light in
  /// each, and leaves out what contradicts the rest. Returns: photographs that were spoilt, by number.
  std::vector<std::size_t> judge(std::size_t heldOut = 0);
  /// The relative error, beyond their noise, of the last `heldOut` photographs as the others predict them,
  /// of some rows.
  double predict(std::size_t heldOut);

  /// Leaves of the level under way that matter are divided, those that do not are joined.
  void divide();

  /// What the rows say, for whoever looks on.
  transport::Draft draft() const;

  /// T. The rows are gone then: both need not fit into memory.
  MeasuredTransport finish();

 private:
  /// A level whose patterns have been used, and how many photographs there were then.
  struct Division {
    int level = 0;
    std::size_t photographs = 0;
  };
  using Use = std::function<void(std::size_t part, const DensePhotographs::Rows& shown, std::size_t number,
                                 const multiplexing::Row& row, multiplexing::RowRegression& regression,
                                 const multiplexing::RowLight& seen)>;
  using Wanted = std::function<bool(std::size_t number)>;

  void beginWith(int level, float spread);
  int patternsFor(const std::function<std::size_t(std::size_t row)>& leaves) const;
  void solveRows(std::size_t heldOut, int details, const Wanted& wanted, const Use& use);
  void solveRows(std::size_t heldOut, int details);
  bool isJudged(std::size_t number) const;
  void encodeRow(std::size_t number, const multiplexing::Row& row, const multiplexing::RowFit& fit,
                 transport::SharedColourEncoder& encoder, transport::SharedColourRow& encoded) const;
  void describeRow(std::size_t number, const multiplexing::Row& row, const multiplexing::RowFit& fit,
                   const Eigen::Array3f& floodVariance, MeasuredTransport& measured) const;

  const photography::References& references_;
  const AcquisitionSettings& settings_;
  DensePhotographs photographs_;
  multiplexing::PatternMeans means_;
  multiplexing::Rows rows_;
  std::vector<float> thresholds_;  // relative to F
  std::vector<Division> divisions_;
  int level_ = 0;  // under way
};

}  // namespace relucent::acquisition
