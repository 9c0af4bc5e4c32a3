// SPDX-License-Identifier: MIT
#include "relucent/transport/coarsening.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "relucent/base/parallel.h"

namespace relucent::transport {
namespace {

using Code = BlockSparseWriter::Code;
using Entry = std::pair<std::size_t, ColourBlock>;  // node and light

int joinedSide(int side, int levels) {
  return std::max(1, (side + (1 << levels) - 1) >> levels);
}

/// Calls visit(pixel) for the pixels of all cameras that are joined in one.
template <typename Visit>
void eachJoined(const Rasters& cameras, const Rasters& few, int levels, std::size_t row, const Visit& visit) {
  std::size_t camera = 0;
  while (row >= few.offset(camera) + few.size(camera).count()) ++camera;
  Pixel at = pixelAt(few.size(camera), row - few.offset(camera));
  Size size = cameras.size(camera);
  for (int y = at.y << levels; y < std::min(size.height, (at.y + 1) << levels); ++y)
    for (int x = at.x << levels; x < std::min(size.width, (at.x + 1) << levels); ++x)
      visit(cameras.offset(camera) + indexOf(size, {x, y}));
}

/// Which node of the coarse layout holds the light of a node.
std::size_t nodeIn(const NodeLayout& few, const NodeLayout& layout, std::size_t index,
                   const Coarsening& coarsening) {
  Node node = layout.node(index);
  int level = std::max({0, node.level - coarsening.projectors, coarsening.leaves});
  level = std::min(level, few.levels(static_cast<std::size_t>(node.projector)) - 1);
  int up = level + coarsening.projectors - node.level;
  return few.index({node.projector, level, node.x >> up, node.y >> up});
}

void addUp(std::vector<Entry>& entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.first < b.first; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (kept > 0 && entries[kept - 1].first == entries[i].first)
      entries[kept - 1].second += entries[i].second;
    else
      entries[kept++] = entries[i];
  }
  entries.resize(kept);
}

/// The largest magnitude, which a row's scale has to hold.
float largestIn(const std::vector<Entry>& entries) {
  float largest = 0.0f;
  for (const Entry& entry : entries) largest = std::max(largest, entry.second.cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace

Rasters coarsened(const Rasters& devices, int levels) {
  std::vector<Size> sizes = devices.sizes();
  for (Size& size : sizes) size = {joinedSide(size.width, levels), joinedSide(size.height, levels)};
  return sizes;
}

TransportMatrix coarsenedTransport(const Rasters& cameras, const NodeLayout& layout, const CameraMask& counts,
                                   const Coarsening& coarsening, const RowLeaves& leavesOf) {
  Rasters fewCameras = coarsened(cameras, coarsening.cameras);
  NodeLayout few(coarsened(layout.projectors(), coarsening.projectors));
  std::size_t rows = fewCameras.count();
  std::vector<std::vector<std::uint32_t>> nodes(rows);
  std::vector<std::vector<Code>> codes(rows);
  std::vector<float> fullScale(rows, 0.0f);
  parallelFor(0, rows, 16, [&](std::size_t row) {
    std::vector<Entry> entries;
    float pixels = 0.0f;
    eachJoined(cameras, fewCameras, coarsening.cameras, row, [&](std::size_t pixel) {
      if (!counts[pixel]) return;
      pixels += 1.0f;
      leavesOf(pixel, [&](std::size_t node, const ColourBlock& block) {
        entries.emplace_back(nodeIn(few, layout, node, coarsening), block);
      });
    });
    addUp(entries);
    for (Entry& entry : entries) entry.second /= pixels;
    fullScale[row] = largestIn(entries);
    for (const Entry& entry : entries) {
      nodes[row].push_back(static_cast<std::uint32_t>(entry.first));
      codes[row].push_back(codeOf(entry.second, fullScale[row] / 32767.0f));
    }
  });
  std::size_t leaves = 0;
  for (const std::vector<Code>& row : codes) leaves += row.size();
  BlockSparseWriter writer(few.count(), fullScale, leaves);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < codes[row].size(); ++i) writer.add(nodes[row][i], codes[row][i]);
    writer.endRow();
    nodes[row] = {};
    codes[row] = {};  // two of them need not fit into memory
  }
  return {fewCameras, few.projectors(), writer.build()};
}

CameraStack joined(const CameraStack& values, const Rasters& cameras, const CameraMask& counts, int levels) {
  Rasters few = coarsened(cameras, levels);
  CameraStack result(3 * few.count(), 0.0f);
  parallelFor(0, few.count(), 256, [&](std::size_t row) {
    Eigen::Array3f counted = Eigen::Array3f::Zero(), all = Eigen::Array3f::Zero();
    float counting = 0.0f, pixels = 0.0f;
    eachJoined(cameras, few, levels, row, [&](std::size_t pixel) {
      Eigen::Map<const Eigen::Array3f> value(&values[3 * pixel]);
      all += value;
      pixels += 1.0f;
      if (!counts[pixel]) return;
      counted += value;
      counting += 1.0f;
    });
    Eigen::Map<Eigen::Array3f> mean(&result[3 * row]);
    mean = counting > 0.0f ? Eigen::Array3f(counted / counting) : Eigen::Array3f(all / pixels);
  });
  return result;
}

CameraMask joined(const CameraMask& mask, const Rasters& cameras, int levels) {
  Rasters few = coarsened(cameras, levels);
  CameraMask result(few.count(), 0);
  for (std::size_t row = 0; row < result.size(); ++row) {
    int set = 0, pixels = 0;
    eachJoined(cameras, few, levels, row, [&](std::size_t pixel) {
      set += mask[pixel] != 0;
      ++pixels;
    });
    result[row] = 2 * set >= pixels;
  }
  return result;
}

Acquisition coarsened(const Acquisition& acquisition, const Coarsening& coarsening) {
  const TransportMatrix& transport = acquisition.transport;
  const Rasters& cameras = transport.cameras();
  CameraMask counts(acquisition.flagged.size());
  for (std::size_t row = 0; row < counts.size(); ++row) counts[row] = acquisition.flagged[row] ? 0 : 1;
  auto mean = [&](const CameraStack& values) { return joined(values, cameras, counts, coarsening.cameras); };
  auto variance = [&](const CameraStack& values) {
    CameraStack few = mean(values);
    for (float& value : few) value /= static_cast<float>(1 << (2 * coarsening.cameras));
    return few;
  };
  Acquisition few;
  few.transport = coarsenedTransport(cameras, transport.layout(), counts, coarsening,
                                     [&](std::size_t row, const AddLeaf& add) {
                                       const LeafRow leaves = transport.row(row);
                                       for (std::size_t entry = 0; entry < leaves.size(); ++entry)
                                         add(leaves.column(entry), leaves.block(entry));
                                     });
  few.black = mean(acquisition.black);
  few.blackVariance = variance(acquisition.blackVariance);
  few.flood = mean(acquisition.flood);
  few.floodVariance = variance(acquisition.floodVariance);
  few.flagged = joined(acquisition.flagged, cameras, coarsening.cameras);
  return few;
}

}  // namespace relucent::transport
