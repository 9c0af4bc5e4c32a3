// SPDX-License-Identifier: MIT
#include "clustering/connection_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

/// Wide leaves of a venue full of scattered light could be expanded to billions of connections; beyond this
/// many (720 MB) the coarsest level goes first.
constexpr std::size_t mostConnections = 60'000'000;
constexpr std::size_t parts = 64;
constexpr std::size_t mostLevels = 32;

/// What the camera sees of a leaf's whole block in white.
float leafLuminance(const BlockSparse& leaves, std::size_t row, std::size_t entry) {
  const auto& code = leaves.code(entry);
  auto channel = [&](std::size_t c) {
    return static_cast<float>(code[3 * c] + code[3 * c + 1] + code[3 * c + 2]);
  };
  return leaves.scale(row) * luminanceOf(channel(0), channel(1), channel(2));
}

/// What of T becomes connections.
class NearLeaves {
 public:
  NearLeaves(const TransportMatrix& transport, const NodeTable& nodes)
      : transport_(transport), leaves_(transport.leaves()), nodes_(nodes), level_(nodes.pixels.size()) {
    parallelFor(0, level_.size(), 1024, [&](std::size_t node) {
      level_[node] = static_cast<std::uint8_t>(transport.layout().node(node).level);
    });
  }

  float brightest(std::size_t row) const {
    float brightest = 0.0f;
    for (std::size_t entry = leaves_.rowBegin(row); entry < leaves_.rowBegin(row + 1); ++entry)
      brightest = std::max(brightest, density(row, entry));
    return std::isfinite(brightest) ? brightest : 0.0f;
  }

  /// Calls visit(entry, level, luminance per pixel).
  template <typename Visit>
  void visit(std::size_t row, float least, int coarsest, const Visit& visit) const {
    for (std::size_t entry = leaves_.rowBegin(row); entry < leaves_.rowBegin(row + 1); ++entry) {
      float bright = density(row, entry);
      int level = level_[leaves_.column(entry)];
      if (bright > 0.0f && bright >= least && level <= coarsest) visit(entry, level, bright);
    }
  }

  /// Adds a connection for every pixel of a leaf.
  void expand(std::size_t entry, float bright, std::vector<Connection>& row) const {
    std::uint32_t index = leaves_.column(entry);
    auto leaf = static_cast<std::uint32_t>(entry);
    if (level_[index] == 0) {
      row.push_back({index, leaf, bright});
      return;
    }
    const NodeLayout& layout = transport_.layout();
    Node node = layout.node(index);
    Block block = layout.block(node);
    auto device = static_cast<std::size_t>(node.projector);
    const Rasters& projectors = layout.projectors();
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x)
        row.push_back(
            {static_cast<std::uint32_t>(projectors.offset(device) + indexOf(projectors.size(device), {x, y})),
             leaf, bright});
  }

 private:
  float density(std::size_t row, std::size_t entry) const {
    return leafLuminance(leaves_, row, entry) / nodes_.pixels[leaves_.column(entry)];
  }

  const TransportMatrix& transport_;
  const BlockSparse& leaves_;
  const NodeTable& nodes_;
  std::vector<std::uint8_t> level_;
};

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

std::vector<std::string> problems(const ConnectionGraphSettings& settings) {
  std::vector<std::string> found;
  if (!(settings.leastShare >= 0.0 && settings.leastShare <= 1.0))
    found.push_back("the share of a row's brightest connection must lie between 0 and 1");
  if (settings.coarsestLevel < 0) found.push_back("the coarsest level must not be negative");
  return found;
}

