// SPDX-License-Identifier: MIT
#include "clustering/components.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace relucent {
namespace {

/// Union-find with path halving. The lower element is the root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t find(std::uint32_t element) {
    while (parent_[element] != element) element = parent_[element] = parent_[parent_[element]];
    return element;
  }
  /// Joins two roots and returns the common one.
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    return a;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Calls visit(camera pixel, place, connection) for all that are kept, row by row.
template <typename Visit>
void visitKept(const ConnectionGraph& graph, const KeptConnections& connections, const Visit& visit) {
  for (std::size_t i = 0; i < graph.rows(); ++i) {
    std::span<const Connection> row = graph.row(i);
    const std::uint8_t* kept = connections.kept.data() + graph.placeOf(i);
    for (std::size_t k = 0; k < row.size(); ++k)
      if (kept[k]) visit(i, graph.placeOf(i) + k, row[k]);
  }
}

/// Elements are the projector pixels, then the camera pixels.
Partition numbered(const ConnectionGraph& graph, const KeptConnections& connections, DisjointSets& sets) {
  std::size_t pixels = graph.transport().projectors().count();
  Partition partition{
      std::vector<std::uint32_t>(graph.rows(), noCluster), std::vector<std::uint32_t>(pixels, noCluster), {}};
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    if (!connections.lit[pixel]) continue;
    // The root is the lowest of its set, so it has been numbered before all others.
    std::uint32_t root = sets.find(static_cast<std::uint32_t>(pixel));
    if (root == pixel) {
      partition.projector[pixel] = static_cast<std::uint32_t>(partition.sizes.size());
      partition.sizes.emplace_back();
    } else {
      partition.projector[pixel] = partition.projector[root];
    }
    ++partition.sizes[partition.projector[pixel]].unknowns;
  }
  for (std::size_t row = 0; row < graph.rows(); ++row) {
    std::uint32_t root = sets.find(static_cast<std::uint32_t>(pixels + row));
    if (root >= pixels) continue;
    partition.camera[row] = partition.projector[root];
    ++partition.sizes[partition.camera[row]].rows;
  }
  return partition;
}

/// Joins sets while they stay small.
class CappedSets {
 public:
  CappedSets(std::size_t pixels, std::size_t rows, std::uint32_t most)
      : sets_(pixels + rows), unknowns_(pixels + rows, 0), most_(most) {
    std::fill_n(unknowns_.begin(), pixels, 1u);
  }
  void joinIfSmall(std::uint32_t a, std::uint32_t b) {
    a = sets_.find(a);
    b = sets_.find(b);
    if (a == b || unknowns_[a] + unknowns_[b] > most_) return;
    std::uint32_t together = unknowns_[a] + unknowns_[b];
    unknowns_[sets_.join(a, b)] = together;
  }
  DisjointSets& sets() { return sets_; }

 private:
  DisjointSets sets_;
  std::vector<std::uint32_t> unknowns_;
  std::uint32_t most_;
};

struct Ranked {
  float strength;
  std::uint32_t row, pixel;
};

bool stronger(const Ranked& a, const Ranked& b) {
  if (a.strength != b.strength) return a.strength > b.strength;
  return a.row != b.row ? a.row < b.row : a.pixel < b.pixel;
}

/// Kept connections, the strongest first: counted into buckets by the leading bits of the strength, then
/// sorted bucket by bucket on all cores.
std::vector<Ranked> ranked(const ConnectionGraph& graph, const KeptConnections& connections,
                           const std::vector<Dominant>& dominant) {
  constexpr std::size_t buckets = 1 << 15;
  auto strengthOf = [&](std::size_t row, const Connection& connection) {
    float highest = graph.row(row).front().luminance;
    return connection.luminance / (std::sqrt(highest) * std::sqrt(dominant[connection.pixel].luminance));
  };
  auto bucketOf = [](float strength) {
    return buckets - 1 - ((std::bit_cast<std::uint32_t>(strength) >> 16) & (buckets - 1));
  };
  std::vector<std::size_t> start(buckets + 1, 0);
  visitKept(graph, connections, [&](std::size_t row, std::size_t, const Connection& connection) {
    ++start[bucketOf(strengthOf(row, connection)) + 1];
  });
  std::partial_sum(start.begin(), start.end(), start.begin());

  std::vector<Ranked> result(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  visitKept(graph, connections, [&](std::size_t row, std::size_t, const Connection& connection) {
    float strength = strengthOf(row, connection);
    result[next[bucketOf(strength)]++] = {strength, static_cast<std::uint32_t>(row), connection.pixel};
  });
  parallelFor(0, buckets, 1, [&](std::size_t bucket) {
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(start[bucket]),
              result.begin() + static_cast<std::ptrdiff_t>(start[bucket + 1]), stronger);
  });
  return result;
}

}  // namespace

Partition connectedComponents(const ConnectionGraph& graph, const KeptConnections& connections) {
  std::size_t pixels = graph.transport().projectors().count();
  DisjointSets sets(pixels + graph.rows());
  visitKept(graph, connections, [&](std::size_t row, std::size_t, const Connection& connection) {
    std::uint32_t a = sets.find(static_cast<std::uint32_t>(pixels + row)), b = sets.find(connection.pixel);
    if (a != b) sets.join(a, b);
  });
  return numbered(graph, connections, sets);
}

Partition cappedComponents(const ConnectionGraph& graph, const ClusteringSettings& settings,
                           KeptConnections& connections, Progress& progress) {
  std::size_t pixels = graph.transport().projectors().count();
  std::vector<Dominant> dominant = dominantConnections(graph, settings, connections.lit, &connections.kept);
  CappedSets capped(pixels, graph.rows(), static_cast<std::uint32_t>(settings.mostUnknowns));
  auto element = [&](std::size_t row) { return static_cast<std::uint32_t>(pixels + row); };

  // Every projector pixel first to the camera pixel that it lights most: none is left over later because
  // the clusters round it are full.
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    if (dominant[pixel].luminance > 0.0f)
      capped.joinIfSmall(static_cast<std::uint32_t>(pixel), element(dominant[pixel].row));
  progress.report(0.2);
  std::vector<Ranked> order = ranked(graph, connections, dominant);
  progress.report(0.6);
  for (const Ranked& connection : order) capped.joinIfSmall(connection.pixel, element(connection.row));
  progress.report(0.8);

  Partition partition = numbered(graph, connections, capped.sets());
  parallelFor(0, graph.rows(), 256, [&](std::size_t i) {
    std::span<const Connection> row = graph.row(i);
    std::uint8_t* kept = connections.kept.data() + graph.placeOf(i);
    for (std::size_t k = 0; k < row.size(); ++k)
      if (partition.projector[row[k].pixel] != partition.camera[i]) kept[k] = 0;
  });
  progress.report(1.0);
  return partition;
}

}  // namespace relucent
