// SPDX-License-Identifier: MIT
#include "relucent/acquisition/dense_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "relucent/acquisition/draft.h"
#include "relucent/acquisition/photograph_review.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/multiplexing/division.h"
#include "relucent/multiplexing/learning.h"

namespace relucent::acquisition {
namespace {

using multiplexing::Leaf;
using multiplexing::Row;
using multiplexing::RowFit;
using multiplexing::RowLight;
using multiplexing::RowRegression;
using multiplexing::RowSettings;

constexpr float startingSpread = 0.1f;
constexpr float rootSpread = 1.0f;
// Equations for each unknown that a level adds, in all but some camera pixels.
constexpr double equationsPerLeaf = 2.0;
constexpr double served = 0.9;
// Of a camera pixel's light, of a projector whose blocks count: what a dimmer one's are off by is not seen.
constexpr float leastShare = 0.15f;
constexpr int mostPatterns = 64;
// As long as leaves are to be divided, few of them need colours of their own.
constexpr int fewDetails = 4;
// Camera pixels of which the predictions are judged, about.
constexpr std::size_t judgedRows = 40000;
// Thresholds of dim pixels are raised by at most this.
constexpr float mostDimming = 10.0f;
// Parts of the camera pixels that wait to be written.
constexpr std::size_t partsWritten = 32;

int detailsAt(int level) {
  return level > 0 ? fewDetails : RowSettings().details;
}

bool every(std::size_t) {
  return true;
}

void justSolved(std::size_t, const DensePhotographs::Rows&, std::size_t, const Row&, RowRegression&,
                const RowLight&) {}

/// How well photographs that were held out are predicted.
struct Prediction {
  double squared = 0.0, variance = 0.0, light = 0.0;

  double error() const { return light > 0.0 ? std::sqrt(std::max(0.0, squared - variance) / light) : 0.0; }

  void add(const Prediction& other) {
    squared += other.squared;
    variance += other.variance;
    light += other.light;
  }

  /// What was shown in units of `flood`, its variance, and how far off the prediction was.
  void add(const Eigen::Array3f& flood, const Eigen::Array3f& shown, const Eigen::Array3f& shownVariance,
           const Eigen::Array3f& off) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      if (!std::isfinite(shownVariance[c])) continue;
      double unit = static_cast<double>(flood[c]) * static_cast<double>(flood[c]);
      squared += unit * static_cast<double>(off[c] * off[c]);
      variance += unit * static_cast<double>(shownVariance[c]);
      light += unit * static_cast<double>(shown[c] * shown[c]);
    }
  }
};

}  // namespace

DenseRows::DenseRows(const photography::References& references, const AcquisitionSettings& settings)
    : references_(references),
      settings_(settings),
      photographs_(references),
      means_(transport::NodeLayout(references.projectors)),
      rows_(references.usable.size(), 2 * references.root.size()),
      thresholds_(rows_.size()) {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    float strongest = std::max(photographs_.flood(row).maxCoeff(), 1e-6f * references.typical);
    float dimming = static_cast<float>(settings.dimShare) * references.typical / strongest;
    thresholds_[row] =
        static_cast<float>(settings.relativeThreshold) * std::clamp(dimming, 1.0f, mostDimming);
  }
}

void DenseRows::beginWithRoots() {
  beginWith(means_.layout().levels(), rootSpread);
}

int DenseRows::begin() {
  beginWith(multiplexing::startingLevel(means_.layout()), startingSpread);
  return level_;
}

void DenseRows::beginWith(int level, float spread) {
  level_ = level;
  const std::vector<Leaf> leaves = multiplexing::startingLeaves(means_.layout(), level, spread);
  const float excess = RowSettings().leastExcess * RowSettings().leastExcess;
  rows_.change([&](std::size_t number, std::vector<Leaf>& own) {
    if (references_.usable[number]) own = leaves;
  });
  parallelFor(0, rows_.size(), 1024, [&](std::size_t number) {
    if (!references_.usable[number]) return;
    Row row{leaves, {}, excess};
    for (const transport::ColourBlock& mixing : photographs_.floodMixing(number))
      row.mixing.insert(row.mixing.end(), 2, mixing);
    rows_.write(number, row);
  });
}

int DenseRows::patternsNeeded() const {
  return patternsFor([&](std::size_t number) {
    const std::vector<float> shares = photographs_.floodShares(number);
    return static_cast<std::size_t>(std::ranges::count_if(rows_.leavesOf(number), [&](const Leaf& leaf) {
      const transport::Node node = means_.layout().node(leaf.node);
      return node.level == level_ && shares[static_cast<std::size_t>(node.projector)] >= leastShare;
    }));
  });
}

