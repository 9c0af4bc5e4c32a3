// SPDX-License-Identifier: MIT
#include "relucent/importing/decoding.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"

namespace relucent::importing {
namespace {

struct Candidate {
  float score = 0.0f;
  std::uint32_t node = 0;
  bool operator<(const Candidate& other) const {
    return score != other.score ? score > other.score : node < other.node;
  }
};

/// One camera pixel's sequence, centred; values that do not count are zero.
class Probe {
 public:
  Probe(const DecodingInput& input, std::size_t pixel)
      : pyramid_(input.pyramid), channels_(static_cast<std::size_t>(input.frames.channels)) {
    CameraSequence sequence;
    readSequence(input.photographs, input.frames, pixel, sequence);
    // Cut-off values still say "bright", which is all that correlation needs.
    centre(sequence.value);
    for (std::size_t c = 0; c < channels_; ++c) {
      part_[c] = channels_ == 1 ? sequence.value : everyThird(sequence.value, c);
      for (float value : part_[c]) power_ += value * value;
    }
    if (channels_ == 3) spread();
  }

  /// Share of the sequence's variation that a node explains.
  float explained(const SequencePyramid::Level& level, std::size_t node) const {
    const float* values = level.node(node, pyramid_.samples);
    float sum = 0.0f;
    for (std::size_t c = 0; c < channels_; ++c) {
      Eigen::Map<const Eigen::VectorXf> probe(part_[c].data(), static_cast<Eigen::Index>(part_[c].size()));
      Eigen::Map<const Eigen::VectorXf> there(values, pyramid_.samples);
      float along = std::max(0.0f, probe.dot(there)) * level.inverseNorm[node * channels_ + c];
      sum += along * along;
    }
    return power_ > 0.0f ? sum / power_ : 0.0f;
  }

 private:
  void centre(std::vector<float>& value) const {
    for (std::size_t c = 0; c < channels_; ++c) {
      float mean = 0.0f;
      for (std::size_t s = c; s < value.size(); s += channels_) mean += value[s];
      mean *= static_cast<float>(channels_) / static_cast<float>(value.size());
      for (std::size_t s = c; s < value.size(); s += channels_) value[s] -= mean;
    }
  }
  std::vector<float> everyThird(const std::vector<float>& value, std::size_t c) const {
    std::vector<float> part;
    for (std::size_t s = c; s < value.size(); s += 3) part.push_back(value[s]);
    return part;
  }
  /// Each channel at its places among zeros, so that a product with a node is one run through memory.
  void spread() {
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<float> wide(3 * part_[c].size(), 0.0f);
      for (std::size_t k = 0; k < part_[c].size(); ++k) wide[3 * k + c] = part_[c][k];
      part_[c] = std::move(wide);
    }
  }

  const SequencePyramid& pyramid_;
  std::size_t channels_;
  std::array<std::vector<float>, 3> part_;
  float power_ = 0.0f;
};

void keepBest(std::vector<Candidate>& candidates, std::size_t beam) {
  if (candidates.size() > beam) {
    std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(beam),
                     candidates.end());
    candidates.resize(beam);
  }
}

