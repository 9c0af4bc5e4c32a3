// SPDX-License-Identifier: MIT
#include "relucent/transport/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/shared_fate.h"

namespace relucent::transport {
namespace {

std::size_t binOf(float strength) {
  double place = (std::log10(static_cast<double>(strength)) - StrengthHistogram::lowestDecade) *
                 StrengthHistogram::binsPerDecade;
  return static_cast<std::size_t>(
      std::clamp(std::floor(place), 0.0, static_cast<double>(StrengthHistogram::bins - 1)));
}

/// Adds what light of two leaves falls on the same pixels, for the leaf at `entry` and its ancestors.
/// `holds` marks the row's wide leaves.
double sharedWithAncestors(const LeafRow& leaves, const NodeTable& nodes, std::size_t entry,
                           const std::vector<std::uint8_t>& holds) {
  double sum = 0.0;
  std::uint32_t node = leaves.column(entry);
  for (std::uint32_t above = nodes.parent[node]; above != node; node = above, above = nodes.parent[node]) {
    if (!holds[above]) continue;
    std::size_t begin = entry + 1, end = leaves.size();
    while (begin < end) {
      std::size_t middle = begin + (end - begin) / 2;
      if (leaves.column(middle) < above)
        begin = middle + 1;
      else
        end = middle;
    }
    Eigen::Matrix3d inner = leaves.block(entry).cast<double>();
    Eigen::Matrix3d outer = leaves.block(begin).cast<double>();
    sum += 2.0 * inner.cwiseProduct(outer).sum() / static_cast<double>(nodes.pixels[above]);
  }
  return sum;
}

}  // namespace

NodeTable::NodeTable(const NodeLayout& layout) : pixels(layout.count()), parent(layout.count()) {
  parallelFor(0, layout.count(), 1024, [&](std::size_t index) {
    Node node = layout.node(index);
    pixels[index] = static_cast<float>(layout.block(node).count());
    bool top = node.level + 1 == layout.levels(static_cast<std::size_t>(node.projector));
    parent[index] = static_cast<std::uint32_t>(top ? index : layout.index(layout.parent(node)));
  });
}

namespace {

/// Of what filtered() makes. `leaves`: that camera pixels keep; `stays`: those that they share, see
/// SharedFate.
std::uint64_t bytesAfterCut(const TransportMatrix& transport, std::uint64_t leaves,
                            const std::vector<std::uint8_t>& stays) {
  const BlockSparse& own = transport.ownLeaves();
  const LeafGroups& groups = transport.groups();
  const std::uint64_t ofTheirOwn = leaves - groups.seen(stays);
  const std::uint64_t bytes = own.bytes() + (ofTheirOwn - own.blocks()) * own.bytesOfBlock();
  const auto shared = static_cast<std::uint64_t>(std::ranges::count(stays, 1));
  if (shared == 0) return bytes;
  return bytes + groups.bytes() - (stays.size() - shared) * groups.leaves().bytesOfBlock();
}

}  // namespace

TransportStatistics statisticsOf(const TransportMatrix& transport, const ThresholdSettings& settings) {
  std::vector<float> limit = thresholdLimits(transport, settings);
  NodeTable nodes(transport.layout());

  struct Part {
    TransportStatistics kept;
    double all = 0.0;
  };
  std::vector<Part> sums(fixedParts);
  const bool isCut = !cutsNothing(settings);
  SharedFate fate(transport.groups());
  parallelChunks(0, limit.size(), fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    Part& sum = sums[part];
    std::vector<std::uint8_t> keep;
    for (std::size_t row = begin; row < end; ++row) {
      const LeafRow leaves = transport.row(row);
      keep.assign(leaves.size(), 0);
      for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
        BlockSize size = leaves.sizeOf(entry);
        float pixels = nodes.pixels[leaves.column(entry)];
        float strength = size.largest / pixels;
        auto energy = static_cast<double>(size.sum);
        sum.all += energy;
        if (strength < limit[row]) continue;
        keep[entry] = 1;
        ++sum.kept.leaves;
        sum.kept.connections += static_cast<std::uint64_t>(pixels);
        sum.kept.energy += energy;
        if (!(strength > 0.0f)) continue;
        std::size_t bin = binOf(strength);
        ++sum.kept.histogram.leaves[bin];
        sum.kept.histogram.connections[bin] += static_cast<std::uint64_t>(pixels);
        sum.kept.histogram.energy[bin] += energy;
      }
      if (isCut) fate.look(leaves, keep, transport.projectors().devices());
    }
  });

  TransportStatistics result;
  double all = 0.0;
  for (const Part& part : sums) {
    result.leaves += part.kept.leaves;
    result.connections += part.kept.connections;
    result.energy += part.kept.energy;
    all += part.all;
    for (std::size_t bin = 0; bin < StrengthHistogram::bins; ++bin) {
      result.histogram.leaves[bin] += part.kept.histogram.leaves[bin];
      result.histogram.connections[bin] += part.kept.histogram.connections[bin];
      result.histogram.energy[bin] += part.kept.histogram.energy[bin];
    }
  }
  if (all > 0.0) result.energyKept = result.energy / all;
  result.bytes = isCut ? bytesAfterCut(transport, result.leaves, fate.staying()) : transport.bytes();
  return result;
}

