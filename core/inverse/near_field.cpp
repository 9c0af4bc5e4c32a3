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

/// diag(U B) of each of a row's colours: times a leaf's factors it is diag(U T) of the leaf.
class UnmixedRow {
 public:
  UnmixedRow(const transport::ColourBlock& unmix, const transport::LeafRow& leaves) : leaves_(leaves) {
    for (std::size_t k = 0; k < leaves.colourings(); ++k)
      ofColours_.push_back(unmix.cwiseProduct(leaves.colours(k).transpose()).rowwise().sum().array());
  }

  /// Calls visit(entry, value) for every leaf.
  template <typename Visit>
  void each(const Visit& visit) const {
    leaves_.eachFactor([&](std::size_t entry, std::size_t k, const Eigen::Array3f& factor) {
      visit(entry, Eigen::Array3f(ofColours_[k] * factor));
    });
  }

 private:
  const transport::LeafRow& leaves_;
  std::vector<Eigen::Array3f> ofColours_;
};

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
  const auto brightness = [&](const Eigen::Array3f& value, std::uint32_t column) {
    return std::abs(value.mean()) / nodes.pixels[column];
  };
  near.start.assign(rows + 1, 0);
  near.step.assign(rows, 0.0f);
  parallelFor(0, rows, 256, [&](std::size_t row) {
    if (!usable[row]) return;
    near.unmix[row] = regularisedUnmixing(mixing[row]);
    Eigen::Vector3f flood = near.unmix[row] * (mixing[row] * Eigen::Vector3f::Ones());
    near.flood[row] = {flood[0], flood[1], flood[2], 0.0f};
    const transport::LeafRow leaves = transport.row(row);
    const UnmixedRow unmixed(near.unmix[row], leaves);
    float brightest = 0.0f;
    unmixed.each([&](std::size_t entry, const Eigen::Array3f& value) {
      brightest = std::max(brightest, brightness(value, leaves.column(entry)));
    });
    threshold[row] = nearShare * brightest;
    if (!(brightest > 0.0f)) return;
    float largest = 0.0f;
    unmixed.each([&](std::size_t entry, const Eigen::Array3f& value) {
      if (brightness(value, leaves.column(entry)) < threshold[row]) return;
      ++near.start[row + 1];
      largest = std::max(largest, value.abs().maxCoeff());
    });
    near.step[row] = largest / largestCode;
  });
  for (std::size_t row = 0; row < rows; ++row) near.start[row + 1] += near.start[row];

  near.node.resize(near.start.back());
  near.code.resize(near.start.back());
  parallelFor(0, rows, 256, [&](std::size_t row) {
    std::size_t next = near.start[row];
    if (next == near.start[row + 1]) return;
    const transport::LeafRow leaves = transport.row(row);
    UnmixedRow(near.unmix[row], leaves).each([&](std::size_t entry, const Eigen::Array3f& value) {
      if (brightness(value, leaves.column(entry)) < threshold[row]) return;
      near.node[next] = leaves.column(entry);
      for (std::size_t c = 0; c < 3; ++c)
        near.code[next][c] =
            static_cast<std::int16_t>(std::lround(value[static_cast<Eigen::Index>(c)] / near.step[row]));
      ++next;
    });
  });
  return near;
}

}  // namespace relucent::inverse
