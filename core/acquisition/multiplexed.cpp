// SPDX-License-Identifier: MIT
#include "relucent/acquisition/multiplexed.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "relucent/acquisition/dense_rows.h"
#include "relucent/acquisition/exposure_cycle.h"
#include "relucent/base/message.h"
#include "relucent/base/parallel.h"
#include "relucent/multiplexing/pattern.h"

namespace relucent::acquisition {
namespace {

// At the finest level: patterns that are predicted at a time, the most of all, and the share of its error
// that a prediction has to lose for more of them to be worth while.
constexpr int predictedPatterns = 8, mostFinest = 96;
constexpr double worthMore = 0.04;
// Patterns that have to wait for a check before one is made only to confirm them.
constexpr int fewUnconfirmed = 28;

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

/// From the coarsest level to the finest. While a level's rows are solved, patterns of the next one are
/// photographed: first as many as each has, then as many as the rows that were solved without them ask for.
class Measurement {
 public:
  Measurement(const TreeContext& context, const photography::References& references,
              const photography::Photographer& photographer, const AcquisitionSettings& settings)
      : context_(context),
        references_(references),
        settings_(settings),
        cycle_(exposureCycle(references_, photographer)),
        rows_(references_, settings) {}

  std::optional<sentinels::Interruption> run(Progress& progress) {
    const int start = rows_.begin();
    int patterns = rows_.patternsNeeded();
    for (int level = start; level >= 0 && patterns > 0; --level) {
      levels_.push_back(patterns);
      context_.observer.grew(levels_, 0);
      Progress part = progress.part((level > 0 ? 1.0 : 2.0) / (start + 2),
                                    RELUCENT_MESSAGE("stage.dense-patterns", "patterns in blocks of {} px")
                                        .with(as::label(1 << level)));
      if (auto interrupted = photograph(level, patterns, part)) return interrupted;
      if (level == 0) {
        if (auto interrupted = refine(part)) return interrupted;
        break;
      }
      if (auto interrupted = solve(level, patterns, part)) return interrupted;
      tellDraft();
      isStopped_ = progress.stopAndKeep();
      if (isStopped_) break;
      rows_.divide();
    }
    return confirm(progress);
  }

  void beginWithRoots() { rows_.beginWithRoots(); }

  MeasuredTransport finish() {
    MeasuredTransport measured = rows_.finish();
    measured.isStopped = isStopped_;
    return measured;
  }

 private:
  std::optional<sentinels::Interruption> confirm(const Progress& progress);
  std::optional<sentinels::Interruption> interrupted(sentinels::Interruption how);
  std::optional<sentinels::Interruption> photograph(int level, int patterns, Progress& part);
  std::optional<sentinels::Interruption> photographAhead(int level, int first, int patterns, Progress& part);
  std::optional<sentinels::Interruption> photograph(Taken what, std::vector<Photographed>& to,
                                                    Progress& part);
  std::optional<sentinels::Interruption> take(int level, const std::vector<Taken>& wanted,
                                              std::vector<Photographed> photographed, Progress& part);
  std::optional<sentinels::Interruption> solve(int level, int& next, Progress& part);
  std::optional<sentinels::Interruption> refine(Progress& part);
  std::optional<sentinels::Interruption> settle(const std::vector<std::size_t>& spoilt, Progress& part);
  void told(int level, int patterns, Progress& part) const;
  void tellDraft(double error = 0.0) const;
  ProjectorStack patternOf(const Taken& what) const {
    return multiplexing::blockPattern(references_.projectors, what.level, what.number, settings_.seed);
  }

