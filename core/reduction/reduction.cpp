// SPDX-License-Identifier: MIT
#include "relucent/reduction/reduction.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::reduction {
namespace {

constexpr int mostBits = 16;  // that a journal holds as codes

/// The linear signal of one channel's samples: whole codes through a table.
class Response {
 public:
  Response(const hdr::ResponseCurve& curve, int bits) : curve_(curve), linear_(curve.isIdentity()) {
    if (linear_ || bits < 1 || bits > mostBits) return;
    codes_ = std::ldexp(1.0, bits) - 1.0;
    for (double code = 0.0; code <= codes_; ++code) table_.push_back(curve_(code / codes_));
  }

  double operator()(double signal) const {
    if (linear_) return signal;
    if (table_.empty()) return curve_(signal);
    return table_[static_cast<std::size_t>(std::lround(std::clamp(signal, 0.0, 1.0) * codes_))];
  }

 private:
  const hdr::ResponseCurve& curve_;
  bool linear_;
  double codes_ = 0.0;
  std::vector<double> table_;
};

int aligned(int value, int bin) {
  return value / bin * bin;
}

/// Calls take(value, place) for every sample of one channel of the bin at (x, y) of the reduced picture.
template <typename Take>
void forBin(const Reduction& reduction, int x, int y, int channel, const Take& take) {
  const auto width = static_cast<std::size_t>(reduction.camera.width);
  for (int row = 0; row < reduction.bin; ++row) {
    const auto top = static_cast<std::size_t>(reduction.begin.y + y * reduction.bin + row);
    const auto left = static_cast<std::size_t>(reduction.begin.x + x * reduction.bin);
    std::size_t at = 3 * (top * width + left) + static_cast<std::size_t>(channel);
    for (int column = 0; column < reduction.bin; ++column, at += 3) take(at);
  }
}

}  // namespace

Reduction noReduction(Size camera) {
  Reduction reduction;
  reduction.camera = reduction.part = camera;
  return reduction;
}

Reduction reductionTo(Size camera, Pixel begin, Size part, int bin) {
  require(bin >= 1 && bin <= std::min(camera.width, camera.height), "a bin of {} for {}x{} pixels", bin,
          camera.width, camera.height);
  require(begin.x >= 0 && begin.y >= 0 && !part.empty() && begin.x + part.width <= camera.width &&
              begin.y + part.height <= camera.height,
          "{}x{} pixels from {}, {} on of {}x{}", part.width, part.height, begin.x, begin.y, camera.width,
          camera.height);
  auto along = [bin](int first, int length, int all) {
    const int most = aligned(all, bin);
    const int from = std::min(aligned(first, bin), most - bin);
    const int to = std::clamp(aligned(first + length + bin - 1, bin), from + bin, most);
    return std::pair(from, to - from);
  };
  Reduction reduction = noReduction(camera);
  reduction.bin = bin;
  std::tie(reduction.begin.x, reduction.part.width) = along(begin.x, part.width, camera.width);
  std::tie(reduction.begin.y, reduction.part.height) = along(begin.y, part.height, camera.height);
  return reduction;
}

std::array<float, 3> wholeFromReduced(const Reduction& reduction) {
  std::array<float, 3> factor{1.0f, 1.0f, 1.0f};
  if (reduction.bin > 1)
    for (std::size_t c = 0; c < 3; ++c) factor[c] = static_cast<float>(reduction.response[c](reduction.clip));
  return factor;
}

hdr::CameraModel wholeModel(const Reduction& reduction, const hdr::CameraModel& reduced) {
  if (reduction.bin == 1) return reduced;
  hdr::CameraModel model = reduced;
  model.response = reduction.response;
  model.saturation = hdr::saturationMargin * reduction.clip;
  // Of all channels there is one noise; their scales hardly differ.
  const double full = static_cast<double>(wholeFromReduced(reduction)[1]);
  model.readNoise *= reduction.bin * full;
  model.gain *= reduction.bin * reduction.bin * full;
  return model;
}