int DenseRows::patternsNeededNext() const {
  const std::vector<std::size_t> children = multiplexing::childrenAfterDivision(
      rows_, references_.cameras, means_.layout(), level_, thresholds_, {});
  return patternsFor([&](std::size_t row) { return children[row]; });
}

int DenseRows::patternsFor(const std::function<std::size_t(std::size_t row)>& leaves) const {
  std::vector<std::size_t> unknown;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (!rows_.leavesOf(row).empty()) unknown.push_back(leaves(row));
  if (unknown.empty()) return 0;
  auto many = unknown.begin() + static_cast<std::ptrdiff_t>(served * static_cast<double>(unknown.size() - 1));
  std::nth_element(unknown.begin(), many, unknown.end());
  // A photograph gives three equations, one for each channel.
  return std::clamp(static_cast<int>(std::ceil(equationsPerLeaf * static_cast<double>(*many) / 3.0)),
                    fewestPatterns, mostPatterns);
}

void DenseRows::use(int level, const std::vector<ProjectorStack>& patterns,
                    const std::vector<DensePhotographs::Stored>& stored) {
  for (DensePhotographs::Stored photograph : stored) photographs_.add(photograph);
  means_.add(level, patterns);
}

void DenseRows::beginAnew(std::size_t count) {
  photographs_.keep(count);
  means_.keep(count);
  const std::vector<Division> before = std::exchange(divisions_, {});
  photographs_.forgetJudgements();
  begin();
  for (const Division& division : before) {
    if (division.photographs > photographs_.size()) break;
    std::size_t later = photographs_.size() - division.photographs;
    level_ = division.level;
    solveRows(later, detailsAt(level_));
    if (!judge(later).empty()) solveRows(later, detailsAt(level_));
    divide();
  }
}

void DenseRows::solveLight() {
  solveRows(0, 0);
}

void DenseRows::solve() {
  solveRows(0, detailsAt(level_));
}

void DenseRows::solveJudged() {
  solveRows(0, detailsAt(level_), [&](std::size_t number) { return isJudged(number); }, justSolved);
}

void DenseRows::solveRows(std::size_t heldOut, int details) {
  solveRows(heldOut, details, every, justSolved);
}

/// Solves every wanted row with the last `heldOut` photographs unseen and `details` leaves with colours of
/// their own, hands what was found to `use`, and learns from it.
void DenseRows::solveRows(std::size_t heldOut, int details, const Wanted& wanted, const Use& use) {
  RowSettings model;
  model.details = details;
  parallelFor(0, photographs_.parts(), 1, [&](std::size_t part) {
    if (!photographs_.isUsed(part)) return;
    const DensePhotographs::Rows shown(photographs_, part);
    RowRegression regression(means_, model);
    RowLight seen;
    Row row;
    for (std::size_t number = shown.begin(); number < shown.end(); ++number) {
      if (rows_.leavesOf(number).empty() || !wanted(number)) continue;
      rows_.read(number, row);
      shown.read(number, heldOut, seen);
      const RowFit& fit = regression.solve(row, seen);
      use(part, shown, number, row, regression, seen);
      multiplexing::learn(row, fit, photographs_.floodMixing(number), model);
      rows_.write(number, row);
    }
  });
}

std::vector<std::size_t> DenseRows::judge(std::size_t heldOut) {
  std::vector<PhotographReview> parts(photographs_.parts(), PhotographReview(photographs_.size()));
  solveRows(heldOut, detailsAt(level_), every,
            [&](std::size_t part, const DensePhotographs::Rows&, std::size_t number, const Row& row,
                RowRegression& regression,
                const RowLight& seen) { parts[part].add(number, seen, regression.predict(), row.excess); });
  PhotographReview found(photographs_.size());
  for (const PhotographReview& part : parts) found.add(part);
  std::vector<float> gains = found.gains();
  for (std::size_t number = 0; number < gains.size(); ++number) photographs_.divide(number, gains[number]);
  std::vector<std::size_t> spoilt = found.spoilt();
  DensePhotographs::Rejections unseen;
  for (auto [row, number] : found.contradictions())
    if (std::ranges::binary_search(spoilt, number)) unseen.emplace_back(row, number);
  photographs_.reject(unseen);
  return spoilt;
}

/// By chance, so that no row or column of the picture counts more than another.
bool DenseRows::isJudged(std::size_t number) const {
  std::size_t apart = rows_.size() / judgedRows;
  return apart < 2 || Random{number}.below(apart) == 0;
}