std::vector<double> squaredRowNorms(const TransportMatrix& transport, const NodeTable& nodes,
                                    std::vector<std::uint8_t>* nested) {
  std::size_t pixels = transport.projectors().count();
  std::vector<double> norms(transport.cameras().count());
  if (nested) nested->assign(norms.size(), 0);
  parallelChunks(0, norms.size(), fixedParts, [&](std::size_t, std::size_t firstRow, std::size_t lastRow) {
    std::vector<std::uint8_t> holds(nodes.pixels.size(), 0);
    for (std::size_t row = firstRow; row < lastRow; ++row) {
      const LeafRow leaves = transport.row(row);
      for (std::size_t end = leaves.size(); end > 0 && leaves.column(end - 1) >= pixels; --end)
        holds[leaves.column(end - 1)] = 1;
      double own = 0.0, shared = 0.0;
      bool inside = false;
      std::uint32_t lastParent = std::numeric_limits<std::uint32_t>::max();
      for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
        std::uint32_t node = leaves.column(entry);
        own += leaves.block(entry).cast<double>().squaredNorm() / static_cast<double>(nodes.pixels[node]);
        // Neighbours often share their parent, and with it everything above.
        if (std::uint32_t parent = nodes.parent[node]; parent != lastParent || parent == node) {
          lastParent = parent;
          inside = false;
          for (std::uint32_t above = parent; above != node && !inside;
               node = above, above = nodes.parent[node])
            inside = holds[above] != 0;
        }
        if (!inside) continue;
        if (nested) (*nested)[row] = 1;
        shared += sharedWithAncestors(leaves, nodes, entry, holds);
      }
      for (std::size_t end = leaves.size(); end > 0 && leaves.column(end - 1) >= pixels; --end)
        holds[leaves.column(end - 1)] = 0;
      norms[row] = own + shared;
    }
  });
  return norms;
}

double strengthOfBin(std::size_t bin) {
  return std::pow(
      10.0, StrengthHistogram::lowestDecade + static_cast<double>(bin) / StrengthHistogram::binsPerDecade);
}

double cutKeeping(const StrengthHistogram& histogram, double share) {
  double all = std::accumulate(histogram.energy.begin(), histogram.energy.end(), 0.0);
  double below = 0.0, cut = 0.0;
  for (std::size_t bin = 0; bin < StrengthHistogram::bins; ++bin) {
    if (!(all > 0.0) || below > (1.0 - share) * all) break;
    cut = below > 0.0 ? strengthOfBin(bin) : 0.0;
    below += histogram.energy[bin];
  }
  return cut;
}

int finestSide(const TransportMatrix& transport) {
  const NodeLayout& layout = transport.layout();
  int finest = layout.levels() - 1;
  // What is shared is far; but all of it may be.
  for (const BlockSparse* leaves : {&transport.ownLeaves(), &transport.groups().leaves()})
    for (std::size_t entry = 0; entry < leaves->blocks() && finest > 0; ++entry)
      finest = std::min(finest, layout.node(leaves->column(entry)).level);
  return 1 << finest;
}

}  // namespace relucent::transport
