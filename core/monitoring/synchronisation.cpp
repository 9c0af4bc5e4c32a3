// SPDX-License-Identifier: MIT
#include "relucent/monitoring/synchronisation.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/require.h"

namespace relucent::monitoring {
namespace {

constexpr std::size_t mostCompared = 400;  // samples
constexpr float outlier = 9.0f;            // squared deviations beyond which a value counts no more
constexpr double standsStill = 1e-4;       // misfits closer than this tell nothing apart

/// T p at the compared samples, a vector a frame, with the photograph's light and weights.
struct Compared {
  std::vector<float> light, weight;  // y - e, 1 / variance; weight 0: not valid
  std::vector<std::vector<float>> frames;

  std::vector<float> at(std::span<const double> weights) const {
    std::vector<float> sum(light.size(), 0.0f);
    for (std::size_t k = 0; k < frames.size(); ++k)
      if (weights[k] != 0.0)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<float>(weights[k]) * frames[k][i];
    return sum;
  }
  float squared(float residual, std::size_t i) const { return residual * residual * weight[i]; }
  double misfit(const std::vector<float>& predicted) const {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
      if (weight[i] == 0.0f) continue;
      sum += std::min(squared(light[i] - predicted[i], i), outlier);
      count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
  }
};

Compared comparedOf(const Observed& seen, std::span<const PlayedFrame> frames, const WatchedVenue& venue,
                    std::span<const double> gains) {
  std::vector<std::uint32_t> samples;
  const std::vector<std::uint32_t>& even = venue.sampling.even;
  const std::size_t step = std::max<std::size_t>(1, even.size() / mostCompared);
  for (std::size_t i = step / 2; i < even.size(); i += step) samples.push_back(even[i]);

  Compared compared;
  const std::size_t projectors = venue.transport.projectors();
  for (const PlayedFrame& frame : frames) {
    const FrameMeans* one = &frame.means;
    const double all = 1.0;
    const std::vector<float> parts = venue.transport.lightOf(mixed({&one, 1}, {&all, 1}), samples);
    std::vector<float>& total = compared.frames.emplace_back(3 * samples.size(), 0.0f);
    for (std::size_t s = 0; s < samples.size(); ++s)
      for (std::size_t j = 0; j < projectors; ++j)
        for (std::size_t i = 0; i < 9; ++i)
          total[3 * s + i / 3] +=
              static_cast<float>(gains[3 * j + i % 3]) * parts[9 * (s * projectors + j) + i];
  }
  // How wrong a prediction may be follows from the brightest of them, the same for all.
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * samples[s] + c, own = 3 * s + c;
      float brightest = 0.0f;
      for (const std::vector<float>& frame : compared.frames) brightest = std::max(brightest, frame[own]);
      const double wrong = venue.wrong * brightest + venue.wrongOfFlood * venue.flood[i];
      compared.light.push_back(seen.radiance[i] - venue.black[i]);
      compared.weight.push_back(
          seen.valid[i] != 0 ? static_cast<float>(1.0 / (seen.variance[i] + wrong * wrong)) : 0.0f);
    }
  return compared;
}

/// How much of an exposure [s, s + seconds) each frame is lit.
std::vector<double> sharesAt(double s, double seconds, std::span<const PlayedFrame> frames) {
  std::vector<double> shares(frames.size(), 0.0);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double from = k == 0 ? s : std::max(s, frames[k].since);
    const double to = k + 1 == frames.size() ? s + seconds : std::min(s + seconds, frames[k + 1].since);
    shares[k] = std::max(0.0, to - from) / seconds;
  }
  return shares;
}

}  // namespace

Moment momentOf(const Observed& seen, std::span<const PlayedFrame> frames, double exposureSeconds,
                const WatchedVenue& venue, std::span<const double> gains) {
  require(!frames.empty() && exposureSeconds > 0.0, "{} frames, {} s", frames.size(), exposureSeconds);
  require(gains.size() == 3 * venue.transport.projectors(), "{} gains", gains.size());
  const Compared compared = comparedOf(seen, frames, venue, gains);

  std::vector<double> bends;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (k > 0) bends.push_back(frames[k].since - exposureSeconds);
    bends.push_back(k > 0 ? frames[k].since
                          : (frames.size() > 1 ? std::min(frames[0].since, frames[1].since - exposureSeconds)
                                               : frames[0].since));
  }
  std::sort(bends.begin(), bends.end());
  bends.erase(std::unique(bends.begin(), bends.end()), bends.end());
  std::vector<std::vector<float>> predicted;
  std::vector<double> misfits;
  for (double s : bends) {
    predicted.push_back(compared.at(sharesAt(s, exposureSeconds, frames)));
    misfits.push_back(compared.misfit(predicted.back()));
  }

  std::vector<std::size_t> order(bends.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return misfits[a] < misfits[b]; });
  std::size_t segment = order.front() > 0 ? order.front() - 1 : 0;
  double best = misfits[order.front()], share = order.front() > 0 ? 1.0 : 0.0;
  for (std::size_t n = 0; n < std::min<std::size_t>(3, order.size()); ++n)
    for (std::size_t from : {order[n], order[n] - 1}) {
      if (from >= bends.size() - 1) continue;  // also what is before the first, which wraps round
      const std::vector<float>&a = predicted[from], &b = predicted[from + 1];
      double t = from == order[n] ? 0.0 : 1.0;
      for (int iteration = 0; iteration < 3; ++iteration) {
        double up = 0.0, down = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
          const float along = b[i] - a[i];
          const float left = compared.light[i] - a[i] - static_cast<float>(t) * along;
          if (compared.squared(left, i) > outlier) continue;
          up += compared.weight[i] * along * left;
          down += compared.weight[i] * along * along;
        }
        if (down > 0.0) t = std::clamp(t + up / down, 0.0, 1.0);
      }
      std::vector<float> between = a;
      for (std::size_t i = 0; i < a.size(); ++i) between[i] += static_cast<float>(t) * (b[i] - a[i]);
      if (const double misfit = compared.misfit(between); misfit < best) {
        best = misfit;
        segment = from;
        share = t;
      }
    }

  std::vector<const FrameMeans*> means;
  for (const PlayedFrame& frame : frames) means.push_back(&frame.means);
  Moment moment;
  moment.misfit = best;
  const std::size_t next = std::min(segment + 1, bends.size() - 1);
  moment.since = bends[segment] + share * (bends[next] - bends[segment]);
  moment.means = mixed(means, sharesAt(moment.since, exposureSeconds, frames));
  if (next == segment || std::abs(compared.misfit(predicted[next]) - compared.misfit(predicted[segment])) +
                                 std::abs(misfits[next] - best) <
                             standsStill)
    return moment;
  const std::vector<float> from = mixed(means, sharesAt(bends[segment], exposureSeconds, frames));
  moment.along = mixed(means, sharesAt(bends[next], exposureSeconds, frames));
  for (std::size_t i = 0; i < from.size(); ++i) moment.along[i] -= from[i];
  return moment;
}

}  // namespace relucent::monitoring
