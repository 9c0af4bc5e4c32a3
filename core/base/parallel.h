// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "relucent/base/tbb.h"

namespace relucent {

/// Runs body(i) for every i in [begin, end) on all cores. Bodies must not write to shared memory; then
/// the result does not depend on the number of threads. An exception from a body is rethrown here.
/// `grain`: the least number of items per task.
template <typename Body>
void parallelFor(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

/// Runs body(chunk, chunkBegin, chunkEnd) for a fixed partition of [begin, end) into `chunks` pieces.
/// The partition never depends on the machine: for sums that must be the same bits everywhere, sum
/// within chunks, then over chunks in order.
template <typename Body>
void parallelChunks(std::size_t begin, std::size_t end, std::size_t chunks, const Body& body) {
  tbb::parallel_for(
      std::size_t{0}, chunks,
      [&](std::size_t chunk) {
        std::size_t length = end - begin;
        body(chunk, begin + length * chunk / chunks, begin + length * (chunk + 1) / chunks);
      },
      tbb::simple_partitioner());
}

/// Chunks for sums where nothing asks for another number: enough for the cores of any machine.
inline constexpr std::size_t fixedParts = 64;

/// foreground() on this thread, then wait() for what goes on beside it. If the first throws, abandon() waits
/// in its place; what that throws is lost, since the first exception says more.
template <typename Foreground, typename Abandon, typename Wait>
auto finishedBeside(const Foreground& foreground, const Abandon& abandon, const Wait& wait) {
  auto finished = [&]() -> decltype(foreground()) {
    try {
      return foreground();
    } catch (...) {
      try {
        abandon();
      } catch (...) {  // NOLINT(bugprone-empty-catch): see above
      }
      throw;
    }
  }();
  wait();
  return finished;
}

/// Runs foreground() on this thread, as devices require, and background() on another core; returns the result
/// of the first when both are done. They must not touch the same data. An exception is rethrown here, that of
/// the foreground if both throw. An empty background is skipped.
template <typename Foreground>
auto runWithBackground(const std::function<void()>& background, const Foreground& foreground) {
  if (!background) return foreground();
  tbb::task_group group;
  group.run(background);
  auto wait = [&] { group.wait(); };
  return finishedBeside(foreground, wait, wait);
}

/// Runs waiting() on this thread, which hardly uses its core, as while devices expose, and computing() on all
/// cores; returns the result of the first when both are done. They must not touch the same data. An exception
/// is rethrown here: that of waiting() if both throw, and then parallelFor() inside computing() ends early.
template <typename Waiting>
auto computeWhile(const std::function<void()>& computing, const Waiting& waiting) {
  using Threads = tbb::global_control;
  const int cores = tbb::this_task_arena::max_concurrency();
  const bool allCores =
      Threads::active_value(Threads::max_allowed_parallelism) >= static_cast<std::size_t>(cores);
  // This thread is one of those that are allowed.
  std::optional<Threads> another;
  if (allCores) another.emplace(Threads::max_allowed_parallelism, static_cast<std::size_t>(cores) + 1);
  tbb::task_arena arena(cores, allCores ? 0 : 1);
  tbb::task_group group;
  arena.execute([&] { group.run(computing); });
  auto wait = [&] { arena.execute([&] { group.wait(); }); };
  auto abandon = [&] {
    group.cancel();
    wait();
  };
  return finishedBeside(waiting, abandon, wait);
}

}  // namespace relucent