  const TreeContext& context_;
  const photography::References& references_;
  const AcquisitionSettings& settings_;
  std::vector<std::size_t> cycle_;
  DenseRows rows_;
  std::vector<int> levels_;          // patterns of the levels that have begun
  std::vector<Taken> taken_;         // a photograph each
  std::vector<Photographed> ahead_;  // of patterns that the rows do not know yet
  bool isStopped_ = false;           // before it was as fine as asked for
};

/// The level's last `patterns`, those included that were photographed ahead.
std::optional<sentinels::Interruption> Measurement::photograph(int level, int patterns, Progress& part) {
  if (context_.watch.shots() - context_.watch.confirmed() >= fewUnconfirmed)
    if (auto disturbed = confirm(part)) return disturbed;
  std::vector<Photographed> photographed = std::exchange(ahead_, {});
  const int through = levels_.back() - patterns + static_cast<int>(photographed.size());
  if (!photographed.empty()) told(level, through, part);
  std::vector<Taken> wanted;
  for (int number = through; number < levels_.back(); ++number) wanted.push_back({level, number});
  return take(level, wanted, std::move(photographed), part);
}

/// While rows are solved without them: patterns of a level from the number `first` on, until so many are
/// ahead.
std::optional<sentinels::Interruption> Measurement::photographAhead(int level, int first, int patterns,
                                                                    Progress& part) {
  while (static_cast<int>(ahead_.size()) < patterns && !part.stopAndKeep())
    if (auto disturbed = photograph({level, first + static_cast<int>(ahead_.size())}, ahead_, part))
      return disturbed;
  return std::nullopt;
}

/// One photograph, which the rows do not know yet.
std::optional<sentinels::Interruption> Measurement::photograph(Taken what, std::vector<Photographed>& to,
                                                               Progress& part) {
  auto seen = context_.watch.lightOfRandomAt(patternOf(what), {cycle_[rows_.stored() % cycle_.size()]}, part);
  if (!seen) return seen.interruption();
  what.shot = context_.watch.shots();
  to.push_back({what, rows_.store(*seen)});
  return std::nullopt;
}

/// Photographs patterns of one level, and uses them and those that have been `photographed`.
std::optional<sentinels::Interruption> Measurement::take(int level, const std::vector<Taken>& wanted,
                                                         std::vector<Photographed> photographed,
                                                         Progress& part) {
  std::optional<sentinels::Interruption> disturbed;
  for (const Taken& what : wanted) {
    disturbed = photograph(what, photographed, part);
    if (disturbed) break;
    if (!what.again) told(level, what.number + 1, part);
  }
  std::vector<ProjectorStack> patterns;
  std::vector<DensePhotographs::Stored> stored;
  for (const Photographed& photograph : photographed) {
    patterns.push_back(patternOf(photograph.what));
    stored.push_back(photograph.stored);
    taken_.push_back(photograph.what);
  }
  rows_.use(level, patterns, stored);
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
  if (how != sentinels::Interruption::beginAgain && taken_.size() < rows_.photographs())
    rows_.beginAnew(taken_.size());
  return how;
}

/// Solves the rows of a level. Returns, in `next`: how many patterns the next level has.
std::optional<sentinels::Interruption> Measurement::solve(int level, int& next, Progress& part) {
  std::optional<sentinels::Interruption> disturbed =
      computeWhile([&] { rows_.solveLight(); },
                   [&] { return photographAhead(level - 1, 0, DenseRows::fewestPatterns, part); });
  if (disturbed) return interrupted(*disturbed);
  next = rows_.patternsNeededNext();
  std::vector<std::size_t> spoilt;
  disturbed = computeWhile([&] { spoilt = rows_.judge(); },
                           [&] { return photographAhead(level - 1, 0, next, part); });
  if (disturbed) return interrupted(*disturbed);
  return settle(spoilt, part);
}

std::optional<sentinels::Interruption> Measurement::refine(Progress& part) {
  double before = 0.0, error = 0.0;
  bool isFine = false;
  // The rows that are not judged wait for the last of these patterns.
  const int ahead = levels_.back() + predictedPatterns <= mostFinest ? predictedPatterns : 0;
  if (auto disturbed = computeWhile([&] { rows_.solveJudged(); },
                                    [&] { return photographAhead(0, levels_.back(), ahead, part); }))
    return interrupted(*disturbed);
  while (!isFine && levels_.back() + predictedPatterns <= mostFinest && !part.stopAndKeep()) {
    levels_.back() += predictedPatterns;
    if (auto interrupted = photograph(0, predictedPatterns, part)) return interrupted;
    error = rows_.predict(predictedPatterns);
    tellDraft(error);
    isFine = error < settings_.relativeThreshold || (before > 0.0 && error > (1.0 - worthMore) * before);
    before = error;
  }
  isStopped_ = !isFine && part.stopAndKeep();
  Progress working =
      part.part(1.0, RELUCENT_MESSAGE("stage.working-out-finest-blocks", "working out the finest blocks"));
  if (auto interrupted = settle(rows_.judge(), working)) return interrupted;
  tellDraft(error);
  working.report(0.5);
  rows_.divide();
  return std::nullopt;
}

/// What the rows say, to whoever looks on.
void Measurement::tellDraft(double error) const {
  if (!context_.observer.wantsDrafts()) return;
  transport::Draft draft = rows_.draft();
  draft.error = error;
  draft.aim = settings_.relativeThreshold;
  context_.observer.drafted(draft);
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
  rows_.solve();
  return std::nullopt;
}

}  // namespace

std::optional<sentinels::Interruption> measureMultiplexed(MeasuredTransport& measured,
                                                          const TreeContext& context,
                                                          const photography::References& references,
                                                          const photography::Photographer& photographer,
                                                          const AcquisitionSettings& settings, bool rootsOnly,
                                                          Progress& progress) {
  Measurement measurement(context, references, photographer, settings);
  std::optional<sentinels::Interruption> interrupted;
  if (rootsOnly)
    measurement.beginWithRoots();
  else
    interrupted = measurement.run(progress);
  if (interrupted != sentinels::Interruption::beginAgain) measured = measurement.finish();
  return interrupted;
}

}  // namespace relucent::acquisition
