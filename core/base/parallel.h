// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace relucent {

/// Runs body(i) for every i in [begin, end) on all cores. Bodies must not write to shared places; then
/// the result does not depend on the number of threads. An exception from a body is rethrown here.
/// `grain`: the least number of items worth a task.
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

}  // namespace relucent
