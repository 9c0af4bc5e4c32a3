// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/hdr/hdr.h"

namespace relucent::hdr {
namespace {

constexpr std::size_t leastValues = 50;

struct Pair {
  double longer = 0.0, shorter = 0.0;
  double ratio() const { return shorter / longer; }
};

/// Linear signals of two frames of the same light where both tell something. Chosen by the longer frame
/// alone: choosing by the noisier one would choose its noise.
std::vector<Pair> comparable(const rig::RawFrame& longer, const rig::RawFrame& shorter,
                             const CameraModel& model) {
  double nominal = shorter.seconds / longer.seconds;
  std::vector<Pair> pairs;
  for (std::size_t at = 0; at < longer.signal.data().size(); ++at) {
    double signal = longer.signal.data()[at];
    if (signal >= 0.95 * model.saturation) continue;
    const ResponseCurve& response = model.response[at % 3];
    double linear = response(signal);
    if (linear < 0.1 || linear * nominal < 5.0 * model.readNoise) continue;
    pairs.push_back({linear, response(static_cast<double>(shorter.signal.data()[at]))});
  }
  return pairs;
}

double median(std::vector<double> values) {
  auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<double> ratioOf(const std::vector<Pair>& pairs) {
  if (pairs.size() < leastValues) return std::nullopt;
  std::vector<double> values;
  for (const Pair& pair : pairs) values.push_back(pair.ratio());
  double middle = median(values);
  for (double& value : values) value = std::abs(value - middle);
  double spread = 1.4826 * median(values);

  // The median alone sits on the grid of rounded values; the sums do not.
  double longer = 0.0, shorter = 0.0;
  for (const Pair& pair : pairs) {
    if (std::abs(pair.ratio() - middle) > 4.0 * spread + 0.02 * middle) continue;
    longer += pair.longer;
    shorter += pair.shorter;
  }
  return longer > 0.0 && shorter > 0.0 ? std::optional(shorter / longer) : std::nullopt;
}

}  // namespace

std::vector<double> exposureRatios(const rig::Shot& shot, std::size_t camera, const CameraModel& model) {
  std::vector<const rig::RawFrame*> frames;
  for (const std::vector<rig::RawFrame>& exposure : shot.frames) frames.push_back(&exposure.at(camera));
  require(!frames.empty(), "a shot without exposures has no ratios");
  std::vector<std::size_t> order(frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return frames[a]->seconds > frames[b]->seconds; });

  // From the longest down, each measured against its next longer neighbour.
  std::vector<double> time(frames.size());
  time[order.front()] = 1.0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const rig::RawFrame& longer = *frames[order[i - 1]];
    const rig::RawFrame& shorter = *frames[order[i]];
    double ratio = ratioOf(comparable(longer, shorter, model)).value_or(shorter.seconds / longer.seconds);
    time[order[i]] = time[order[i - 1]] * ratio;
  }
  double first = time.front();
  for (double& value : time) value /= first;
  return time;
}

}  // namespace relucent::hdr
