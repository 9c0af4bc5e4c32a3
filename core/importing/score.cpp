// SPDX-License-Identifier: MIT
#include "relucent/importing/score.h"

#include <cmath>

namespace relucent::importing {
namespace {

constexpr std::size_t chunks = 64;

/// Squares summed over a chunk of camera pixels.
struct Squares {
  double oneToOne = 0.0, mix = 0.0, transport = 0.0, variation = 0.0, light = 0.0;
  void add(const Squares& other) {
    oneToOne += other.oneToOne;
    mix += other.mix;
    transport += other.transport;
    variation += other.variation;
    light += other.light;
  }
};

ProjectorStack linearPattern(const PictureSequence& patterns, int frame, const DriveTable& drive) {
  ProjectorStack stack(3 * patterns.size().count());
  for (std::size_t i = 0; i < stack.size(); ++i) {
    int c = static_cast<int>(i % 3);
    stack[i] = drive(patterns.code(i / 3, frame, c), c);
  }
  return stack;
}

/// Mean of the held-out photographs, pixel by pixel.
Stack meanPhotograph(const HeldOutInput& input) {
  Stack mean(3 * input.lit.size());
  parallelFor(0, input.lit.size(), 1024, [&](std::size_t pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
      float sum = 0.0f;
      for (int frame : input.frames.heldOut)
        sum += input.photographs.value(pixel, frame, static_cast<int>(c));
      mean[3 * pixel + c] = sum / static_cast<float>(input.frames.heldOut.size());
    }
  });
  return mean;
}

double squared(float value) {
  return static_cast<double>(value) * static_cast<double>(value);
}

}  // namespace

HeldOutScore scoreHeldOut(const HeldOutInput& input, const transport::Acquisition& acquisition,
                          const DriveTable& drive, Progress& progress) {
  Stack mean = meanPhotograph(input);
  Squares all;
  for (std::size_t k = 0; k < input.frames.heldOut.size(); ++k) {
    int frame = input.frames.heldOut[k];
    ProjectorStack pattern = linearPattern(input.patterns, frame, drive);
    CameraStack predicted = acquisition.transport.apply(pattern);
    std::vector<Squares> parts(chunks);
    parallelChunks(0, input.lit.size(), chunks, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t pixel = begin; pixel < end; ++pixel) {
        if (input.lit[pixel] == 0) continue;
        Eigen::Vector3f there = Eigen::Vector3f::Zero();
        if (input.decoded[pixel].pixel >= 0)
          there = Eigen::Map<const Eigen::Vector3f>(pattern.data() + 3 * input.decoded[pixel].pixel);
        Eigen::Vector3f one = input.oneToOne[pixel].black + input.oneToOne[pixel].block * there;
        Eigen::Vector3f mix = input.mix[pixel].black + input.mix[pixel].block * there;
        for (std::size_t c = 0; c < 3; ++c) {
          std::size_t at = 3 * pixel + c;
          auto channel = static_cast<Eigen::Index>(c);
          float photograph = input.photographs.value(pixel, frame, static_cast<int>(c));
          parts[chunk].oneToOne += squared(photograph - one[channel]);
          parts[chunk].mix += squared(photograph - mix[channel]);
          parts[chunk].transport += squared(photograph - predicted[at] - acquisition.black[at]);
          parts[chunk].variation += squared(photograph - mean[at]);
          parts[chunk].light += squared(photograph - acquisition.black[at]);
        }
      }
    });
    for (const Squares& part : parts) all.add(part);
    progress.report(static_cast<double>(k + 1) / static_cast<double>(input.frames.heldOut.size()));
  }
  auto ratio = [](double part, double whole) { return whole > 0.0 ? std::sqrt(part / whole) : 0.0; };
  return {{ratio(all.oneToOne, all.variation), ratio(all.mix, all.variation),
           ratio(all.transport, all.variation)},
          ratio(all.transport, all.light)};
}

}  // namespace relucent::importing
