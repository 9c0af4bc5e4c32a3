// SPDX-License-Identifier: MIT
#include "relucent/clustering/size_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/parallel.h"
#include "relucent/base/parallel_sort.h"

namespace relucent::clustering {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void SizeBound::join(const CutGraph& cut, std::uint32_t most, Progress& progress) {
  most_ = most;
  joinBrightest(cut);
  progress.report(0.1);
  collect(cut);
  progress.report(0.5);
  for (std::size_t level = 0; level < levels; ++level) {
    rank(level);
    joinRanked();
    progress.checkpoint();
  }
  parallelFor(0, root_.size(), 4096,
              [&](std::size_t pixel) { root_[pixel] = sets_.find(static_cast<std::uint32_t>(pixel)); });
  progress.report(1.0);
}

/// Every projector pixel first to the camera pixel that it lights most: none is left over later because the
/// clusters round it are full.
void SizeBound::joinBrightest(const CutGraph& cut) {
  std::size_t pixels = cut.brightest.size();
  sets_.reset(pixels);
  size_.assign(pixels, 1);
  seen_.assign(cut.graph.rows(), none);
  root_.resize(pixels);
  rootBrightest_.resize(pixels);
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const Brightest& brightest = cut.brightest[pixel];
    root_[pixel] = pixel;
    if (!brightest) continue;
    rootBrightest_[pixel] = std::sqrt(brightest.luminance());
    std::uint32_t& lowest = seen_[brightest.row()];
    if (lowest == none) {
      lowest = pixel;
    } else if (size_[lowest] < most_) {
      root_[pixel] = sets_.join(lowest, pixel);
      ++size_[lowest];
    }
  }
}

/// The connections that can still join something, by level.
void SizeBound::collect(const CutGraph& cut) {
  parallelChunks(0, cut.graph.rows(), parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    auto& found = collected_[part];
    for (std::vector<Ranked>& level : found) level.clear();
    for (std::size_t i = begin; i < end; ++i) {
      std::span<const Connection> row = cut.graph.row(i);
      if (row.empty()) continue;
      const std::uint8_t* kept = cut.kept.data() + cut.graph.placeOf(i);
      float rootHighest = std::sqrt(row.front().luminance);
      auto strengthOf = [&](const Connection& connection) {
        return connection.luminance / (rootHighest * rootBrightest_[connection.pixel]);
      };
      if (seen_[i] == none) {
        // It is no projector pixel's brightest and adds nothing to a cluster's size: the strongest connection
        // that it has takes it in, whatever joined before.
        float highest = -1.0f;
        forEachKept(kept, row.size(), [&](std::size_t k) {
          float strength = strengthOf(row[k]);
          if (strength < highest || (strength == highest && row[k].pixel > seen_[i])) return;
          highest = strength;
          seen_[i] = row[k].pixel;
        });
      }
      std::uint32_t own = root_[seen_[i]];
      forEachKept(kept, row.size(), [&](std::size_t k) {
        if (!canJoin(own, root_[row[k].pixel])) return;
        float strength = strengthOf(row[k]);
        // No connection is stronger than one, but for rounding.
        auto level = static_cast<std::size_t>(static_cast<float>(levels) * std::max(0.0f, 1.0f - strength));
        found[std::min(level, levels - 1)].push_back({strength, static_cast<std::uint32_t>(i), row[k].pixel});
      });
    }
  });
}

/// Those of a level that can join something now, the strongest first.
void SizeBound::rank(std::size_t level) {
  parallelFor(0, parts, 1, [&](std::size_t part) {
    std::erase_if(collected_[part][level], [&](const Ranked& connection) {
      return !canJoin(sets_.find(seen_[connection.row]), sets_.find(connection.pixel));
    });
  });
  ranked_.clear();
  for (const auto& part : collected_) ranked_.insert(ranked_.end(), part[level].begin(), part[level].end());
  parallelSort(ranked_, [](const Ranked& a, const Ranked& b) {
    if (a.strength != b.strength) return a.strength > b.strength;
    return a.row != b.row ? a.row < b.row : a.pixel < b.pixel;
  });
}

void SizeBound::joinRanked() {
  for (const Ranked& connection : ranked_) {
    std::uint32_t a = sets_.find(seen_[connection.row]), b = sets_.find(connection.pixel);
    if (!canJoin(a, b)) continue;
    std::uint32_t together = size_[a] + size_[b];
    size_[sets_.join(a, b)] = together;
  }
}

}  // namespace relucent::clustering
