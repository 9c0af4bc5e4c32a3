// SPDX-License-Identifier: MIT
#include "relucent/linearization/camera_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace relucent::linearization {
namespace {

constexpr std::size_t binCount = 32;
constexpr double darkestBin = 1e-4;
constexpr double brightestShare = 0.95;  // of saturation, of the signals that are used
constexpr double leastValues = 100.0;    // in a bin, for its variance to be good to 15 %

double roundingVariance(int bits) {
  if (bits <= 0) return 0.0;
  double codes = std::ldexp(1.0, bits) - 1.0;
  return 1.0 / (12.0 * codes * codes);
}

/// Sums over values of similar brightness.
struct Bin {
  double count = 0.0, mean = 0.0, squares = 0.0, extra = 0.0;
};
using Bins = std::array<Bin, binCount>;

std::size_t binOf(double linear) {
  double place = std::log(linear / darkestBin) / -std::log(darkestBin);
  return static_cast<std::size_t>(std::clamp(place, 0.0, 0.999) * binCount);
}

/// Calls use(first, second, signal, channel) for linear signals of two equal frames, where both are clear of
/// saturation and of zero.
template <typename Use>
void forPairs(const rig::RawFrame& first, const rig::RawFrame& second, const hdr::CameraModel& model,
              const Use& use) {
  for (std::size_t at = 0; at < first.signal.data().size(); ++at) {
    double a = static_cast<double>(first.signal.data()[at]),
           b = static_cast<double>(second.signal.data()[at]);
    if (std::max(a, b) >= brightestShare * model.saturation || std::min(a, b) <= 0.0) continue;
    const hdr::ResponseCurve& response = model.response[at % 3];
    use(response(a), response(b), 0.5 * (a + b), at % 3);
  }
}

/// How much brighter the first frame is than the second, over what is well lit; 1 where nothing is.
double powerRatio(const rig::RawFrame& first, const rig::RawFrame& second, const hdr::CameraModel& model) {
  double a = 0.0, b = 0.0, count = 0.0;
  forPairs(first, second, model, [&](double linearA, double linearB, double, std::size_t) {
    if (0.5 * (linearA + linearB) < 0.05) return;
    a += linearA, b += linearB, count += 1.0;
  });
  return count >= leastValues ? a / b : 1.0;
}

void collect(Bins& bins, const rig::RawFrame& first, const rig::RawFrame& second,
             const hdr::CameraModel& model) {
  double ratio = powerRatio(first, second, model);
  double rounding = roundingVariance(first.bits);
  forPairs(first, second, model, [&](double a, double b, double signal, std::size_t channel) {
    double mean = 0.5 * (a + ratio * b), difference = a - ratio * b;
    if (mean <= darkestBin) return;
    double slope = model.response[channel].slope(signal);
    Bin& bin = bins[binOf(mean)];
    bin.count += 1.0;
    bin.mean += mean;
    bin.squares += difference * difference / (1.0 + ratio * ratio);
    bin.extra += (slope * slope - 1.0) * rounding;
  });
}

struct Point {
  double mean, variance, relativeError;
};

/// From the brightest bin down, as far as signals are 5 deviations clear of zero: there, both being cut off
/// and being sorted by their own noise make values look calmer than they are. The deviation is taken from
/// the bin above, which has been found sound; from one far above as photon noise falls with light.
/// `brightest`: the same at the upper end, where signals were
/// left out.
std::vector<Point> pointsOf(const Bins& bins, double brightest) {
  std::vector<Point> points;
  double deviationAbove = 0.0, meanAbove = 0.0;
  for (auto bin = bins.rbegin(); bin != bins.rend(); ++bin) {
    if (bin->count < leastValues) continue;
    double mean = bin->mean / bin->count, spread = bin->squares / bin->count;
    if (mean + 5.0 * std::sqrt(spread) > brightest) continue;
    if (meanAbove > 2.0 * mean) deviationAbove *= std::sqrt(2.0 * mean / meanAbove);
    if (mean < 5.0 * std::max(deviationAbove, std::sqrt(spread))) break;
    deviationAbove = std::sqrt(spread);
    meanAbove = mean;
    double variance = spread - bin->extra / bin->count;
    // Beyond some thousand values the model, not the statistics, limits the fit.
    if (variance > 0.0) points.push_back({mean, variance, std::max(0.03, std::sqrt(2.0 / bin->count))});
  }
  return points;
}

/// Half the mean square of differences in the darkest pair of frames, if it is dark: cut at zero or not, the
/// read noise is at least that.
double spreadInDarkFrames(const std::vector<ShotPair>& pairs, const hdr::CameraModel& model,
                          std::size_t camera) {
  double darkest = 1e30, spread = 0.0;
  for (const auto& [first, second] : pairs) {
    for (std::size_t exposure = 0; exposure < first.frames.size(); ++exposure) {
      const std::vector<float>& a = first.frames[exposure][camera].signal.data();
      const std::vector<float>& b = second.frames[exposure][camera].signal.data();
      double sum = 0.0, squares = 0.0, count = static_cast<double>(a.size());
      for (std::size_t at = 0; at < a.size(); ++at) {
        const hdr::ResponseCurve& response = model.response[at % 3];
        double linearA = response(static_cast<double>(a[at])), linearB = response(static_cast<double>(b[at]));
        sum += 0.5 * (linearA + linearB);
        squares += 0.5 * (linearA - linearB) * (linearA - linearB);
      }
      if (sum / count >= darkest) continue;
      darkest = sum / count;
      spread = squares / count;
    }
  }
  return darkest < 3.0 * std::sqrt(spread) ? spread : 0.0;
}

struct Line {
  double offset = 0.0, slope = 0.0;
};

/// variance = offset + slope * mean, neither negative; deviations count relative to the line's value.
std::optional<Line> robustLine(const std::vector<Point>& points) {
  if (points.size() < 3) return std::nullopt;
  std::optional<Line> line;
  for (int round = 0; round < 12; ++round) {
    double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const Point& point : points) {
      double expected = line ? line->offset + line->slope * point.mean : point.variance;
      double sigma = point.relativeError * std::max(expected, 1e-18);
      double deviation = line ? std::abs(point.variance - expected) / sigma : 0.0;
      double weight = std::min(1.0, 2.0 / std::max(deviation, 1e-9)) / (sigma * sigma);
      w += weight, x += weight * point.mean, y += weight * point.variance;
      xx += weight * point.mean * point.mean, xy += weight * point.mean * point.variance;
    }
    double determinant = w * xx - x * x;
    Line next{0.0, xy / xx};
    if (determinant > 1e-12 * w * xx)
      next = {(y * xx - x * xy) / determinant, (w * xy - x * y) / determinant};
    if (next.offset < 0.0) next = {0.0, xy / xx};
    if (next.slope < 0.0) next = {y / w, 0.0};
    line = next;
  }
  return line;
}

