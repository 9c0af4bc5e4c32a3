// SPDX-License-Identifier: MIT
#include "relucent/engine/packed_transport.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::engine {
namespace {

constexpr std::size_t mostColumnsOfAPatch = 65535;
constexpr float largestCode = 32767.0f;

using Channels = std::array<float, 3>;

/// One camera pixel's leaves by global nodes, before patches renumber them.
struct PackedRow {
  std::vector<std::uint32_t> node;
  std::vector<std::array<std::int16_t, 3>> code;
  std::array<float, 9> mixing{};
};

/// Only the brightest leaves if a patch could not number them all, in the order that they had.
void dropDimmest(std::vector<std::uint32_t>& node, std::vector<Channels>& factor) {
  if (node.size() <= mostColumnsOfAPatch) return;
  std::vector<float> strength(node.size());
  for (std::size_t i = 0; i < node.size(); ++i)
    strength[i] = std::abs(factor[i][0]) + std::abs(factor[i][1]) + std::abs(factor[i][2]);
  std::vector<std::uint32_t> order(node.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::nth_element(order.begin(), order.begin() + mostColumnsOfAPatch, order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return strength[a] != strength[b] ? strength[a] > strength[b] : a < b;
                   });
  order.resize(mostColumnsOfAPatch);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) {
    node[i] = node[order[i]];
    factor[i] = factor[order[i]];
  }
  node.resize(order.size());
  factor.resize(order.size());
  for (std::size_t c = 0; c < 3; ++c) {
    float sum = 0.0f;
    for (const Channels& f : factor) sum += f[c];
    if (sum > 0.0f)
      for (Channels& f : factor) f[c] /= sum;
  }
}

PackedRow packedRow(const transport::BlockSparse& leaves, std::size_t row) {
  Eigen::Matrix3d mixing = Eigen::Matrix3d::Zero();
  for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
    mixing += leaves.block(row, entry).cast<double>();
  Eigen::RowVector3d square = mixing.colwise().squaredNorm();

  PackedRow result;
  std::vector<Channels> factor;
  Channels largest{};
  for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
    Eigen::RowVector3d along = mixing.cwiseProduct(leaves.block(row, entry).cast<double>()).colwise().sum();
    Channels f{};
    for (Eigen::Index c = 0; c < 3; ++c)
      if (square[c] > 0.0) f[static_cast<std::size_t>(c)] = static_cast<float>(along[c] / square[c]);
    result.node.push_back(leaves.column(entry));
    factor.push_back(f);
  }
  dropDimmest(result.node, factor);
  for (const Channels& f : factor)
    for (std::size_t c = 0; c < 3; ++c) largest[c] = std::max(largest[c], std::abs(f[c]));

  for (const Channels& f : factor) {
    std::array<std::int16_t, 3> code{};
    for (std::size_t c = 0; c < 3; ++c)
      if (largest[c] > 0.0f)
        code[c] = static_cast<std::int16_t>(std::lround(f[c] / largest[c] * largestCode));
    result.code.push_back(code);
  }
  for (std::size_t i = 0; i < 9; ++i)
    result.mixing[i] =
        static_cast<float>(mixing(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) *
                           largest[i % 3] / largestCode);
  return result;
}

/// A patch on its way: its pixels' rows and the nodes that they touch.
struct Draft {
  std::vector<std::uint32_t> pixel;
  std::vector<PackedRow> row;
  std::vector<std::uint32_t> node;
};