/// Nodes of the finer level under the candidates, with a ring around them; each once.
std::vector<std::uint32_t> finerNodes(const std::vector<Candidate>& candidates, Size coarse, Size fine) {
  std::vector<std::uint32_t> nodes;
  for (const Candidate& candidate : candidates) {
    Pixel at = pixelAt(coarse, candidate.node);
    for (int y = std::max(0, 2 * at.y - 1); y < std::min(fine.height, 2 * at.y + 3); ++y)
      for (int x = std::max(0, 2 * at.x - 1); x < std::min(fine.width, 2 * at.x + 3); ++x)
        nodes.push_back(static_cast<std::uint32_t>(indexOf(fine, {x, y})));
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Decoded descended(const SequencePyramid& pyramid, const Probe& probe, std::size_t beam) {
  std::vector<Candidate> candidates;
  const SequencePyramid::Level& coarsest = pyramid.levels.back();
  for (std::size_t node = 0; node < coarsest.grid.count(); ++node)
    candidates.push_back({probe.explained(coarsest, node), static_cast<std::uint32_t>(node)});
  keepBest(candidates, beam);
  for (std::size_t l = pyramid.levels.size() - 1; l-- > 0;) {
    const SequencePyramid::Level& level = pyramid.levels[l];
    std::vector<std::uint32_t> nodes = finerNodes(candidates, pyramid.levels[l + 1].grid, level.grid);
    candidates.clear();
    for (std::uint32_t node : nodes) candidates.push_back({probe.explained(level, node), node});
    keepBest(candidates, beam);
  }
  Candidate best = *std::min_element(candidates.begin(), candidates.end());
  if (!(best.score > 0.0f)) return {};
  return {static_cast<std::int32_t>(best.node), std::sqrt(best.score), 0.0f, 0.0f};
}

}  // namespace

std::vector<Decoded> decodePixels(const DecodingInput& input, const std::vector<std::uint32_t>& pixels,
                                  int beam, Progress& progress) {
  std::vector<Decoded> decoded(input.photographs.size().count());
  parallelInParts(pixels, progress, [&](std::uint32_t pixel) {
    Probe probe(input, pixel);
    decoded[pixel] = descended(input.pyramid, probe, static_cast<std::size_t>(beam));
  });
  return decoded;
}

namespace {

/// Tries the places that neighbours in a row's predecessors suggest, and a few around the pixel's own.
class Propagation {
 public:
  Propagation(const DecodingInput& input, const CameraMask& lit) : input_(input), lit_(lit) {}

  /// Each pixel reads what the last sweep left around it and writes its own place: the same on any number of
  /// threads.
  void sweep(const std::vector<Decoded>& before, std::vector<Decoded>& after, int number,
             Progress& progress) const {
    Size camera = input_.photographs.size();
    std::vector<std::uint32_t> rows(static_cast<std::size_t>(camera.height));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = static_cast<std::uint32_t>(y);
    parallelInParts(rows, progress, [&](std::uint32_t y) {
      for (int x = 0; x < camera.width; ++x) {
        std::size_t pixel = indexOf(camera, {x, static_cast<int>(y)});
        if (lit_[pixel] != 0) after[pixel] = improved(before, {x, static_cast<int>(y)}, number);
      }
    });
  }

 private:
  Decoded improved(const std::vector<Decoded>& before, Pixel at, int number) const {
    Size camera = input_.photographs.size();
    Size projector = input_.pyramid.levels.front().grid;
    std::size_t pixel = indexOf(camera, at);
    Decoded best = before[pixel];
    // Well explained already: neighbours can only agree.
    if (best.correlation > sufficient_) return best;
    Probe probe(input_, pixel);
    auto attempt = [&](Pixel place) {
      if (place.x < 0 || place.y < 0 || place.x >= projector.width || place.y >= projector.height) return;
      std::size_t node = indexOf(projector, place);
      float score = std::sqrt(probe.explained(input_.pyramid.levels.front(), node));
      if (score > best.correlation) best = {static_cast<std::int32_t>(node), score, 0.0f, 0.0f};
    };
    // Near neighbours and, as sweeps go on, less near ones: good places spread quickly.
    int apart = 1 << (number % 4);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        Pixel neighbour{at.x + apart * dx, at.y + apart * dy};
        if (neighbour.x < 0 || neighbour.y < 0 || neighbour.x >= camera.width || neighbour.y >= camera.height)
          continue;
        const Decoded& there = before[indexOf(camera, neighbour)];
        if (there.pixel < 0) continue;
        Pixel place = pixelAt(projector, static_cast<std::size_t>(there.pixel));
        attempt(place);
        attempt({place.x - apart * dx, place.y - apart * dy});
      }
    if (best.pixel >= 0) {
      Pixel place = pixelAt(projector, static_cast<std::size_t>(best.pixel));
      Random random{static_cast<std::uint64_t>(number), pixel};
      for (int radius = 16; radius >= 1; radius /= 2) {
        auto offset = [&] {
          return static_cast<int>(random.below(static_cast<std::uint64_t>(2 * radius + 1))) - radius;
        };
        attempt({place.x + offset(), place.y + offset()});
      }
    }
    return best;
  }

  static constexpr float sufficient_ = 0.9f;
  const DecodingInput& input_;
  const std::vector<std::uint8_t>& lit_;
};

}  // namespace

void propagate(const DecodingInput& input, const CameraMask& lit, std::vector<Decoded>& decoded,
               Progress& progress) {
  constexpr int sweeps = 4;
  Propagation propagation(input, lit);
  std::vector<Decoded> next = decoded;
  for (int number = 0; number < sweeps; ++number) {
    Progress sweeping = progress.part(1.0 / sweeps, progress.stage());
    propagation.sweep(decoded, next, number, sweeping);
    decoded = next;
  }
}

}  // namespace relucent::importing
