// SPDX-License-Identifier: MIT
#include "relucent/clustering/patch_cut.h"

#include <algorithm>
#include <numeric>

#include "relucent/base/parallel.h"

namespace relucent::clustering {
PatchCut::PatchCut(const ConnectionGraph& graph)
    : graph_(graph), places_(graph.transport().projectors()), finders_(fixedParts, PatchFinder(places_)) {}

void PatchCut::cut(const ClusteringSettings& settings, Progress& progress) {
  std::tuple wanted(settings.leastLuminance, settings.leastShare, settings.patchRadius, settings.patchCut);
  if (cutFor_ == wanted) return;
  cutFor_.reset();

  // Which connections there are before anything is cut does not follow the sliders.
  std::tuple taking(settings.leastLuminance, settings.leastShare);
  std::size_t rows = graph_.rows(), pixels = graph_.transport().projectors().count();
  if (offeredFor_ != taking) {
    offeredFor_.reset();
    offered_.assign(pixels, {});
    parallelFor(0, rows, 1024, [&](std::size_t i) { offerRow(i, settings); });
    offeredFor_ = taking;
  }
  progress.report(0.2);

  kept_.resize(graph_.places());
  keptOfRow_.assign(rows, 0);
  brightest_.assign(pixels, {});
  sets_.reset(pixels);
  lightOfPart_.assign(fixedParts, 0.0);
  parallelChunks(0, rows, fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    progress.checkpoint();
    for (std::size_t i = begin; i < end; ++i) cutRow(i, settings, part);
  });
  light_ = std::accumulate(lightOfPart_.begin(), lightOfPart_.end(), 0.0);
  progress.report(0.8);
  reinsert(settings);

  root_.resize(pixels);
  parallelFor(0, pixels, 4096,
              [&](std::size_t pixel) { root_[pixel] = sets_.find(static_cast<std::uint32_t>(pixel)); });
  cutFor_ = wanted;
  progress.report(1.0);
}

void PatchCut::offerRow(std::size_t i, const ClusteringSettings& settings) {
  for (const Connection& connection : bright(graph_.row(i), settings))
    offered_[connection.pixel].raise(connection.luminance, static_cast<std::uint32_t>(i));
}

/// Lines 2 to 19.
void PatchCut::cutRow(std::size_t i, const ClusteringSettings& settings, std::size_t part) {
  std::span<const Connection> whole = graph_.row(i), row = bright(whole, settings);
  if (row.empty()) return;
  std::uint8_t* kept = kept_.data() + graph_.placeOf(i);
  std::fill(kept + row.size(), kept + whole.size(), std::uint8_t{0});
  std::size_t limited = row.size();
  double limit = 0.0;
  finders_[part].visit(row, settings.patchRadius, [&](std::size_t k, std::size_t, std::size_t centre) {
    if (centre != limited) {
      limited = centre;
      limit = settings.patchCut * static_cast<double>(row[centre].luminance);
    }
    kept[k] = static_cast<double>(row[k].luminance) > limit ? 1 : 0;
  });

  std::uint32_t joined = row.front().pixel;
  forEachKept(kept, row.size(), [&](std::size_t k) {
    ++keptOfRow_[i];
    lightOfPart_[part] += static_cast<double>(row[k].luminance);
    brightest_[row[k].pixel].raise(row[k].luminance, static_cast<std::uint32_t>(i));
    joined = sets_.join(joined, row[k].pixel);
  });
}

/// Line 20.
void PatchCut::reinsert(const ClusteringSettings& settings) {
  std::vector<std::size_t> reinserted(fixedParts, 0);
  lightOfPart_.assign(fixedParts, 0.0);
  parallelChunks(0, brightest_.size(), fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      if (brightest_[pixel] || !offered_[pixel]) continue;
      brightest_[pixel] = offered_[pixel];
      std::size_t i = offered_[pixel].row();
      std::span<const Connection> row = bright(graph_.row(i), settings);
      std::size_t k = 0;
      while (row[k].pixel != pixel) ++k;
      kept_[graph_.placeOf(i) + k] = 1;
      std::atomic_ref<std::uint32_t>(keptOfRow_[i]).fetch_add(1, std::memory_order_relaxed);
      lightOfPart_[part] += static_cast<double>(row[k].luminance);
      sets_.join(row.front().pixel, static_cast<std::uint32_t>(pixel));
      ++reinserted[part];
    }
  });
  light_ += std::accumulate(lightOfPart_.begin(), lightOfPart_.end(), 0.0);
  reinserted_ = std::accumulate(reinserted.begin(), reinserted.end(), std::size_t{0});
}

}  // namespace relucent::clustering
