// SPDX-License-Identifier: MIT
#include "relucent/acquisition/multiplexed.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "relucent/acquisition/dense_photographs.h"
#include "relucent/acquisition/draft.h"
#include "relucent/acquisition/exposure_cycle.h"
#include "relucent/acquisition/photograph_review.h"
#include "relucent/base/message.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/multiplexing/division.h"
#include "relucent/multiplexing/learning.h"
#include "relucent/multiplexing/pattern.h"
#include "relucent/platform/process.h"

namespace relucent::acquisition {
namespace {

using multiplexing::Leaf;
using multiplexing::Row;
using multiplexing::RowFit;
using multiplexing::RowLight;
using multiplexing::RowRegression;
using Code = transport::BlockSparseWriter::Code;

constexpr float startingSpread = 0.1f;
constexpr float rootSpread = 1.0f;
// Equations for each unknown that a level adds, in all but some camera pixels.
constexpr double equationsPerLeaf = 2.0;
constexpr double served = 0.9;
constexpr int fewestPatterns = 8, mostPatterns = 64;
// At the finest level: patterns that are predicted at a time, the most of all, and the share of its error
// that a prediction has to lose for more of them to be worth while.
constexpr int predictedPatterns = 8, mostFinest = 96;
constexpr double worthMore = 0.04;
// As long as leaves are to be divided, few of them need colours of their own.
constexpr int fewDetails = 4;
// Camera pixels of which the predictions are judged, about.
constexpr std::size_t judgedRows = 40000;
// Patterns that have to wait for a check before one is made only to confirm them.
constexpr int fewUnconfirmed = 28;
// Thresholds of dim pixels are raised by at most this.
constexpr float mostDimming = 10.0f;
// Parts of the camera pixels that wait to be written.
constexpr std::size_t partsWritten = 32;
// Parts after which the system gets back the memory that they had: some 50 MB.
constexpr std::size_t partsReturned = 256;

int detailsAt(int level) {
  return level > 0 ? fewDetails : multiplexing::RowSettings().details;
}

/// How well photographs that were held out are predicted.
struct Prediction {
  double squared = 0.0, variance = 0.0, light = 0.0;

  double error() const { return light > 0.0 ? std::sqrt(std::max(0.0, squared - variance) / light) : 0.0; }
  void add(const Prediction& other) {
    squared += other.squared;
    variance += other.variance;
    light += other.light;
  }
};

/// A pattern that was photographed.
struct Taken {
  int level = 0, number = 0;
  int shot = 0;        // those before this one include it
  bool again = false;  // what an earlier photograph of it showed had been spoilt
};

struct Photographed {
  Taken what;
  DensePhotographs::Stored stored;
};

/// From the coarsest level to the finest. While a level's rows are solved, the first patterns of the next one
/// are photographed: as many as each has, so that none is in vain.
class Measurement {
 public:
  Measurement(const TreeContext& context, const photography::Photographer& photographer,
              const AcquisitionSettings& settings)
      : context_(context),
        references_(context.references()),
        settings_(settings),
        cycle_(exposureCycle(references_, photographer)),
        photographs_(references_),
        means_(transport::NodeLayout(references_.projectors)),
        rows_(references_.usable.size()),
        thresholds_(rows_.size()) {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      float strongest = std::max(photographs_.flood(row).maxCoeff(), 1e-6f * references_.typical);
      float dimming = static_cast<float>(settings.dimShare) * references_.typical / strongest;
      thresholds_[row] =
          static_cast<float>(settings.relativeThreshold) * std::clamp(dimming, 1.0f, mostDimming);
    }
  }

