// SPDX-License-Identifier: MIT
#include "relucent/acquisition/colour_class.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/parallel.h"

namespace relucent::acquisition {
namespace {

using Code = transport::BlockSparseWriter::Code;

// A child is at most as bright as its parent, but for the noise of both.
constexpr float brighterThanParent = 1.1f;
// A camera pixel contradicts its parent beyond so many thresholds, which lit leaves may hold unevenly, ...
constexpr float toleratedThresholds = 6.0f;
// ... and so many standard deviations; a disturbance is that many camera pixels.
constexpr float contradictionSigmas = 8.0f;
constexpr std::size_t fewestContradictions = 6;
constexpr std::size_t mostRows = 100;
// Standard deviation of what the unevenness of lit leaves does to a frame, as a share of tau.
constexpr float unevenness = 0.25f;

/// What a row's leaves send to the camera, per projector channel, with these shares of their blocks lit.
transport::ColourBlock underPattern(const std::vector<transport::BlockSparse>& leaves, std::size_t row,
                                    const std::vector<float>& shares) {
  float sum[9] = {};
  float scale = 0.0f;
  for (const transport::BlockSparse& level : leaves) {
    scale = level.scale(row);
    for (std::size_t entry = level.rowBegin(row); entry < level.rowBegin(row + 1); ++entry) {
      float share = shares[level.column(entry)];
      if (share == 0.0f) continue;
      const Code& code = level.code(entry);
      for (std::size_t i = 0; i < 9; ++i) sum[i] += share * static_cast<float>(code[i]);
    }
  }
  transport::ColourBlock block;
  for (int i = 0; i < 9; ++i) block.data()[i] = scale * sum[i];
  return block;
}

/// The light of the lit channels in one camera channel.
float inLight(const transport::ColourBlock& block, std::size_t cameraChannel, const LitChannels& light) {
  float sum = 0.0f;
  for (std::size_t k = 0; k < 3; ++k)
    if (light[k]) sum += block.data()[3 * cameraChannel + k];
  return sum;
}

ProjectorStack patternIn(const LitChannels& light, const std::vector<std::uint8_t>& lit) {
  ProjectorStack pattern(3 * lit.size(), 0.0f);
  for (std::size_t i = 0; i < lit.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) pattern[3 * i + k] = light[k] ? lit[i] : 0.0f;
  return pattern;
}

}  // namespace

ColourClass::ColourClass(Tree& tree, std::span<const LitPair> seen, const TreeContext& context)
    : tree_(tree),
      seen_(seen),
      watch_(context.watch),
      references_(context.references()),
      scheme_(context.scheme),
      measured_(quadrants * seen.size()),
      wanted_(seen.size(), 1) {}

std::shared_ptr<const LitQuadrant> ColourClass::lit(int quadrant, std::vector<std::uint8_t> pixels) const {
  auto result = std::make_shared<LitQuadrant>();
  result->quadrant = quadrant;
  result->predicted.assign(seen_.size(), transport::ColourBlock::Zero());
  if (scheme_.subtractsLeaves) {
    std::vector<float> shares = litShares(pixels, tree_.layout);
    parallelFor(0, seen_.size(), 256, [&](std::size_t i) {
      result->predicted[i] = underPattern(tree_.leaves, seen_[i].row, shares);
    });
  }
  result->lit = std::move(pixels);
  return result;
}

ClassFrame ColourClass::frame(std::shared_ptr<const LitQuadrant> quadrant, const LitChannels& light) const {
  ClassFrame frame;
  frame.light = light;
  frame.pattern = patternIn(light, quadrant->lit);
  if (!scheme_.allExposures) frame.demands = demands(*quadrant, light);
  frame.quadrant = std::move(quadrant);
  return frame;
}

sentinels::Interruptible<hdr::LampLight> ColourClass::photograph(
    const ClassFrame& frame, const Progress& progress, const photography::Meanwhile& meanwhile) const {
  if (frame.demands.empty()) return watch_.lightOfAll(frame.pattern, progress, meanwhile);
  return watch_.light(frame.pattern, frame.demands, progress, meanwhile);
}

void ColourClass::settle(Children& children) {
  parallelFor(0, seen_.size(), 256, [&](std::size_t i) { settle(i, children); });
}

bool ColourClass::contradictsParent(std::size_t i) const {
  auto [row, pair] = seen_[i];
  transport::ColourBlock parent = tree_.active.block(row, pair), spread = tree_.spread.block(row, pair);
  transport::ColourBlock sum = transport::ColourBlock::Zero(), variance = spread.cwiseProduct(spread);
  for (std::size_t k = quadrants * i; k < quadrants * (i + 1); ++k) {
    sum += measured_[k].value;
    variance += measured_[k].variance;
  }
  float leaves = toleratedThresholds * scheme_.threshold[row];
  for (int k = 0; k < 9; ++k) {
    float noise = contradictionSigmas * std::sqrt(std::max(0.0f, variance.data()[k]));
    if (std::abs(parent.data()[k] - sum.data()[k]) > std::max(leaves, noise)) return true;
  }
  return false;
}

bool ColourClass::contradictsParents() {
  if (!scheme_.reconciles) return false;
  parallelFor(0, seen_.size(), 256, [&](std::size_t i) { wanted_[i] = contradictsParent(i) ? 1 : 0; });
  auto contradicting = static_cast<std::size_t>(std::count(wanted_.begin(), wanted_.end(), 1));
  return contradicting >= fewestContradictions + seen_.size() / mostRows;
}

std::vector<photography::Demand> ColourClass::demands(const LitQuadrant& quadrant,
                                                      const LitChannels& light) const {
  const hdr::BlackLevel& black = watch_.black();
  std::vector<photography::Demand> demands(references_.usable.size());
  parallelFor(0, seen_.size(), 1024, [&](std::size_t i) {
    std::size_t row = seen_[i].row;
    transport::ColourBlock parent = tree_.active.block(row, seen_[i].pair);
    float brightest = 0.0f, expected = 0.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      float around = black.radiance[3 * row + c] + inLight(quadrant.predicted[i], c, light);
      float block = std::max(0.0f, inLight(parent, c, light));
      brightest = std::max(brightest, around + brighterThanParent * block);
      expected = std::max(expected, around + block / quadrants);
    }
    demands[row] = {brightest, expected, scheme_.tolerable[row]};
  });
  return demands;
}

