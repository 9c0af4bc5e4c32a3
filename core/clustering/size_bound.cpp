// SPDX-License-Identifier: MIT
#include "clustering/size_bound.h"

#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/parallel_sort.h"

namespace relucent {
namespace {

constexpr std::size_t chunks = 64;
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Connections are ranked in levels of these least strengths. Where they lie makes no difference to the
/// result; after the first one or two, most clusters are full.
constexpr std::array<float, 3> levels{0.5f, 0.2f, 0.0f};

}  // namespace

void SizeBound::join(const CutGraph& cut, std::uint32_t most, Progress& progress) {
  most_ = most;
  joinBrightest(cut);
  progress.report(0.2);
  findStrongest(cut);
  float below = std::numeric_limits<float>::infinity();
  for (float least : levels) {
    rank(cut, least, below);
    progress.checkpoint();
    joinRanked();
    below = least;
    progress.checkpoint();
  }
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

/// A camera pixel that is no projector pixel's brightest goes along with the strongest connection that it
/// has: it adds nothing to a cluster's size, so the first connection that is looked at always takes it in.
void SizeBound::findStrongest(const CutGraph& cut) {
  parallelFor(0, cut.graph.rows(), 1024, [&](std::size_t i) {
    std::span<const Connection> row = cut.graph.row(i);
    if (seen_[i] != none || row.empty()) return;
    const std::uint8_t* kept = cut.kept.data() + cut.graph.placeOf(i);
    float rowRoot = std::sqrt(row.front().luminance), highest = -1.0f;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!kept[k]) continue;
      float here = strength(rowRoot, row[k]);
      if (here < highest || (here == highest && row[k].pixel > seen_[i])) continue;
      highest = here;
      seen_[i] = row[k].pixel;
    }
  });
}

/// The connections of a level that can still join something, the strongest first.
void SizeBound::rank(const CutGraph& cut, float least, float below) {
  parts_.resize(chunks);
  parallelChunks(0, cut.graph.rows(), chunks, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<Ranked>& found = parts_[part];
    found.clear();
    for (std::size_t i = begin; i < end; ++i) {
      if (seen_[i] == none) continue;
      std::uint32_t own = root_[seen_[i]], room = most_ - size_[own];
      if (room == 0) continue;
      std::span<const Connection> row = cut.graph.row(i);
      const std::uint8_t* kept = cut.kept.data() + cut.graph.placeOf(i);
      float rowRoot = std::sqrt(row.front().luminance);
      // No connection is stronger than the square root of its share of the row's brightest. The margin is
      // for rounding.
      double dimmest = 0.999 * static_cast<double>(least) * static_cast<double>(least) *
                       static_cast<double>(row.front().luminance);
      for (std::size_t k = 0; k < row.size() && static_cast<double>(row[k].luminance) >= dimmest; ++k) {
        if (!kept[k]) continue;
        std::uint32_t other = root_[row[k].pixel];
        if (other == own || size_[other] > room) continue;
        float here = strength(rowRoot, row[k]);
        if (here >= least && here < below)
          found.push_back({here, static_cast<std::uint32_t>(i), row[k].pixel});
      }
    }
  });
  ranked_.clear();
  for (const std::vector<Ranked>& part : parts_) ranked_.insert(ranked_.end(), part.begin(), part.end());
  parallelSort(ranked_, [](const Ranked& a, const Ranked& b) {
    if (a.strength != b.strength) return a.strength > b.strength;
    return a.row != b.row ? a.row < b.row : a.pixel < b.pixel;
  });
}

void SizeBound::joinRanked() {
  for (const Ranked& connection : ranked_) {
    std::uint32_t a = sets_.find(seen_[connection.row]), b = sets_.find(connection.pixel);
    if (a == b || size_[a] + size_[b] > most_) continue;
    std::uint32_t together = size_[a] + size_[b];
    size_[sets_.join(a, b)] = together;
  }
  parallelFor(0, root_.size(), 4096,
              [&](std::size_t pixel) { root_[pixel] = sets_.find(static_cast<std::uint32_t>(pixel)); });
}

}  // namespace relucent
