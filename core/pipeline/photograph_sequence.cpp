// SPDX-License-Identifier: MIT
#include "relucent/pipeline/photograph_sequence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "relucent/base/median.h"

namespace relucent::pipeline {
namespace {

/// More places than these are not named: something else is wrong then.
constexpr std::size_t mostNamed = 4;

bool isEarlier(const TakenPhotograph& a, const TakenPhotograph& b) {
  return *a.taken < *b.taken;
}

bool haveTimes(const std::vector<TakenPhotograph>& photographs) {
  return std::all_of(photographs.begin(), photographs.end(),
                     [](const TakenPhotograph& photograph) { return photograph.taken.has_value(); });
}

std::string nameOf(const TakenPhotograph& photograph) {
  return photograph.path.filename().string();
}

/// Seconds between neighbours; empty if they are not known or say nothing.
std::vector<double> intervals(const std::vector<TakenPhotograph>& photographs) {
  if (photographs.size() < 4 || !haveTimes(photographs)) return {};
  std::vector<double> seconds;
  for (std::size_t i = 1; i < photographs.size(); ++i)
    seconds.push_back(std::difftime(*photographs[i].taken, *photographs[i - 1].taken));
  return seconds;
}

/// What the intervals say: names of photographs, empty if they say nothing.
std::vector<std::string> suspects(const std::vector<TakenPhotograph>& photographs, bool isMissing) {
  const std::vector<double> seconds = intervals(photographs);
  if (seconds.empty()) return {};
  const double usual = medianOf(seconds);
  // Times are whole seconds: an interval of one may look like none or two. The margins below are for that.
  if (usual < 2.0) return {};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    if (isMissing && seconds[i] > 1.5 * usual + 1.0) names.push_back(nameOf(photographs[i]));
    if (!isMissing && seconds[i] < 0.5 * usual - 0.5) names.push_back(nameOf(photographs[i + 1]));
  }
  if (names.size() > mostNamed) names.clear();
  return names;
}

}  // namespace

PhotographSequence inOrder(std::vector<TakenPhotograph> photographs) {
  std::sort(photographs.begin(), photographs.end(),
            [](const TakenPhotograph& a, const TakenPhotograph& b) { return a.path < b.path; });
  PhotographSequence sequence{std::move(photographs), {}};
  std::vector<TakenPhotograph>& list = sequence.photographs;
  if (list.empty() || !haveTimes(list) || std::is_sorted(list.begin(), list.end(), isEarlier))
    return sequence;
  std::stable_sort(list.begin(), list.end(), isEarlier);
  sequence.finding = RELUCENT_MESSAGE("import.paired-by-time",
                                      "The photographs were paired with the patterns in the order in which "
                                      "they were taken, from {} to {}, which is not that of their names")
                         .with(nameOf(list.front()), nameOf(list.back()));
  return sequence;
}

CountProblem countProblem(const std::vector<TakenPhotograph>& photographs, std::size_t patterns) {
  const std::size_t count = photographs.size();
  const bool isMissing = count < patterns;
  const std::size_t off = isMissing ? patterns - count : count - patterns;
  const Message counts =
      RELUCENT_ENGLISH_MESSAGE("import.patterns-and-photographs", "there are {} patterns but {} photographs")
          .with(patterns, count);
  const Message missing =
      RELUCENT_ENGLISH_PLURAL_MESSAGE("import.missing", "{} are missing", "{} is missing").with(off);
  const Message tooMany =
      RELUCENT_ENGLISH_PLURAL_MESSAGE("import.too-many", "{} are too many", "{} is too many").with(off);
  const std::vector<std::string> names = suspects(photographs, isMissing);
  CountProblem problem;
  problem.what =
      RELUCENT_ENGLISH_MESSAGE("import.count-differs", "{}: {}").with(counts, isMissing ? missing : tooMany);
  if (isMissing)
    problem.advice =
        RELUCENT_ENGLISH_MESSAGE("import.photograph-again",
                                 "photograph the patterns again, or take out those that have no photograph");
  else if (names.empty())
    problem.advice = RELUCENT_ENGLISH_MESSAGE(
        "import.take-out-first-or-last",
        "take out the photographs that show no pattern, usually the first or the last");
  else
    problem.advice = RELUCENT_ENGLISH_MESSAGE("import.take-out-photographs",
                                              "take out the photographs that show no pattern");
  if (names.empty()) return problem;
  const std::string suspected = fmt::to_string(fmt::join(names, ", "));
  problem.what = isMissing ? RELUCENT_ENGLISH_MESSAGE("import.missing-after",
                                                      "{}, judging by the camera's clock after {}")
                                 .with(problem.what, suspected)
                           : RELUCENT_ENGLISH_MESSAGE("import.too-many-suspected",
                                                      "{}, judging by the camera's clock these: {}")
                                 .with(problem.what, suspected);
  return problem;
}

}  // namespace relucent::pipeline
