// SPDX-License-Identifier: MIT
#include "relucent/inverse/near_field.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"
#include "relucent/inverse/unmixing.h"
#include "relucent/transport/statistics.h"

namespace relucent::inverse {
namespace {

/// Below this share of the row's brightest projector pixel a leaf cannot matter beside the ridge: pairs of
/// such leaves contribute at most its square to G, the ridge is tenths of G's diagonal.
constexpr float nearShare = 0.01f;

float mean(const NearField::Value& value) {
  return (value[0] + value[1] + value[2]) / 3.0f;
}

/// diag(U T) of one leaf.
NearField::Value unmixed(const transport::ColourBlock& unmix, const transport::ColourBlock& block) {
  NearField::Value value{};
  for (int c = 0; c < 3; ++c) value[static_cast<std::size_t>(c)] = unmix.row(c).dot(block.col(c));
  return value;
}

}  // namespace

NearField nearFieldOf(const transport::TransportMatrix& transport, const CameraMask& usable) {
  const std::size_t rows = transport.cameras().count();
  require(usable.size() == rows, "{} usable flags for {} camera pixels", usable.size(), rows);

  transport::NodeTable nodes(transport.layout());
  NearField near;
  near.unmix.assign(rows, transport::ColourBlock::Zero());
  near.flood.assign(rows, NearField::Value{});
  std::vector<transport::ColourBlock> mixing = transport.rowSums();
  std::vector<float> threshold(rows, 0.0f);

  // Twice over the same leaves, first to count: the near field is the largest array here and is made to
  // measure.
  auto brightness = [&](std::size_t row, const transport::LeafRow& leaves, std::size_t entry) {
    return std::abs(mean(unmixed(near.unmix[row], leaves.block(entry)))) / nodes.pixels[leaves.column(entry)];
  };
  near.start.assign(rows + 1, 0);
  near.step.assign(rows, 0.0f);
  parallelFor(0, rows, 256, [&](std::size_t row) {
    if (!usable[row]) return;
    near.unmix[row] = regularisedUnmixing(mixing[row]);
    Eigen::Vector3f flood = near.unmix[row] * (mixing[row] * Eigen::Vector3f::Ones());
    near.flood[row] = {flood[0], flood[1], flood[2], 0.0f};
    const transport::LeafRow leaves = transport.row(row);
    float brightest = 0.0f;
    for (std::size_t entry = 0; entry < leaves.size(); ++entry)
      brightest = std::max(brightest, brightness(row, leaves, entry));
    threshold[row] = nearShare * brightest;
    if (!(brightest > 0.0f)) return;
    float largest = 0.0f;
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
      if (brightness(row, leaves, entry) < threshold[row]) continue;
      ++near.start[row + 1];
      for (float value : unmixed(near.unmix[row], leaves.block(entry)))
        largest = std::max(largest, std::abs(value));
    }
    near.step[row] = largest / largestCode;
  });
  for (std::size_t row = 0; row < rows; ++row) near.start[row + 1] += near.start[row];

  near.node.resize(near.start.back());
  near.code.resize(near.start.back());
  parallelFor(0, rows, 256, [&](std::size_t row) {
    std::size_t next = near.start[row];
    if (next == near.start[row + 1]) return;
    const transport::LeafRow leaves = transport.row(row);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
      if (brightness(row, leaves, entry) < threshold[row]) continue;
      const NearField::Value value = unmixed(near.unmix[row], leaves.block(entry));
      near.node[next] = leaves.column(entry);
      for (std::size_t c = 0; c < 3; ++c)
        near.code[next][c] = static_cast<std::int16_t>(std::lround(value[c] / near.step[row]));
      ++next;
    }
  });
  return near;
}

}  // namespace relucent::inverse