  std::optional<sentinels::Interruption> run(bool rootsOnly, Progress& progress) {
    const transport::NodeLayout& layout = means_.layout();
    start_ = rootsOnly ? layout.levels() : multiplexing::startingLevel(layout);
    begin(rootsOnly ? rootSpread : startingSpread);
    if (rootsOnly) return std::nullopt;
    for (int level = start_; level >= 0; --level) {
      int patterns = patternsFor(level);
      if (patterns == 0) continue;
      levels_.push_back(patterns);
      context_.observer.grew(levels_, 0);
      Progress part = progress.part((level > 0 ? 1.0 : 2.0) / (start_ + 2),
                                    RELUCENT_MESSAGE("stage.dense-patterns", "patterns in blocks of {} px")
                                        .with(as::label(1 << level)));
      if (auto interrupted = photograph(level, patterns, part)) return interrupted;
      if (level == 0) {
        if (auto interrupted = refine(part)) return interrupted;
        break;
      }
      std::vector<std::size_t> spoilt;
      auto solveLevel = [&] {
        model_.details = 0;
        solve();
        model_.details = detailsAt(level);
        spoilt = judge(0);
      };
      auto disturbed =
          computeWhile(solveLevel, [&] { return photographAhead(level - 1, 0, fewestPatterns, part); });
      if (disturbed) return interrupted(*disturbed);
      if (auto interrupted = settle(spoilt, part)) return interrupted;
      tellDraft(level);
      if ((isStopped_ = progress.stopAndKeep())) break;
      divide(level);
    }
    return confirm(progress);
  }

  MeasuredTransport finish();

 private:
  /// A level whose patterns have been used, and how many photographs there were then.
  struct Division {
    int level = 0;
    std::size_t photographs = 0;
  };

  void begin(float spread);
  void divide(int level);
  void beginAnew();
  std::optional<sentinels::Interruption> confirm(const Progress& progress);
  std::optional<sentinels::Interruption> interrupted(sentinels::Interruption how);
  int patternsFor(int level) const;
  std::optional<sentinels::Interruption> photograph(int level, int patterns, Progress& part);
  std::optional<sentinels::Interruption> photographAhead(int level, int first, int patterns, Progress& part);
  std::optional<sentinels::Interruption> photograph(Taken what, std::vector<Photographed>& to,
                                                    Progress& part);
  std::optional<sentinels::Interruption> take(int level, const std::vector<Taken>& wanted,
                                              std::vector<Photographed> photographed, Progress& part);
  void told(int level, int patterns, Progress& part) const;
  ProjectorStack patternOf(const Taken& what) const {
    return multiplexing::blockPattern(references_.projectors, what.level, what.number, settings_.seed);
  }
  std::optional<sentinels::Interruption> refine(Progress& part);
  std::optional<sentinels::Interruption> settle(const std::vector<std::size_t>& spoilt, Progress& part);
  std::vector<std::size_t> judge(std::size_t heldOut);
  void tellDraft(int level, double error = 0.0) const;
  bool isJudged(std::size_t row) const;
  template <typename Wanted, typename Use>
  void solveRows(std::size_t heldOut, const Wanted& wanted, const Use& use);
  template <typename Wanted>
  void solve(const Wanted& wanted, std::size_t heldOut = 0);
  void solve() {
    solve([](std::size_t) { return true; });
  }
  Prediction predict();
  Prediction predicted(std::size_t row, const DensePhotographs::Rows& shown,
                       const Eigen::ArrayX3f& predictions) const;
  void finishRow(std::size_t row, const RowFit& fit, const Eigen::Array3f& floodVariance,
                 std::vector<Code>& codes, MeasuredTransport& measured) const;