double median(std::vector<double> values) {
  auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

hdr::CameraModel withMeasuredNoise(hdr::CameraModel model, const std::vector<ShotPair>& pairs,
                                   std::size_t camera) {
  Bins bins;
  double rounding = 0.0;
  for (const auto& [first, second] : pairs) {
    for (std::size_t exposure = 0; exposure < first.frames.size(); ++exposure) {
      collect(bins, first.frames[exposure][camera], second.frames[exposure][camera], model);
      rounding = roundingVariance(first.frames[exposure][camera].bits);
    }
  }
  double brightest = 1.0;
  for (const hdr::ResponseCurve& response : model.response)
    brightest = std::min(brightest, response(brightestShare * model.saturation));
  if (std::optional<Line> line = robustLine(pointsOf(bins, brightest))) {
    model.readNoise = std::sqrt(line->offset);
    model.gain = line->slope;
  }
  // Bright signals alone leave it uncertain; noise about zero, half of it cut off, keeps a third of its
  // variance.
  const double dark = spreadInDarkFrames(pairs, model, camera);
  if (dark > 0.0) model.readNoise = std::clamp(model.readNoise, std::sqrt(dark), std::sqrt(3.0 * dark));
  model.readNoise = std::max({model.readNoise, std::sqrt(rounding), 1e-5});
  model.gain = std::max(model.gain, 1e-7);
  return model;
}

double flickerOf(const hdr::CameraModel& model, const std::vector<ShotPair>& pairs, std::size_t camera) {
  double squares = 0.0, count = 0.0;
  for (const auto& [first, second] : pairs)
    for (std::size_t exposure = 0; exposure < first.frames.size(); ++exposure) {
      double ratio = powerRatio(first.frames[exposure][camera], second.frames[exposure][camera], model);
      if (ratio == 1.0) continue;
      squares += 0.5 * std::log(ratio) * std::log(ratio);
      count += 1.0;
    }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

hdr::CameraModel withMeasuredTimes(hdr::CameraModel model, const std::vector<ShotPair>& pairs,
                                   std::size_t camera) {
  model.times.clear();
  const std::vector<std::vector<rig::RawFrame>>& bracket = pairs.front().first.frames;
  double reference = bracket.back()[camera].seconds;
  for (std::size_t exposure = 0; exposure < bracket.size(); ++exposure) {
    double reported = bracket[exposure][camera].seconds;
    std::vector<double> scales;
    for (const auto& [first, second] : pairs)
      for (const rig::Shot* shot : {&first, &second}) {
        std::vector<double> ratios = hdr::exposureRatios(*shot, camera, model);
        double scale = ratios[exposure] / ratios.back() * reference / reported;
        // Exactly 1 says that there was too little light to tell.
        if (scale != 1.0) scales.push_back(scale);
      }
    model.times.push_back({reported, scales.empty() ? 1.0 : median(scales)});
  }
  std::stable_sort(
      model.times.begin(), model.times.end(),
      [](const hdr::ExposureTime& a, const hdr::ExposureTime& b) { return a.reported < b.reported; });
  auto same = [](const hdr::ExposureTime& a, const hdr::ExposureTime& b) { return a.reported == b.reported; };
  model.times.erase(std::unique(model.times.begin(), model.times.end(), same), model.times.end());
  return model;
}

}  // namespace relucent::linearization
