// SPDX-License-Identifier: MIT
#include "copy_bandwidth.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <map>
#include <vector>

#include "relucent/base/parallel.h"

namespace relucent::benchmarks {

double copyBandwidth(int threads) {
  static std::map<int, double> known;
  if (auto found = known.find(threads); found != known.end()) return found->second;

  constexpr std::size_t bytes = std::size_t{256} << 20;
  constexpr int copies = 8;
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  std::vector<char> from(bytes, 1), to(bytes, 2);

  double best = 0.0;
  for (int copy = 0; copy < copies; ++copy) {
    auto start = std::chrono::steady_clock::now();
    parallelChunks(0, bytes, 64, [&](std::size_t, std::size_t begin, std::size_t end) {
      std::memcpy(&to[begin], &from[begin], end - begin);
    });
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    best = std::max(best, 2.0 * static_cast<double>(bytes) / seconds.count());
  }
  return known[threads] = best;
}

}  // namespace relucent::benchmarks
