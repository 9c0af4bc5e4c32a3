// SPDX-License-Identifier: MIT
#include "relucent/monitoring/shadow_evidence.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/require.h"

namespace relucent::monitoring {
namespace {

constexpr double soft = 8.0;         // chi^2 of three channels from which on more counts for little
constexpr double asExpected = 20.0;  // chi^2 of three channels that T's errors may have
constexpr float ofMoment = 0.5f;     // what the moment may be off, of the step to the next one

}  // namespace

ShadowEvidence::ShadowEvidence(const Observed& seen, const Moment& moment, const WatchedVenue& venue,
                               const ShadowMap& map, const KnownLight& known)
    : map_(map) {
  const std::size_t projectors = map.projectors(), count = map.samples().size();
  require(known.gains.size() == 3 * projectors && known.room.size() == 6, "{} gains of {} projectors",
          known.gains.size(), projectors);
  const std::vector<float> parts = venue.transport.lightOf(moment.means, map.samples());
  const std::vector<float> along =
      moment.along.empty() ? std::vector<float>() : venue.transport.lightOf(moment.along, map.samples());
  samples_.resize(count);
  light_.resize(count * projectors);
  for (std::size_t s = 0; s < count; ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * map.samples()[s] + c;
      float all = 0.0f, later = 0.0f;
      for (std::size_t j = 0; j < projectors; ++j) {
        float sum = 0.0f;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t part = 9 * (s * projectors + j) + 3 * c + k;
          sum += static_cast<float>(known.gains[3 * j + k]) * parts[part];
          if (!along.empty()) later += along[part];
        }
        light_[s * projectors + j][c] = sum;
        all += sum;
      }
      const auto wrong =
          static_cast<float>(venue.wrong) * all + static_cast<float>(venue.wrongOfFlood) * venue.flood[i];
      const float variance = seen.variance[i] + wrong * wrong + ofMoment * ofMoment * later * later;
      samples_[s].left[c] = seen.radiance[i] - venue.black[i] * (1.0f + static_cast<float>(known.room[c])) -
                            venue.flood[i] * static_cast<float>(known.room[3 + c]);
      samples_[s].precision[c] = seen.valid[i] != 0 ? 1.0f / variance : 0.0f;
    }
  information_.resize(map.cells());
  for (std::size_t cell = 0; cell < map.cells(); ++cell)
    for (const ShadowMap::Link& link : map.samplesOf(cell)) {
      const std::array<float, 3>& light = lightOf(link.other, map.projectorOf(cell));
      for (std::size_t c = 0; c < 3; ++c) {
        const float part = link.share * light[c];
        information_[cell] += static_cast<double>(samples_[link.other].precision[c] * part * part);
      }
    }
  assume(BlockedCells(map.cells(), 0));
}

void ShadowEvidence::assume(const BlockedCells& blocked) {
  blocked_ = blocked;
  missing_.assign(light_.size(), 0.0f);
  misfit_.assign(samples_.size(), 0.0);
  total_ = 0.0;
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    for (const ShadowMap::Link& link : map_.cellsOf(s))
      if (blocked[link.other] != 0)
        missing_[s * map_.projectors() + map_.projectorOf(link.other)] += link.share;
    findMisfit(s);
  }
}

void ShadowEvidence::findMisfit(std::size_t sample) {
  total_ -= misfit_[sample];
  misfit_[sample] = misfitAt(sample, 0, 0.0f);
  total_ += misfit_[sample];
}

void ShadowEvidence::set(std::size_t cell, bool blocked) {
  if ((blocked_[cell] != 0) == blocked) return;
  blocked_[cell] = blocked;
  for (const ShadowMap::Link& link : map_.samplesOf(cell)) {
    missing_[link.other * map_.projectors() + map_.projectorOf(cell)] += blocked ? link.share : -link.share;
    findMisfit(link.other);
  }
}

double ShadowEvidence::squaredAt(std::size_t sample, std::size_t projector, float more) const {
  double squared = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    float residual = samples_[sample].left[c] + more * lightOf(sample, projector)[c];
    for (std::size_t j = 0; j < map_.projectors(); ++j)
      residual -= lightOf(sample, j)[c] * (1.0f - missing(sample, j));
    squared += static_cast<double>(samples_[sample].precision[c] * residual * residual);
  }
  return squared;
}

double ShadowEvidence::misfitAt(std::size_t sample, std::size_t projector, float more) const {
  return soft * std::log1p(squaredAt(sample, projector, more) / soft);
}

double ShadowEvidence::changeBy(std::size_t cell) const {
  double change = 0.0;
  const float sign = blocked_[cell] != 0 ? -1.0f : 1.0f;
  for (const ShadowMap::Link& link : map_.samplesOf(cell))
    change += misfitAt(link.other, map_.projectorOf(cell), sign * link.share) - misfit_[link.other];
  return change;
}

double ShadowEvidence::shareOf(std::size_t cell) const {
  double products = 0.0, squares = 0.0;
  const std::size_t projector = map_.projectorOf(cell);
  for (const ShadowMap::Link& link : map_.samplesOf(cell))
    for (std::size_t c = 0; c < 3; ++c) {
      const Sample& sample = samples_[link.other];
      float residual = sample.left[c];
      for (std::size_t j = 0; j < map_.projectors(); ++j)
        if (j != projector) residual -= lightOf(link.other, j)[c] * (1.0f - missing(link.other, j));
      const float own = lightOf(link.other, projector)[c], weight = link.share * sample.precision[c];
      products += static_cast<double>(weight * own * residual);
      squares += static_cast<double>(weight * own * own);
    }
  return squares > 0.0 ? products / squares : 1.0;
}

double ShadowEvidence::explainedOf(std::span<const std::size_t> cells) const {
  double sum = 0.0, all = 0.0;
  for (std::size_t cell : cells)
    for (const ShadowMap::Link& link : map_.samplesOf(cell)) {
      all += static_cast<double>(link.share);
      if (squaredAt(link.other, 0, 0.0f) < asExpected) sum += static_cast<double>(link.share);
    }
  return all > 0.0 ? sum / all : 1.0;
}

double ShadowEvidence::explained() const {
  double sum = 0.0, all = 0.0;
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    double light = 0.0;
    for (std::size_t j = 0; j < map_.projectors(); ++j) light += static_cast<double>(lightOf(s, j)[1]);
    all += light;
    if (squaredAt(s, 0, 0.0f) < asExpected) sum += light;
  }
  return all > 0.0 ? sum / all : 1.0;
}

}  // namespace relucent::monitoring
