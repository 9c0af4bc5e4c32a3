// SPDX-License-Identifier: MIT
#include "relucent/image/video_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/image/colour.h"

namespace relucent::image {
namespace {

double lightOf(double value, VideoEncoding::Transfer transfer) {
  switch (transfer) {
    case VideoEncoding::Transfer::bt1886:
      return std::pow(value, 2.4);
    case VideoEncoding::Transfer::srgb:
      return srgbDecode(value);
    case VideoEncoding::Transfer::linear:
      return value;
    case VideoEncoding::Transfer::gamma22:
      return std::pow(value, 2.2);
    case VideoEncoding::Transfer::gamma28:
      return std::pow(value, 2.8);
  }
  return value;
}

/// sRGB codes of encoded values 0 to 1. A step is a sixteenth of an 8-bit code.
class Codes {
 public:
  explicit Codes(VideoEncoding::Transfer transfer) {
    for (std::size_t i = 0; i < code_.size(); ++i)
      code_[i] = static_cast<std::uint8_t>(
          std::lround(255.0 * srgbEncode(lightOf(static_cast<double>(i) / steps, transfer))));
  }
  std::uint8_t operator()(float value) const {
    return code_[static_cast<std::size_t>(std::clamp(value, 0.0f, 1.0f) * steps + 0.5f)];
  }

 private:
  static constexpr int steps = 16 * 255;
  std::array<std::uint8_t, steps + 1> code_{};
};

const Codes& codesOf(VideoEncoding::Transfer transfer) {
  using Transfer = VideoEncoding::Transfer;
  static const std::array<Codes, 5> codes{Codes(Transfer::bt1886), Codes(Transfer::srgb),
                                          Codes(Transfer::linear), Codes(Transfer::gamma22),
                                          Codes(Transfer::gamma28)};
  return codes[static_cast<std::size_t>(transfer)];
}

/// The numbers of an encoding, for samples of some bits: y = lumaScale (Y - lumaZero), ...
struct Numbers {
  Numbers(const VideoEncoding& encoding, int bits) {
    bool bt709 = encoding.matrix == VideoEncoding::Matrix::bt709;
    bool full = encoding.range == VideoEncoding::Range::full;
    auto unit = static_cast<float>(1 << (bits - 8));
    float largest = 256.0f * unit - 1.0f;
    lumaZero = full ? 0.0f : 16.0f * unit;
    lumaScale = full ? 1.0f / largest : 1.0f / (219.0f * unit);
    chromaZero = 128.0f * unit;
    float chroma = full ? 1.0f / largest : 1.0f / (224.0f * unit);
    float red = bt709 ? 0.2126f : 0.299f, blue = bt709 ? 0.0722f : 0.114f, green = 1.0f - red - blue;
    redOfRed = 2.0f * (1.0f - red) * chroma;
    blueOfBlue = 2.0f * (1.0f - blue) * chroma;
    greenOfRed = red / green * redOfRed;
    greenOfBlue = blue / green * blueOfBlue;
  }
  float lumaZero, lumaScale, chromaZero, redOfRed, greenOfRed, greenOfBlue, blueOfBlue;
};

template <typename Sample>
const Sample* lineOf(const VideoSamples::Plane& plane, int y) {
  return reinterpret_cast<const Sample*>(static_cast<const std::uint8_t*>(plane.data) +
                                         static_cast<std::size_t>(y) * plane.bytesPerLine);
}

template <typename Sample>
void convertLine(const VideoSamples& samples, int width, int y, const Numbers& numbers, const Codes& codes,
                 std::uint8_t* rgbx) {
  const Sample* luma = lineOf<Sample>(samples.luma, y);
  bool coloured = samples.blue.data != nullptr && samples.red.data != nullptr;
  const Sample* blue = coloured ? lineOf<Sample>(samples.blue, y / samples.coarserY) : nullptr;
  const Sample* red = coloured ? lineOf<Sample>(samples.red, y / samples.coarserY) : nullptr;
  for (int x = 0; x < width; ++x, rgbx += 4) {
    float value = numbers.lumaScale * (static_cast<float>(luma[x * samples.luma.step]) - numbers.lumaZero);
    float b = 0.0f, r = 0.0f;
    if (coloured) {
      int shared = x / samples.coarserX;
      b = static_cast<float>(blue[shared * samples.blue.step]) - numbers.chromaZero;
      r = static_cast<float>(red[shared * samples.red.step]) - numbers.chromaZero;
    }
    rgbx[0] = codes(value + numbers.redOfRed * r);
    rgbx[1] = codes(value - numbers.greenOfRed * r - numbers.greenOfBlue * b);
    rgbx[2] = codes(value + numbers.blueOfBlue * b);
    rgbx[3] = 255;
  }
}

}  // namespace

void srgbFromVideo(const VideoSamples& samples, Size size, const VideoEncoding& encoding, std::uint8_t* rgbx,
                   std::size_t bytesPerLine) {
  require(samples.bits >= 8 && samples.bits <= 16 && samples.coarserX >= 1 && samples.coarserY >= 1,
          "{} bits, {}x{} pixels a chroma sample", samples.bits, samples.coarserX, samples.coarserY);
  const Numbers numbers(encoding, samples.bits);
  const Codes& codes = codesOf(encoding.transfer);
  auto convert = samples.bits > 8 ? convertLine<std::uint16_t> : convertLine<std::uint8_t>;
  parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t y) {
    convert(samples, size.width, static_cast<int>(y), numbers, codes, rgbx + y * bytesPerLine);
  });
}

}  // namespace relucent::image