Reducer::Reducer(Reduction reduction) : reduction_(std::move(reduction)) {
  for (std::size_t c = 0; c < 3; ++c) {
    linear_ = linear_ && reduction_.response[c].isIdentity();
    full_[c] = reduction_.response[c](reduction_.clip);
  }
  if (reduction_.defective.empty() || reduction_.bin == 1) return;
  defective_.assign(3 * reduction_.camera.count(), 0);
  for (std::uint32_t value : reduction_.defective) {
    require(value < defective_.size(), "no sample {} among {}", value, defective_.size());
    defective_[value] = 1;
  }
}

int Reducer::bitsOf(int bits) const {
  if (reduction_.bin == 1 || bits < 1) return bits;
  if (!linear_) return mostBits;
  const auto samples = static_cast<unsigned>(reduction_.bin * reduction_.bin);
  return std::min(mostBits, bits + static_cast<int>(std::bit_width(samples - 1)));
}

rig::RawFrame Reducer::operator()(const rig::RawFrame& frame) const {
  require(frame.signal.size() == reduction_.camera && frame.signal.channels() == 3,
          "a photograph of {}x{} pixels, {} channels for a camera of {}x{}", frame.signal.width(),
          frame.signal.height(), frame.signal.channels(), reduction_.camera.width, reduction_.camera.height);
  if (reduction_.isNothing()) return frame;
  const Size size = reduction_.size();
  rig::RawFrame result{image::Image(size, 3), bitsOf(frame.bits), frame.seconds};
  const float* signal = frame.signal.data().data();
  if (reduction_.bin == 1) {
    parallelFor(0, static_cast<std::size_t>(size.height), 64, [&](std::size_t y) {
      const std::size_t from =
          3 * indexOf(reduction_.camera, {reduction_.begin.x, reduction_.begin.y + static_cast<int>(y)});
      const std::size_t count = 3 * static_cast<std::size_t>(size.width);
      std::copy_n(signal + from, count, result.signal.data().data() + y * count);
    });
    return result;
  }

  const std::array<Response, 3> responses{Response(reduction_.response[0], frame.bits),
                                          Response(reduction_.response[1], frame.bits),
                                          Response(reduction_.response[2], frame.bits)};
  const float saturation = static_cast<float>(hdr::saturationMargin * reduction_.clip);
  const double codes = result.bits > 0 ? std::ldexp(1.0, result.bits) - 1.0 : 0.0;
  parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const Response& response = responses[static_cast<std::size_t>(c)];
        double sum = 0.0, sumOfAll = 0.0;
        int sound = 0, full = 0, fullOfAll = 0;
        forBin(reduction_, x, y, c, [&](std::size_t at) {
          const double light = response(static_cast<double>(signal[at]));
          const bool isFull = signal[at] >= saturation;
          sumOfAll += light;
          fullOfAll += isFull;
          if (isDefective(at)) return;
          sum += light;
          full += isFull;
          ++sound;
        });
        if (sound == 0) {
          sum = sumOfAll;
          full = fullOfAll;
          sound = reduction_.bin * reduction_.bin;
        }
        double mean = full > 0 ? 1.0 : sum / (sound * full_[static_cast<std::size_t>(c)]);
        if (codes > 0.0) mean = std::clamp(std::nearbyint(mean * codes), 0.0, codes) / codes;
        result.signal.at(x, y, c) = static_cast<float>(mean);
      }
  });
  return result;
}

image::Image Reducer::radiance(const image::Image& linear) const {
  require(linear.size() == reduction_.camera && linear.channels() == 3,
          "{}x{} pixels, {} channels for a camera of {}x{}", linear.width(), linear.height(),
          linear.channels(), reduction_.camera.width, reduction_.camera.height);
  if (reduction_.isNothing()) return linear;
  const Size size = reduction_.size();
  image::Image result(size, 3);
  parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0.0, sumOfAll = 0.0;
        int sound = 0;
        forBin(reduction_, x, y, c, [&](std::size_t at) {
          const auto value = static_cast<double>(linear.data()[at]);
          sumOfAll += value;
          if (isDefective(at)) return;
          sum += value;
          ++sound;
        });
        const double mean = sound > 0 ? sum / sound : sumOfAll / (reduction_.bin * reduction_.bin);
        const double full = reduction_.bin > 1 ? full_[static_cast<std::size_t>(c)] : 1.0;
        result.at(x, y, c) = static_cast<float>(mean / full);
      }
  });
  return result;
}

}  // namespace relucent::reduction