std::vector<std::uint32_t> nodesOf(const std::vector<PackedRow>& rows, std::size_t begin, std::size_t end) {
  std::vector<std::uint32_t> nodes;
  for (std::size_t row = begin; row < end; ++row)
    nodes.insert(nodes.end(), rows[row].node.begin(), rows[row].node.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Halves a patch until its nodes can be numbered by 16 bits.
void split(Draft draft, std::vector<Draft>& done) {
  draft.node = nodesOf(draft.row, 0, draft.row.size());
  if (draft.node.size() <= mostColumnsOfAPatch) {
    done.push_back(std::move(draft));
    return;
  }
  auto middle = static_cast<std::ptrdiff_t>(draft.row.size() / 2);
  Draft second;
  second.pixel.assign(draft.pixel.begin() + middle, draft.pixel.end());
  second.row.assign(std::make_move_iterator(draft.row.begin() + middle),
                    std::make_move_iterator(draft.row.end()));
  draft.pixel.resize(static_cast<std::size_t>(middle));
  draft.row.resize(static_cast<std::size_t>(middle));
  split(std::move(draft), done);
  split(std::move(second), done);
}

/// A square of a camera's pixels.
struct Square {
  std::size_t camera;
  Pixel from;
};

std::vector<Square> squaresOf(const Rasters& cameras, int side) {
  std::vector<Square> squares;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    for (int y = 0; y < cameras.size(camera).height; y += side)
      for (int x = 0; x < cameras.size(camera).width; x += side) squares.push_back({camera, {x, y}});
  return squares;
}

Draft draftOf(const transport::TransportMatrix& transport, const Square& square, int side) {
  Size size = transport.cameras().size(square.camera);
  Draft draft;
  for (int y = square.from.y; y < std::min(square.from.y + side, size.height); ++y) {
    for (int x = square.from.x; x < std::min(square.from.x + side, size.width); ++x) {
      std::size_t pixel = transport.cameras().offset(square.camera) + indexOf(size, {x, y});
      draft.pixel.push_back(static_cast<std::uint32_t>(pixel));
      draft.row.push_back(packedRow(transport.leaves(), pixel));
    }
  }
  return draft;
}

}  // namespace

PackedTransport::PackedTransport(const transport::TransportMatrix& transport, int patchSide) {
  require(patchSide > 0, "patches of {} pixels", patchSide);
  require(transport.leaves().blocks() <= std::numeric_limits<std::uint32_t>::max(),
          "{} leaves are more than 32-bit indices hold", transport.leaves().blocks());
  leaf_.reserve(transport.leaves().blocks());
  std::vector<Square> squares = squaresOf(transport.cameras(), patchSide);
  // A few squares at a time: rows on their way take several times the memory of packed ones.
  constexpr std::size_t batch = 16;
  for (std::size_t begin = 0; begin < squares.size(); begin += batch) {
    std::size_t count = std::min(batch, squares.size() - begin);
    std::vector<std::vector<Draft>> drafts(count);
    parallelFor(0, count, 1,
                [&](std::size_t i) { split(draftOf(transport, squares[begin + i], patchSide), drafts[i]); });
    for (const std::vector<Draft>& ofSquare : drafts) {
      for (const Draft& draft : ofSquare) {
        TransportPatch patch;
        patch.rowBegin = static_cast<std::uint32_t>(pixel_.size());
        patch.columnBegin = static_cast<std::uint32_t>(node_.size());
        node_.insert(node_.end(), draft.node.begin(), draft.node.end());
        pixel_.insert(pixel_.end(), draft.pixel.begin(), draft.pixel.end());
        for (const PackedRow& row : draft.row) {
          mixing_.insert(mixing_.end(), row.mixing.begin(), row.mixing.end());
          for (std::size_t i = 0; i < row.node.size(); ++i) {
            if (row.code[i] == std::array<std::int16_t, 3>{}) continue;
            auto place = std::lower_bound(draft.node.begin(), draft.node.end(), row.node[i]);
            leaf_.push_back({row.code[i], static_cast<std::uint16_t>(place - draft.node.begin())});
          }
          leafStart_.push_back(static_cast<std::uint32_t>(leaf_.size()));
        }
        patch.rowEnd = static_cast<std::uint32_t>(pixel_.size());
        patch.columnEnd = static_cast<std::uint32_t>(node_.size());
        patches_.push_back(patch);
      }
    }
  }
}

std::size_t PackedTransport::bytes() const {
  return leaf_.size() * sizeof(PackedLeaf) + leafStart_.size() * sizeof(std::uint32_t) +
         pixel_.size() * sizeof(std::uint32_t) + mixing_.size() * sizeof(float) +
         node_.size() * sizeof(std::uint32_t);
}

std::size_t PackedTransport::mostColumns() const {
  std::size_t most = 0;
  for (const TransportPatch& patch : patches_)
    most = std::max<std::size_t>(most, patch.columnEnd - patch.columnBegin);
  return most;
}

}  // namespace relucent::engine