  const TreeContext& context_;
  const photography::References& references_;
  const AcquisitionSettings& settings_;
  std::vector<std::size_t> cycle_;
  DensePhotographs photographs_;
  multiplexing::PatternMeans means_;
  multiplexing::RowSettings model_;
  std::vector<Row> rows_;
  std::vector<float> thresholds_;    // relative to F
  std::vector<int> levels_;          // patterns of the levels that have begun
  std::vector<Taken> taken_;         // a photograph each
  std::vector<Photographed> ahead_;  // of patterns that the rows do not know yet
  std::vector<Division> divisions_;
  int start_ = 0;           // the coarsest level
  bool isStopped_ = false;  // before it was as fine as asked for
};

void Measurement::begin(float spread) {
  std::vector<Leaf> leaves = multiplexing::startingLeaves(means_.layout(), start_, spread);
  parallelFor(0, rows_.size(), 1024, [&](std::size_t row) {
    rows_[row] = {};
    if (!references_.usable[row]) return;
    for (const transport::ColourBlock& mixing : photographs_.floodMixing(row))
      rows_[row].mixing.insert(rows_[row].mixing.end(), 2, mixing);
    rows_[row].excess = model_.leastExcess * model_.leastExcess;
    rows_[row].leaves = leaves;
  });
}

void Measurement::divide(int level) {
  divisions_.push_back({level, photographs_.size()});
  multiplexing::divide(rows_, references_.cameras, means_.layout(), level, thresholds_, {});
}

/// Divides rows as the photographs that are left would have had them divided. What those that are gone said,
/// in the dark or with something in the way, would stay in the rows as spreads and leaves otherwise.
void Measurement::beginAnew() {
  const std::vector<Division> before = std::exchange(divisions_, {});
  photographs_.forgetJudgements();
  begin(startingSpread);
  for (const Division& division : before) {
    if (division.photographs > photographs_.size()) break;
    std::size_t later = photographs_.size() - division.photographs;
    auto all = [](std::size_t) { return true; };
    model_.details = detailsAt(division.level);
    solve(all, later);
    if (!judge(later).empty()) solve(all, later);
    divide(division.level);
  }
}

int Measurement::patternsFor(int level) const {
  std::vector<std::size_t> unknown;
  for (const Row& row : rows_)
    if (!row.leaves.empty())
      unknown.push_back(
          static_cast<std::size_t>(std::count_if(row.leaves.begin(), row.leaves.end(), [&](const Leaf& leaf) {
            return means_.layout().node(leaf.node).level == level;
          })));
  if (unknown.empty()) return 0;
  auto many = unknown.begin() + static_cast<std::ptrdiff_t>(served * static_cast<double>(unknown.size() - 1));
  std::nth_element(unknown.begin(), many, unknown.end());
  // A photograph gives three equations, one for each channel.
  return std::clamp(static_cast<int>(std::ceil(equationsPerLeaf * static_cast<double>(*many) / 3.0)),
                    fewestPatterns, mostPatterns);
}

/// The level's next patterns, those included that were photographed ahead.
std::optional<sentinels::Interruption> Measurement::photograph(int level, int patterns, Progress& part) {
  if (context_.watch.shots() - context_.watch.confirmed() >= fewUnconfirmed)
    if (auto disturbed = confirm(part)) return disturbed;
  std::vector<Photographed> photographed = std::exchange(ahead_, {});
  std::erase_if(photographed, [&](const Photographed& ahead) { return ahead.what.level != level; });
  std::vector<Taken> wanted;
  for (int number = levels_.back() - patterns + static_cast<int>(photographed.size());
       number < levels_.back(); ++number)
    wanted.push_back({level, number});
  return take(level, wanted, std::move(photographed), part);
}

/// Photographs patterns of a level while rows are solved without them.
std::optional<sentinels::Interruption> Measurement::photographAhead(int level, int first, int patterns,
                                                                    Progress& part) {
  for (int number = first; number < first + patterns && !part.stopAndKeep(); ++number)
    if (auto disturbed = photograph({level, number}, ahead_, part)) return disturbed;
  return std::nullopt;
}

/// One photograph, which the rows do not know yet.
std::optional<sentinels::Interruption> Measurement::photograph(Taken what, std::vector<Photographed>& to,
                                                               Progress& part) {
  auto seen = context_.watch.lightAt(patternOf(what), {cycle_[photographs_.stored() % cycle_.size()]}, part);
  if (!seen) return seen.interruption();
  what.shot = context_.watch.shots();
  to.push_back({what, photographs_.store(*seen)});
  return std::nullopt;
}

/// Photographs patterns of one level, and uses them and those that have been `photographed`.
std::optional<sentinels::Interruption> Measurement::take(int level, const std::vector<Taken>& wanted,
                                                         std::vector<Photographed> photographed,
                                                         Progress& part) {
  std::optional<sentinels::Interruption> disturbed;
  for (const Taken& what : wanted) {
    if ((disturbed = photograph(what, photographed, part))) break;
    if (!what.again) told(level, what.number + 1, part);
  }
  std::vector<ProjectorStack> shown;
  for (const Photographed& photograph : photographed) {
    shown.push_back(patternOf(photograph.what));
    photographs_.add(photograph.stored);
    taken_.push_back(photograph.what);
  }
  means_.add(level, shown);
  return disturbed ? interrupted(*disturbed) : std::nullopt;
}

/// How many patterns of a level there are so far.
void Measurement::told(int level, int patterns, Progress& part) const {
  part.report(static_cast<double>(patterns) / static_cast<double>(level > 0 ? levels_.back() : mostFinest));
  context_.observer.grew(levels_, patterns);
}

/// A check, unless there has just been one.
std::optional<sentinels::Interruption> Measurement::confirm(const Progress& progress) {
  std::optional<sentinels::Interruption> disturbed = context_.watch.check(progress);
  return disturbed ? interrupted(*disturbed) : std::nullopt;
}

/// T is to follow from the photographs that a check has confirmed, and from no others.
std::optional<sentinels::Interruption> Measurement::interrupted(sentinels::Interruption how) {
  isStopped_ = true;
  std::erase_if(taken_, [&](const Taken& taken) { return taken.shot > context_.watch.confirmed(); });
  if (how == sentinels::Interruption::beginAgain || taken_.size() == photographs_.size()) return how;
  photographs_.keep(taken_.size());
  means_.keep(taken_.size());
  beginAnew();
  return how;
}

std::optional<sentinels::Interruption> Measurement::refine(Progress& part) {
  double before = 0.0, error = 0.0;
  bool isFine = false;
  model_.details = detailsAt(0);
  // The others wait for the last of these patterns.
  auto solveJudged = [this] { solve([this](std::size_t row) { return isJudged(row); }); };
  const int ahead = levels_.back() + predictedPatterns <= mostFinest ? predictedPatterns : 0;
  if (auto disturbed =
          computeWhile(solveJudged, [&] { return photographAhead(0, levels_.back(), ahead, part); }))
    return interrupted(*disturbed);
  while (!isFine && levels_.back() + predictedPatterns <= mostFinest && !part.stopAndKeep()) {
    levels_.back() += predictedPatterns;
    if (auto interrupted = photograph(0, predictedPatterns, part)) return interrupted;
    error = predict().error();
    tellDraft(0, error);
    isFine = error < settings_.relativeThreshold || (before > 0.0 && error > (1.0 - worthMore) * before);
    before = error;
  }
  isStopped_ = !isFine && part.stopAndKeep();
  if (auto interrupted = settle(judge(0), part)) return interrupted;
  tellDraft(0, error);
  divide(0);
  return std::nullopt;
}

/// What the rows say, to whoever looks on.
void Measurement::tellDraft(int level, double error) const {
  if (!context_.observer.wantsDrafts()) return;
  transport::Draft draft = draftOf(rows_, photographs_, references_, means_.layout(), level);
  draft.error = error;
  draft.aim = settings_.relativeThreshold;
  context_.observer.drafted(draft);
}

/// By chance, so that no row or column of the picture counts more than another.
bool Measurement::isJudged(std::size_t row) const {
  std::size_t apart = rows_.size() / judgedRows;
  return apart < 2 || Random{row}.below(apart) == 0;
}

/// Solves every wanted row with the last `heldOut` photographs unseen, hands what was found to
/// `use(part, shown, row, regression, seen)`, and learns from it.
template <typename Wanted, typename Use>
void Measurement::solveRows(std::size_t heldOut, const Wanted& wanted, const Use& use) {
  parallelFor(0, photographs_.parts(), 1, [&](std::size_t part) {
    const DensePhotographs::Rows shown(photographs_, part);
    RowRegression regression(means_, model_);
    RowLight seen;
    for (std::size_t row = shown.begin(); row < shown.end(); ++row) {
      if (rows_[row].leaves.empty() || !wanted(row)) continue;
      shown.read(row, heldOut, seen);
      const RowFit& fit = regression.solve(rows_[row], seen);
      use(part, shown, row, regression, seen);
      multiplexing::learn(rows_[row], fit, photographs_.floodMixing(row), model_);
    }
  });
}

template <typename Wanted>
void Measurement::solve(const Wanted& wanted, std::size_t heldOut) {
  solveRows(heldOut, wanted,
            [](std::size_t, const DensePhotographs::Rows&, std::size_t, RowRegression&, const RowLight&) {});
}

/// Photographs again what was spoilt.
std::optional<sentinels::Interruption> Measurement::settle(const std::vector<std::size_t>& spoilt,
                                                           Progress& part) {
  if (spoilt.empty()) return std::nullopt;
  std::map<int, std::vector<Taken>, std::greater<>> wanted;  // by level
  for (std::size_t number : spoilt) {
    Taken& taken = taken_[number];
    if (std::exchange(taken.again, true)) continue;
    context_.watch.contradicted(taken.shot - 1, 1);
    wanted[taken.level].push_back(taken);
  }
  for (const auto& [level, patterns] : wanted)
    if (auto interrupted = take(level, patterns, {}, part)) return interrupted;
  solve();
  return std::nullopt;
}

/// Solves once more without the last `heldOut` photographs, corrects the others for the lamp's light in each,
/// and leaves out what contradicts the rest. Returns: photographs that were spoilt, by number.
std::vector<std::size_t> Measurement::judge(std::size_t heldOut) {
  std::vector<PhotographReview> parts(photographs_.parts(), PhotographReview(photographs_.size()));
  solveRows(
      heldOut, [](std::size_t) { return true; },
      [&](std::size_t part, const DensePhotographs::Rows&, std::size_t row, RowRegression& regression,
          const RowLight& seen) { parts[part].add(row, seen, regression.predict(), rows_[row].excess); });
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

Prediction Measurement::predict() {
  std::vector<Prediction> parts(photographs_.parts());
  solveRows(
      predictedPatterns, [&](std::size_t row) { return isJudged(row); },
      [&](std::size_t part, const DensePhotographs::Rows& shown, std::size_t row, RowRegression& regression,
          const RowLight&) { parts[part].add(predicted(row, shown, regression.predict())); });
  Prediction all;
  for (const Prediction& part : parts) all.add(part);
  return all;
}

Prediction Measurement::predicted(std::size_t row, const DensePhotographs::Rows& shown,
                                  const Eigen::ArrayX3f& predictions) const {
  Prediction prediction;
  Eigen::Array3d flood = photographs_.flood(row).cast<double>();
  for (std::size_t number = photographs_.size() - predictedPatterns; number < photographs_.size(); ++number) {
    auto [light, variance] = shown.shown(number, row);
    Eigen::Array3f off = light - predictions.row(static_cast<Eigen::Index>(number)).transpose();
    for (Eigen::Index c = 0; c < 3; ++c) {
      if (!std::isfinite(variance[c])) continue;
      double unit = flood[c] * flood[c];
      prediction.squared += unit * static_cast<double>(off[c] * off[c]);
      prediction.variance += unit * static_cast<double>(variance[c]);
      prediction.light += unit * static_cast<double>(light[c] * light[c]);
    }
  }
  return prediction;
}

/// The row's leaves as codes, what rounding leaves over handed on to the next, and what is known of them.
void Measurement::finishRow(std::size_t row, const RowFit& fit, const Eigen::Array3f& floodVariance,
                            std::vector<Code>& codes, MeasuredTransport& measured) const {
  Eigen::Array3f flood = photographs_.flood(row);
  float scale = references_.fullScale[row] / 32767.0f, variance = 0.0f;
  transport::ColourBlock rest = transport::ColourBlock::Zero();
  for (std::size_t j = 0; j < fit.blocks.size(); ++j) {
    transport::ColourBlock value = fit.blocks[j];
    value.array().colwise() *= flood;
    value += rest;
    codes.push_back(transport::codeOf(value, scale));
    for (std::size_t i = 0; i < 9; ++i)
      rest.data()[i] = value.data()[i] - scale * static_cast<float>(codes.back()[i]);
    variance += rows_[row].leaves[j].deviation * rows_[row].leaves[j].deviation;
  }
  // A third of a leaf's light is in each projector channel.
  variance /= 9.0f * static_cast<float>(std::max<std::size_t>(1, fit.blocks.size()));
  Eigen::Map<Eigen::Array3f>(&measured.leafVariance[3 * row]) = flood.square() * variance;
  Eigen::Map<Eigen::Array3f>(&measured.floods.light[3 * row]) = flood * fit.flood;
  Eigen::Map<Eigen::Array3f>(&measured.floods.variance[3 * row]) = flood.square() * floodVariance;
}

MeasuredTransport Measurement::finish() {
  std::size_t count = rows_.size(), leaves = 0;
  for (const Row& row : rows_) leaves += row.leaves.size();
  MeasuredTransport measured;
  measured.isStopped = isStopped_;
  measured.leafVariance.assign(3 * count, 0.0f);
  measured.unknown.assign(count, 0);
  measured.floods = floodsOf(references_);
  transport::BlockSparseWriter writer(means_.layout().count(), references_.fullScale, leaves);
  constexpr std::size_t together = DensePhotographs::rowsTogether;
  std::vector<std::vector<Code>> codes(std::min(partsWritten * together, count));
  for (std::size_t first = 0; first < photographs_.parts(); first += partsWritten) {
    std::size_t last = std::min(first + partsWritten, photographs_.parts()), begin = first * together;
    parallelFor(first, last, 1, [&](std::size_t part) {
      const DensePhotographs::Rows shown(photographs_, part);
      RowRegression regression(means_, model_);
      RowLight seen;
      for (std::size_t row = shown.begin(); row < shown.end(); ++row) {
        codes[row - begin].clear();
        if (rows_[row].leaves.empty()) continue;
        shown.read(row, 0, seen);
        const RowFit& fit = regression.solve(rows_[row], seen);
        finishRow(row, fit, regression.floodVariance(rows_[row]), codes[row - begin], measured);
        measured.unknown[row] = shown.hardlySeen(row) ? 1 : 0;
      }
    });
    for (std::size_t row = begin; row < std::min(last * together, count); ++row) {
      for (std::size_t j = 0; j < rows_[row].leaves.size(); ++j)
        writer.add(rows_[row].leaves[j].node, codes[row - begin][j]);
      writer.endRow();
      rows_[row] = {};  // two of them need not fit into memory
    }
    if (last % partsReturned == 0) platform::returnFreedMemory();
  }
  measured.transport =
      transport::TransportMatrix(references_.cameras, references_.projectors, writer.build());
  return measured;
}

}  // namespace

std::optional<sentinels::Interruption> measureMultiplexed(MeasuredTransport& measured,
                                                          const TreeContext& context,
                                                          const photography::Photographer& photographer,
                                                          const AcquisitionSettings& settings, bool rootsOnly,
                                                          Progress& progress) {
  Measurement measurement(context, photographer, settings);
  std::optional<sentinels::Interruption> interrupted = measurement.run(rootsOnly, progress);
  if (interrupted != sentinels::Interruption::beginAgain) measured = measurement.finish();
  return interrupted;
}

}  // namespace relucent::acquisition