ConnectionGraph::ConnectionGraph(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                                 const ConnectionGraphSettings& settings, Progress& progress)
    : transport_(&transport), nodes_(transport.layout()) {
  if (auto found = problems(settings); !found.empty())
    throw Error(ErrorKind::usage, found.front(), "correct the setting", "clustering");
  const BlockSparse& leaves = transport.leaves();
  require(usable.size() == leaves.rows(), "{} usable flags for {} camera pixels", usable.size(),
          leaves.rows());
  require(leaves.blocks() < std::numeric_limits<std::uint32_t>::max(), "{} leaves", leaves.blocks());
  flood_ = transport.floodlight();
  squaredNorm_ = squaredRowNorms(transport, nodes_, &nested_);
  progress.report(0.3);

  // First to count: the connections are the largest array here and are made to measure.
  NearLeaves near(transport, nodes_);
  std::size_t rows = leaves.rows();
  std::vector<float> least(rows, 0.0f);
  std::vector<std::array<std::size_t, mostLevels>> perLevel(parts);
  parallelChunks(0, rows, parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    perLevel[part].fill(0);
    for (std::size_t row = begin; row < end; ++row) {
      if (!usable[row]) continue;
      least[row] = static_cast<float>(settings.leastShare) * near.brightest(row);
      near.visit(row, least[row], settings.coarsestLevel, [&](std::size_t entry, int level, float) {
        perLevel[part][static_cast<std::size_t>(level)] +=
            static_cast<std::size_t>(nodes_.pixels[leaves.column(entry)]);
      });
    }
  });
  std::size_t expected = 0;
  for (int level = 0; level <= std::min<int>(settings.coarsestLevel, mostLevels - 1); ++level) {
    std::size_t here = 0;
    for (const auto& part : perLevel) here += part[static_cast<std::size_t>(level)];
    if (level > 0 && expected + here > mostConnections) break;
    expected += here;
    coarsestLevel_ = level;
  }
  require(expected < std::numeric_limits<std::uint32_t>::max(), "{} connections", expected);
  progress.report(0.5);

  start_.assign(rows + 1, 0);
  length_.assign(rows, 0);
  parallelFor(0, rows, 256, [&](std::size_t row) {
    if (!usable[row]) return;
    near.visit(row, least[row], coarsestLevel_, [&](std::size_t entry, int, float) {
      start_[row + 1] += static_cast<std::size_t>(nodes_.pixels[leaves.column(entry)]);
    });
  });
  for (std::size_t row = 0; row < rows; ++row) start_[row + 1] += start_[row];
  progress.report(0.6);

  edges_.resize(start_.back() + 1);  // one more, so that an empty last row has an address
  struct Light {
    double carried = 0.0, all = 0.0;
    std::size_t connections = 0;
  };
  std::vector<Light> light(parts);
  parallelChunks(0, rows, parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<Connection> edges;
    for (std::size_t row = begin; row < end; ++row) {
      if (!usable[row]) continue;
      edges.clear();
      near.visit(row, least[row], coarsestLevel_,
                 [&](std::size_t entry, int, float bright) { near.expand(entry, bright, edges); });
      if (nested_[row]) keepBrightestOfEachPixel(edges);
      std::sort(edges.begin(), edges.end(), [](const Connection& a, const Connection& b) {
        return a.luminance != b.luminance ? a.luminance > b.luminance : a.pixel < b.pixel;
      });
      std::copy(edges.begin(), edges.end(), edges_.begin() + static_cast<std::ptrdiff_t>(start_[row]));
      length_[row] = static_cast<std::uint32_t>(edges.size());
      light[part].connections += edges.size();
      for (const Connection& edge : edges) light[part].carried += static_cast<double>(edge.luminance);
      double seen =
          static_cast<double>(luminanceOf(flood_[3 * row], flood_[3 * row + 1], flood_[3 * row + 2]));
      if (std::isfinite(seen)) light[part].all += seen;
    }
  });
  double carried = 0.0, all = 0.0;
  for (const Light& part : light) {
    carried += part.carried;
    all += part.all;
    connections_ += part.connections;
  }
  if (all > 0.0) carriedLight_ = carried / all;
  progress.report(1.0);
}

std::size_t ConnectionGraph::bytes() const {
  return edges_.size() * sizeof(Connection) + start_.size() * sizeof(std::size_t) +
         length_.size() * sizeof(std::uint32_t) + flood_.size() * sizeof(float) +
         squaredNorm_.size() * sizeof(double) + nested_.size() +
         nodes_.pixels.size() * (sizeof(float) + sizeof(std::uint32_t));
}

}  // namespace relucent
