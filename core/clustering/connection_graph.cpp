// SPDX-License-Identifier: MIT
#include "relucent/clustering/connection_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/image/colour.h"

namespace relucent::clustering {
namespace {

/// Wide leaves of a venue full of scattered light could be expanded to billions of connections; beyond this
/// many (720 MB) the coarsest level goes first.
constexpr std::size_t mostConnections = 60'000'000;
/// What of T becomes connections.
class NearLeaves {
 public:
  NearLeaves(const transport::TransportMatrix& transport, const transport::NodeTable& nodes)
      : transport_(transport), nodes_(nodes), level_(nodes.pixels.size()) {
    parallelFor(0, level_.size(), 1024, [&](std::size_t node) {
      level_[node] = static_cast<std::uint8_t>(transport.layout().node(node).level);
    });
  }

  /// Looks at a row: the luminance of its leaves per projector pixel, and T_i 1.
  struct Row {
    std::vector<float> density;
    std::vector<std::uint32_t> column;
    float brightest = 0.0f;
    std::array<float, 3> flood{};
  };
  void look(std::size_t row, Row& into) const {
    const transport::LeafRow leaves = transport_.row(row);
    into.density.resize(leaves.size());
    into.column.assign(leaves.columns().begin(), leaves.columns().end());
    into.brightest = 0.0f;
    Eigen::Vector3d flood = Eigen::Vector3d::Zero();
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
      const Eigen::Vector3f white = leaves.block(entry).rowwise().sum();
      flood += white.cast<double>();
      float density = image::luminanceOf(white[0], white[1], white[2]) / nodes_.pixels[leaves.column(entry)];
      into.density[entry] = density;
      into.brightest = std::max(into.brightest, density);
    }
    if (!std::isfinite(into.brightest)) into.brightest = 0.0f;
    for (std::size_t c = 0; c < 3; ++c)
      into.flood[c] = static_cast<float>(flood[static_cast<Eigen::Index>(c)]);
  }

  /// Calls visit(entry, luminance per pixel) for what is bright enough. Nothing is in a black row.
  template <typename Visit>
  void visit(const Row& seen, double share, int coarsest, const Visit& visit) const {
    float least = static_cast<float>(share) * seen.brightest;
    for (std::size_t i = 0; i < seen.density.size() && seen.brightest > 0.0f; ++i) {
      float density = seen.density[i];
      if (!(density > 0.0f && density >= least)) continue;
      if (level_[seen.column[i]] <= coarsest) visit(i, density);
    }
  }

  std::size_t pixels(std::uint32_t node) const { return static_cast<std::size_t>(nodes_.pixels[node]); }

  /// Adds a connection for every pixel of a leaf.
  void expand(const Row& seen, std::size_t entry, float bright, std::vector<Connection>& row) const {
    std::uint32_t index = seen.column[entry];
    auto leaf = static_cast<std::uint32_t>(entry);
    if (level_[index] == 0) {
      row.push_back({index, leaf, bright});
      return;
    }
    const transport::NodeLayout& layout = transport_.layout();
    transport::Node node = layout.node(index);
    transport::Block block = layout.block(node);
    auto device = static_cast<std::size_t>(node.projector);
    const Rasters& projectors = layout.projectors();
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x)
        row.push_back(
            {static_cast<std::uint32_t>(projectors.offset(device) + indexOf(projectors.size(device), {x, y})),
             leaf, bright});
  }

 private:
  const transport::TransportMatrix& transport_;
  const transport::NodeTable& nodes_;
  std::vector<std::uint8_t> level_;
};

/// Where each row's connections begin if leaves up to a level carry them. On the way: T 1.
std::vector<std::size_t> countedStarts(const NearLeaves& near, const CameraMask& usable, double share,
                                       int coarsest, CameraStack& flood) {
  std::vector<std::size_t> start(usable.size() + 1, 0);
  parallelChunks(0, usable.size(), fixedParts, [&](std::size_t, std::size_t begin, std::size_t end) {
    NearLeaves::Row seen;
    for (std::size_t row = begin; row < end; ++row) {
      near.look(row, seen);
      std::copy(seen.flood.begin(), seen.flood.end(), &flood[3 * row]);
      if (!usable[row]) continue;
      near.visit(seen, share, coarsest,
                 [&](std::size_t entry, float) { start[row + 1] += near.pixels(seen.column[entry]); });
    }
  });
  for (std::size_t row = 0; row < usable.size(); ++row) start[row + 1] += start[row];
  return start;
}

/// Of several connections to a pixel the brightest, of equals the one of the finest leaf.
void keepBrightestOfEachPixel(std::vector<Connection>& row) {
  std::sort(row.begin(), row.end(), [](const Connection& a, const Connection& b) {
    if (a.pixel != b.pixel) return a.pixel < b.pixel;
    return a.luminance != b.luminance ? a.luminance > b.luminance : a.leaf < b.leaf;
  });
  row.erase(std::unique(row.begin(), row.end(),
                        [](const Connection& a, const Connection& b) { return a.pixel == b.pixel; }),
            row.end());
}

}  // namespace

std::vector<Message> problems(const ConnectionGraphSettings& settings) {
  std::vector<Message> found;
  if (!(settings.leastShare >= 0.0 && settings.leastShare <= 1.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("clusters.row-share-out-of-range",
                                 "the share of a row's brightest connection must lie between 0 and 1"));
  if (settings.coarsestLevel < 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("clusters.coarsest-level-negative",
                                             "the coarsest level must not be negative"));
  return found;
}

ConnectionGraph::ConnectionGraph(const transport::TransportMatrix& transport, const CameraMask& usable,
                                 const ConnectionGraphSettings& settings, Progress& progress)
    : transport_(&transport), nodes_(transport.layout()) {
  if (auto found = problems(settings); !found.empty())
    throw Error(ErrorKind::usage, found.front(),
                RELUCENT_ENGLISH_MESSAGE("clusters.correct-setting", "correct the setting"), "clustering");
  const std::size_t rows = transport.cameras().count();
  require(usable.size() == rows, "{} usable flags for {} camera pixels", usable.size(), rows);
  squaredNorm_ = transport::squaredRowNorms(transport, nodes_, &nested_);
  progress.report(0.3);

  // First to count: the connections are the largest array here and are made to measure.
  NearLeaves near(transport, nodes_);
  flood_.assign(3 * rows, 0.0f);
  length_.assign(rows, 0);
  coarsestLevel_ = settings.coarsestLevel;
  start_ = countedStarts(near, usable, settings.leastShare, coarsestLevel_, flood_);
  while (start_.back() > mostConnections && coarsestLevel_ > 0)
    start_ = countedStarts(near, usable, settings.leastShare, --coarsestLevel_, flood_);
  require(start_.back() < std::numeric_limits<std::uint32_t>::max(), "{} connections", start_.back());
  progress.report(0.6);

  edges_.resize(start_.back() + 1);  // one more, so that an empty last row has an address
  struct Light {
    double carried = 0.0, all = 0.0;
    std::size_t connections = 0;
  };
  std::vector<Light> light(fixedParts);
  parallelChunks(0, rows, fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<Connection> edges;
    NearLeaves::Row seen;
    for (std::size_t row = begin; row < end; ++row) {
      if (!usable[row]) continue;
      edges.clear();
      near.look(row, seen);
      near.visit(seen, settings.leastShare, coarsestLevel_,
                 [&](std::size_t entry, float bright) { near.expand(seen, entry, bright, edges); });
      if (nested_[row]) keepBrightestOfEachPixel(edges);
      std::sort(edges.begin(), edges.end(), [](const Connection& a, const Connection& b) {
        return a.luminance != b.luminance ? a.luminance > b.luminance : a.pixel < b.pixel;
      });
      std::copy(edges.begin(), edges.end(), edges_.begin() + static_cast<std::ptrdiff_t>(start_[row]));
      length_[row] = static_cast<std::uint32_t>(edges.size());
      light[part].connections += edges.size();
      for (const Connection& edge : edges) light[part].carried += static_cast<double>(edge.luminance);
      double whole = static_cast<double>(image::luminanceOf(seen.flood[0], seen.flood[1], seen.flood[2]));
      if (std::isfinite(whole)) light[part].all += whole;
    }
  });
  double carried = 0.0, all = 0.0;
  for (const Light& part : light) {
    carried += part.carried;
    all += part.all;
    connections_ += part.connections;
  }
  carriedLuminance_ = carried;
  if (all > 0.0) carriedLight_ = carried / all;
  progress.report(1.0);
}

std::size_t ConnectionGraph::bytes() const {
  return edges_.size() * sizeof(Connection) + start_.size() * sizeof(std::size_t) +
         length_.size() * sizeof(std::uint32_t) + flood_.size() * sizeof(float) +
         squaredNorm_.size() * sizeof(double) + nested_.size() +
         nodes_.pixels.size() * (sizeof(float) + sizeof(std::uint32_t));
}

}  // namespace relucent::clustering