std::size_t ColourClass::projectorOf(const LitPair& seen) const {
  return static_cast<std::size_t>(tree_.layout.node(tree_.active.column(seen.pair)).projector);
}

void ColourClass::extract(const ClassFrame& frame, const hdr::LampLight& seen) {
  const LitChannels& light = frame.light;
  parallelFor(0, seen_.size(), 256, [&](std::size_t i) {
    if (!wanted_[i]) return;
    std::size_t row = seen_[i].row, projector = projectorOf(seen_[i]);
    transport::ColourBlock shares =
        channelShares(light, references_.root[projector][row], references_.rootVariance[projector][row]);
    Estimate& child = measured_[quadrants * i + static_cast<std::size_t>(frame.quadrant->quadrant)];
    for (std::size_t c = 0; c < 3; ++c) {
      std::size_t at = 3 * row + c;
      float value = seen.radiance[at] - inLight(frame.quadrant->predicted[i], c, light);
      float variance = seen.variance[at];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!light[k]) continue;
        float share = shares.data()[3 * c + k];
        child.value.data()[3 * c + k] = share * value;
        child.variance.data()[3 * c + k] = share * share * variance;
      }
      // Too bright for every exposure: the whole camera pixel is in doubt.
      if (!seen.valid[at]) tree_.unknown[row] = 1;
    }
  });
}

Code ColourClass::leafCode(std::size_t row, const transport::ColourBlock& value) const {
  float scale = tree_.active.scale(row);
  transport::ColourBlock rounded = value + tree_.rounding[row];
  Code code = transport::codeOf(rounded, scale);
  for (std::size_t c = 0; c < 9; ++c) rounded.data()[c] -= scale * static_cast<float>(code[c]);
  tree_.rounding[row] = rounded;
  return code;
}

void ColourClass::settle(std::size_t i, Children& children) const {
  auto [row, pair] = seen_[i];
  if (tree_.unknown[row]) return;

  std::array<Estimate, quadrants> estimate;
  std::array<transport::Node, quadrants> node;
  std::array<int, quadrants> quadrant;
  std::array<transport::ColourBlock, quadrants> noise;
  std::size_t count = 0;
  transport::Node parent = tree_.layout.node(tree_.active.column(pair));
  for (int q = 0; q < quadrants; ++q) {
    if (!childOf(tree_.layout, parent, q, node[count])) continue;
    estimate[count] = measured_[quadrants * i + static_cast<std::size_t>(q)];
    noise[count] = estimate[count].variance;
    // Leaves that are lit in part were taken off as if they were even.
    estimate[count].variance.array() += std::pow(unevenness * scheme_.threshold[row], 2.0f);
    quadrant[count++] = q;
  }
  if (scheme_.reconciles) {
    transport::ColourBlock spread = tree_.spread.block(row, pair);
    reconcile({tree_.active.block(row, pair), spread.cwiseProduct(spread)}, {estimate.data(), count});
  }

  float scale = tree_.active.scale(row);
  transport::ColourBlock rest = transport::ColourBlock::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    bool followed = scheme_.follows(row, estimate[k].value, noise[k]);
    if (followed && node[k].level > 0) {
      children.set(pair, quadrant[k], transport::codeOf(estimate[k].value, scale));
      children.activate(pair, quadrant[k], spreadCode(estimate[k].variance, scale));
    } else if (scheme_.restToParent && !followed) {
      rest += estimate[k].value;
    } else {
      children.set(pair, quadrant[k], leafCode(row, estimate[k].value));
      tree_.leafNoise[row].add(estimate[k].variance);
    }
  }
  if (scheme_.restToParent) children.setRest(pair, leafCode(row, rest));
}

}  // namespace relucent::acquisition
