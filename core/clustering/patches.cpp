// SPDX-License-Identifier: MIT
#include "clustering/patches.h"

#include <algorithm>
#include <atomic>

#include "base/parallel.h"

namespace relucent {
namespace {

// A fixed number of private results, so that ties do not depend on the number of threads.
constexpr std::size_t parts = 4;
constexpr int apart = 1 << 24;  // between projectors, in pixels

void mark(std::uint8_t& flag) {
  std::atomic_ref<std::uint8_t>(flag).store(1, std::memory_order_relaxed);
}

}  // namespace

PixelPlaces::PixelPlaces(const Rasters& projectors) : place_(projectors.count()) {
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    Size size = projectors.size(device);
    parallelFor(0, size.count(), 4096, [&](std::size_t local) {
      Pixel place = pixelAt(size, local);
      place.x += static_cast<int>(device) * apart;
      place_[projectors.offset(device) + local] = place;
    });
  }
}

const std::vector<std::uint32_t>& PatchFinder::patchesOf(std::span<const Connection> row) {
  label_.assign(row.size(), 0);
  unlabelled_.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) unlabelled_[i] = static_cast<std::uint32_t>(i);
  patches_ = 0;
  while (!unlabelled_.empty()) {
    // Rows are sorted: the first unlabelled connection is the brightest.
    std::uint32_t centre = row[unlabelled_.front()].pixel;
    auto patch = static_cast<std::uint32_t>(patches_++);
    std::size_t left = 0;
    for (std::uint32_t i : unlabelled_) {
      if (places_.near(centre, row[i].pixel, squaredRadius_))
        label_[i] = patch;
      else
        unlabelled_[left++] = i;
    }
    unlabelled_.resize(left);
  }
  return label_;
}

std::span<const Connection> bright(std::span<const Connection> row, const ClusteringSettings& settings) {
  if (row.empty()) return row;
  double least = std::max(static_cast<double>(settings.leastLuminance),
                          settings.leastShare * static_cast<double>(row.front().luminance));
  auto end = std::partition_point(row.begin(), row.end(), [&](const Connection& connection) {
    return static_cast<double>(connection.luminance) >= least;
  });
  return row.first(std::max<std::size_t>(1, static_cast<std::size_t>(end - row.begin())));
}

std::vector<Dominant> dominantConnections(const ConnectionGraph& graph, const ClusteringSettings& settings,
                                          const std::vector<std::uint8_t>& wantedPixels,
                                          const std::vector<std::uint8_t>* amongPlaces) {
  std::vector<std::vector<Dominant>> partial(parts);
  parallelChunks(0, graph.rows(), parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<Dominant>& best = partial[part];
    best.resize(wantedPixels.size());
    for (std::size_t row = begin; row < end; ++row) {
      std::size_t place = graph.placeOf(row);
      for (const Connection& connection : bright(graph.row(row), settings)) {
        std::size_t here = place++;
        if (!wantedPixels[connection.pixel] || (amongPlaces && !(*amongPlaces)[here])) continue;
        Dominant& dominant = best[connection.pixel];
        if (connection.luminance > dominant.luminance)
          dominant = {connection.luminance, static_cast<std::uint32_t>(row), here};
      }
    }
  });
  std::vector<Dominant> result = std::move(partial.front());
  for (std::size_t part = 1; part < parts; ++part)
    for (std::size_t pixel = 0; pixel < result.size(); ++pixel)
      if (partial[part][pixel].luminance > result[pixel].luminance) result[pixel] = partial[part][pixel];
  return result;
}

KeptConnections cutPatches(const ConnectionGraph& graph, const PixelPlaces& places,
                           const ClusteringSettings& settings, Progress& progress) {
  std::size_t pixels = graph.transport().projectors().count();
  KeptConnections result{std::vector<std::uint8_t>(graph.places(), 0), std::vector<std::uint8_t>(pixels, 0),
                         0};
  std::vector<std::uint8_t> reached(pixels, 0);

  constexpr std::size_t chunks = 64;
  parallelChunks(0, graph.rows(), chunks, [&](std::size_t, std::size_t begin, std::size_t end) {
    PatchFinder finder(places, settings.patchRadius);
    std::vector<double> limit;
    for (std::size_t i = begin; i < end; ++i) {
      std::span<const Connection> row = bright(graph.row(i), settings);
      const std::vector<std::uint32_t>& patch = finder.patchesOf(row);
      limit.assign(finder.patches(), -1.0);
      for (std::size_t k = 0; k < row.size(); ++k) {
        auto luminance = static_cast<double>(row[k].luminance);
        double& highest = limit[patch[k]];
        if (highest < 0.0) highest = settings.patchCut * luminance;  // the first is the patch's centre
        mark(result.lit[row[k].pixel]);
        if (luminance <= highest) continue;
        result.kept[graph.placeOf(i) + k] = 1;
        mark(reached[row[k].pixel]);
      }
    }
  });
  progress.report(0.6);

  std::vector<std::uint8_t> cutOff(pixels);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) cutOff[pixel] = result.lit[pixel] && !reached[pixel];
  for (const Dominant& dominant : dominantConnections(graph, settings, cutOff, nullptr)) {
    if (!(dominant.luminance > 0.0f)) continue;
    result.kept[dominant.place] = 1;
    ++result.reinserted;
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent
