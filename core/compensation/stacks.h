// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <numeric>

#include "relucent/base/parallel.h"
#include "relucent/base/raster.h"

/// Arithmetic on whole stacks, on all cores, the same bits for every number of threads.
namespace relucent::compensation {

inline float clamp01(float value) {
  return std::clamp(value, 0.0f, 1.0f);
}

/// value(i) for every i below `count`.
template <typename Values, typename Value>
Values stackOf(std::size_t count, const Value& value) {
  Values stack(count);
  parallelFor(0, count, 4096, [&](std::size_t i) { stack[i] = value(i); });
  return stack;
}

/// The values of one device's pixels, the others' being 0. One value a pixel.
template <typename Values>
Values onlyOf(std::size_t device, const Values& all, const Rasters& rasters) {
  Values only(all.size(), 0);
  const auto first = static_cast<std::ptrdiff_t>(rasters.offset(device));
  std::copy_n(all.begin() + first, rasters.size(device).count(), only.begin() + first);
  return only;
}

/// The sum of term(i) over every i below `count`.
template <typename Term>
double sumOf(std::size_t count, const Term& term) {
  constexpr std::size_t chunks = 64;
  std::array<double, chunks> partial{};
  parallelChunks(0, count, chunks, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += term(i);
    partial[chunk] = sum;
  });
  return std::accumulate(partial.begin(), partial.end(), 0.0);
}

}  // namespace relucent::compensation
