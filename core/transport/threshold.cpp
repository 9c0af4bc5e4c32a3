// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/statistics.h"

namespace relucent::transport {
namespace {

float strengthOf(const LeafRow& leaves, const NodeTable& nodes, std::size_t entry) {
  return leaves.sizeOf(entry).largest / nodes.pixels[leaves.column(entry)];
}

/// The strength above which leaves hold `share` of all light. Strengths are told apart by their leading 16
/// bits, which is 1 % of their value; of a tie everything stays.
float limitOfEnergy(const TransportMatrix& transport, const NodeTable& nodes, double share) {
  if (share >= 1.0) return 0.0f;
  constexpr std::size_t bins = 1 << 15;  // positive floats by their leading bits, in order
  std::vector<std::vector<double>> partial(fixedParts);
  const std::size_t rows = transport.cameras().count();
  parallelChunks(0, rows, fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    partial[part].assign(bins, 0.0);
    for (std::size_t row = begin; row < end; ++row) {
      const LeafRow leaves = transport.row(row);
      for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
        auto bits = std::bit_cast<std::uint32_t>(strengthOf(leaves, nodes, entry));
        partial[part][(bits >> 16) & (bins - 1)] += static_cast<double>(leaves.sizeOf(entry).sum);
      }
    }
  });
  std::vector<double> energy(bins, 0.0);
  double all = 0.0;
  for (const auto& part : partial)
    for (std::size_t bin = 0; bin < part.size(); ++bin) energy[bin] += part[bin];
  for (double value : energy) all += value;

  double held = 0.0;
  std::size_t bin = bins;
  while (bin > 0 && held < share * all) held += energy[--bin];
  return std::bit_cast<float>(static_cast<std::uint32_t>(bin) << 16);
}

void requireValid(const ThresholdSettings& settings) {
  if (auto found = problems(settings); !found.empty())
    throw Error(ErrorKind::usage, found.front(),
                RELUCENT_ENGLISH_MESSAGE("transport.choose-another-threshold", "choose another threshold"),
                "threshold");
}

}  // namespace

std::vector<Message> problems(const ThresholdSettings& settings) {
  std::vector<Message> found;
  if (!(settings.absolute >= 0.0f))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("transport.threshold-negative", "the threshold must not be negative"));
  if (!(settings.shareOfRowMax >= 0.0f && settings.shareOfRowMax <= 1.0f))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("transport.row-share-out-of-range",
                                 "the share of a row's strongest connection must lie between 0 and 1"));
  if (!(settings.energyKept >= 0.0 && settings.energyKept <= 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("transport.kept-energy-out-of-range",
                                             "the share of the energy to keep must lie between 0 and 1"));
  return found;
}

bool cutsNothing(const ThresholdSettings& settings) {
  return settings.absolute == 0.0f && settings.shareOfRowMax == 0.0f && settings.energyKept == 1.0;
}

std::vector<float> thresholdLimits(const TransportMatrix& transport, const ThresholdSettings& settings) {
  requireValid(settings);
  std::vector<float> limit(transport.cameras().count(), 0.0f);
  if (cutsNothing(settings)) return limit;

  NodeTable nodes(transport.layout());
  float everywhere = std::max(settings.absolute, limitOfEnergy(transport, nodes, settings.energyKept));
  parallelFor(0, limit.size(), 256, [&](std::size_t row) {
    const LeafRow leaves = transport.row(row);
    float strongest = 0.0f;
    for (std::size_t entry = 0; entry < leaves.size(); ++entry)
      strongest = std::max(strongest, strengthOf(leaves, nodes, entry));
    limit[row] = std::min(strongest, std::max(everywhere, settings.shareOfRowMax * strongest));
  });
  return limit;
}

TransportMatrix thresholded(const TransportMatrix& transport, const ThresholdSettings& settings,
                            const CameraStack& flood) {
  std::vector<float> limit = thresholdLimits(transport, settings);
  if (cutsNothing(settings)) return rescaledToFloodlight(transport, flood);
  NodeTable nodes(transport.layout());
  return rescaledToFloodlight(
      transport.filtered([&](std::size_t row, const LeafRow& leaves, std::vector<std::uint8_t>& keep) {
        for (std::size_t entry = 0; entry < leaves.size(); ++entry)
          keep[entry] = strengthOf(leaves, nodes, entry) >= limit[row] ? 1 : 0;
      }),
      flood);
}

}  // namespace relucent::transport