double DenseRows::predict(std::size_t heldOut) {
  std::vector<Prediction> parts(photographs_.parts());
  solveRows(
      heldOut, detailsAt(level_), [&](std::size_t number) { return isJudged(number); },
      [&](std::size_t part, const DensePhotographs::Rows& shown, std::size_t number, const Row&,
          RowRegression& regression, const RowLight&) {
        const Eigen::ArrayX3f& predicted = regression.predict();
        for (std::size_t i = photographs_.size() - heldOut; i < photographs_.size(); ++i) {
          auto [light, variance] = shown.shown(i, number);
          parts[part].add(photographs_.flood(number), light, variance,
                          light - predicted.row(static_cast<Eigen::Index>(i)).transpose());
        }
      });
  Prediction all;
  for (const Prediction& part : parts) all.add(part);
  return all.error();
}

void DenseRows::divide() {
  divisions_.push_back({level_, photographs_.size()});
  multiplexing::divide(rows_, references_.cameras, means_.layout(), level_, thresholds_, {});
  level_ = std::max(0, level_ - 1);
}

transport::Draft DenseRows::draft() const {
  return draftOf(rows_, photographs_, references_, means_.layout(), level_);
}

/// The row's leaves in radiance.
void DenseRows::encodeRow(std::size_t number, const Row& row, const RowFit& fit,
                          transport::SharedColourEncoder& encoder,
                          transport::SharedColourRow& encoded) const {
  const Eigen::Vector3f flood = photographs_.flood(number);
  std::vector<std::uint32_t> nodes;
  std::vector<transport::ColourBlock> blocks;
  for (std::size_t j = 0; j < fit.blocks.size(); ++j) {
    nodes.push_back(row.leaves[j].node);
    blocks.push_back(flood.asDiagonal() * fit.blocks[j]);
  }
  encoder.encode(nodes, blocks, encoded);
}

/// What is known of a row besides its leaves.
void DenseRows::describeRow(std::size_t number, const Row& row, const RowFit& fit,
                            const Eigen::Array3f& floodVariance, MeasuredTransport& measured) const {
  const Eigen::Array3f flood = photographs_.flood(number);
  float variance = 0.0f;
  for (const Leaf& leaf : row.leaves) variance += leaf.deviation * leaf.deviation;
  // A third of a leaf's light is in each projector channel.
  variance /= 9.0f * static_cast<float>(std::max<std::size_t>(1, fit.blocks.size()));
  Eigen::Map<Eigen::Array3f>(&measured.leafVariance[3 * number]) = flood.square() * variance;
  Eigen::Map<Eigen::Array3f>(&measured.floods.light[3 * number]) = flood * fit.flood;
  Eigen::Map<Eigen::Array3f>(&measured.floods.variance[3 * number]) = flood.square() * floodVariance;
}

MeasuredTransport DenseRows::finish() {
  RowSettings model;
  model.details = detailsAt(level_);
  const std::size_t count = rows_.size();
  MeasuredTransport measured;
  measured.leafVariance.assign(3 * count, 0.0f);
  measured.unknown.assign(count, 0);
  measured.floods = floodsOf(references_);
  const transport::ColumnKinds kinds = transport::nearAndFar(means_.layout(), model.nearLevels);
  transport::SharedColourWriter writer(means_.layout().count(), count, kinds, rows_.leaves());
  constexpr std::size_t together = DensePhotographs::rowsTogether;
  std::vector<transport::SharedColourRow> encoded(std::min(partsWritten * together, count));
  for (std::size_t first = 0; first < photographs_.parts(); first += partsWritten) {
    std::size_t last = std::min(first + partsWritten, photographs_.parts()), begin = first * together;
    parallelFor(first, last, 1, [&](std::size_t part) {
      transport::SharedColourEncoder encoder(kinds);
      for (std::size_t number = part * together; number < std::min((part + 1) * together, count); ++number)
        encoder.encode({}, {}, encoded[number - begin]);
      if (!photographs_.isUsed(part)) return;
      const DensePhotographs::Rows shown(photographs_, part);
      RowRegression regression(means_, model);
      RowLight seen;
      Row row;
      for (std::size_t number = shown.begin(); number < shown.end(); ++number) {
        if (rows_.leavesOf(number).empty()) continue;
        rows_.read(number, row);
        shown.read(number, 0, seen);
        const RowFit& fit = regression.solve(row, seen);
        encodeRow(number, row, fit, encoder, encoded[number - begin]);
        describeRow(number, row, fit, regression.floodVariance(row), measured);
        measured.unknown[number] = shown.hardlySeen(number) ? 1 : 0;
      }
    });
    const std::size_t end = std::min(last * together, count);
    for (std::size_t number = begin; number < end; ++number) writer.add(encoded[number - begin]);
    rows_.forgetBefore(end);
  }
  measured.transport =
      transport::TransportMatrix(references_.cameras, references_.projectors, writer.build());
  return measured;
}

}  // namespace relucent::acquisition
