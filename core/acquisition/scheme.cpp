// SPDX-License-Identifier: MIT
#include "relucent/acquisition/scheme.h"

#include <algorithm>
#include <cmath>

namespace relucent::acquisition {
namespace {

// A flood's sum below this many standard deviations says nothing about its mixing.
constexpr float mixingSigmas = 5.0f;
// Share of flagged camera pixels that is worth a tree of their rows.
constexpr double manyFlagged = 0.005;
constexpr double never = 2.0;

std::vector<LitChannels> lightsOf(LitColours colours) {
  if (colours == LitColours::white) return {{true, true, true}};
  return {{true, false, false}, {false, true, false}, {false, false, true}};
}

std::vector<float> scaled(std::vector<float> values, double factor) {
  for (float& value : values) value *= static_cast<float>(factor);
  return values;
}

}  // namespace

bool Scheme::follows(std::size_t row, const transport::ColourBlock& value,
                     const transport::ColourBlock& variance) const {
  auto sigmas = static_cast<float>(noiseSigmas);
  for (int i = 0; i < 9; ++i) {
    float noise = sigmas * std::sqrt(std::max(0.0f, variance.data()[i]));
    if (value.data()[i] > std::max(threshold[row], noise)) return true;
  }
  return false;
}

Scheme schemeOf(const AcquisitionSettings& settings, const photography::References& references) {
  Scheme scheme;
  scheme.lights = lightsOf(settings.colours);
  if (settings.scheme != AcquisitionScheme::sen) {
    scheme.threshold = scaled(references.strongest, settings.relativeThreshold);
    scheme.noiseSigmas = settings.noiseSigmas;
    if (settings.scheme == AcquisitionScheme::multiplexed) scheme.repairedFrom = manyFlagged;
  } else {
    // One radiance for all has to be that of the dimmest pixels that are to be resolved.
    double dimmest = settings.relativeThreshold * settings.dimShare * static_cast<double>(references.typical);
    double everywhere = settings.absoluteThreshold > 0.0 ? settings.absoluteThreshold : dimmest;
    scheme.threshold.assign(references.strongest.size(), static_cast<float>(everywhere));
    scheme.allExposures = true;
    scheme.subtractsLeaves = scheme.reconciles = false;
    scheme.repairedFrom = never;
    scheme.restToParent = true;
  }
  scheme.tolerable = scaled(scheme.threshold, 1.0 / settings.noiseSigmas);
  return scheme;
}

transport::ColourBlock channelShares(const LitChannels& light, const transport::ColourBlock& flood,
                                     const transport::ColourBlock& floodVariance) {
  transport::ColourBlock shares = transport::ColourBlock::Zero();
  for (int c = 0; c < 3; ++c) {
    float sum = 0.0f, variance = 0.0f, lit = 0.0f;
    for (int k = 0; k < 3; ++k) {
      if (!light[static_cast<std::size_t>(k)]) continue;
      sum += std::max(0.0f, flood(c, k));
      variance += std::max(0.0f, floodVariance(c, k));
      lit += 1.0f;
    }
    bool known = lit > 1.0f && sum > 0.0f && sum * sum > mixingSigmas * mixingSigmas * variance;
    for (int k = 0; k < 3; ++k)
      if (light[static_cast<std::size_t>(k)])
        shares(c, k) = known ? std::max(0.0f, flood(c, k)) / sum : 1.0f / lit;
  }
  return shares;
}

}  // namespace relucent::acquisition
