// SPDX-License-Identifier: MIT
#include "relucent/importing/sequences.h"

#include <algorithm>
#include <cmath>

namespace relucent::importing {

bool isBinary(const PictureSequence& patterns, int picture) {
  for (std::size_t pixel = 0; pixel < patterns.size().count(); ++pixel)
    for (int c = 0; c < 3; ++c)
      if (int code = patterns.code(pixel, picture, c); code != 0 && code != 65535) return false;
  return true;
}

double finenessOf(const PictureSequence& patterns, int picture) {
  Size size = patterns.size();
  int channels = patterns.isColoured() ? 3 : 1;
  std::vector<double> rows(static_cast<std::size_t>(size.height));
  parallelFor(0, rows.size(), 8, [&](std::size_t row) {
    int y = static_cast<int>(row);
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < channels; ++c) {
        int here = patterns.code(indexOf(size, {x, y}), picture, c);
        if (x + 1 < size.width)
          rows[row] += std::abs(here - patterns.code(indexOf(size, {x + 1, y}), picture, c));
        if (y + 1 < size.height)
          rows[row] += std::abs(here - patterns.code(indexOf(size, {x, y + 1}), picture, c));
      }
  });
  double sum = 0.0;
  for (double row : rows) sum += row;
  return sum / static_cast<double>(size.count() * static_cast<std::size_t>(channels));
}

std::vector<int> byFineness(const PictureSequence& patterns) {
  std::vector<std::pair<double, int>> ranked;
  for (int k = 0; k < patterns.pictures(); ++k)
    if (double fineness = finenessOf(patterns, k); fineness > 0.0) ranked.emplace_back(fineness, k);
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> order;
  for (const auto& [fineness, k] : ranked) order.push_back(k);
  return order;
}

ImportFrames chooseFrames(const PictureSequence& patterns, const PictureSequence& photographs,
                          std::vector<int> heldOut) {
  ImportFrames frames;
  frames.heldOut = std::move(heldOut);
  std::vector<int> spatial = byFineness(patterns);
  std::sort(spatial.begin(), spatial.end());
  auto held = [&](int k) { return std::binary_search(frames.heldOut.begin(), frames.heldOut.end(), k); };
  bool coloured = false;
  for (int k = 0; k < patterns.pictures(); ++k)
    if (!held(k)) frames.fitted.push_back(k);
  for (int k : spatial)
    if (!held(k)) {
      frames.spatial.push_back(k);
      coloured = coloured || patterns.isColoured(k);
    }
  frames.channels = coloured && photographs.isColoured() ? 3 : 1;
  return frames;
}

DriveTable::DriveTable(const linearization::ProjectorResponse& response) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t code = 0; code < 256; ++code)
      table_[c][code] = static_cast<float>(response.channels[c](static_cast<double>(code) / 255.0));
}

namespace {

SequencePyramid::Level pixelLevel(const PictureSequence& patterns, const ImportFrames& frames,
                                  const DriveTable& drive) {
  SequencePyramid::Level level;
  level.grid = patterns.size();
  auto samples = static_cast<std::size_t>(frames.samples());
  level.values.resize(level.grid.count() * samples);
  parallelFor(0, level.grid.count(), 1024, [&](std::size_t pixel) {
    float* value = level.values.data() + pixel * samples;
    for (int k : frames.spatial) {
      std::array<float, 3> linear;
      for (int c = 0; c < 3; ++c) linear[static_cast<std::size_t>(c)] = drive(patterns.code(pixel, k, c), c);
      if (frames.channels == 3)
        value = std::copy(linear.begin(), linear.end(), value);
      else
        *value++ = (linear[0] + linear[1] + linear[2]) / 3.0f;
    }
  });
  return level;
}

SequencePyramid::Level coarserLevel(const SequencePyramid::Level& fine, std::size_t samples) {
  SequencePyramid::Level level;
  level.grid = {(fine.grid.width + 1) / 2, (fine.grid.height + 1) / 2};
  level.values.assign(level.grid.count() * samples, 0.0f);
  parallelFor(0, level.grid.count(), 256, [&](std::size_t node) {
    Pixel at = pixelAt(level.grid, node);
    float* sum = level.values.data() + node * samples;
    int x1 = std::min(2 * at.x + 2, fine.grid.width), y1 = std::min(2 * at.y + 2, fine.grid.height);
    for (int y = 2 * at.y; y < y1; ++y)
      for (int x = 2 * at.x; x < x1; ++x) {
        const float* child = fine.values.data() + indexOf(fine.grid, {x, y}) * samples;
        for (std::size_t s = 0; s < samples; ++s) sum[s] += child[s];
      }
    float share = 1.0f / static_cast<float>((x1 - 2 * at.x) * (y1 - 2 * at.y));
    for (std::size_t s = 0; s < samples; ++s) sum[s] *= share;
  });
  return level;
}

void addNorms(SequencePyramid::Level& level, int frameCount, int channels) {
  // Below this spread, root mean square, rounding and noise decide what a sequence looks like.
  constexpr float leastSpread = 0.01f;
  auto width = static_cast<std::size_t>(channels);
  auto frames = static_cast<std::size_t>(frameCount);
  level.inverseNorm.resize(level.grid.count() * width);
  parallelFor(0, level.grid.count(), 1024, [&](std::size_t node) {
    const float* value = level.values.data() + node * frames * width;
    for (std::size_t c = 0; c < width; ++c) {
      float mean = 0.0f, square = 0.0f;
      for (std::size_t k = 0; k < frames; ++k) mean += value[k * width + c];
      mean /= static_cast<float>(frames);
      for (std::size_t k = 0; k < frames; ++k) square += std::pow(value[k * width + c] - mean, 2.0f);
      bool varies = square > leastSpread * leastSpread * static_cast<float>(frames);
      level.inverseNorm[node * width + c] = varies ? 1.0f / std::sqrt(square) : 0.0f;
    }
  });
}

}  // namespace

SequencePyramid sequencePyramid(const PictureSequence& patterns, const ImportFrames& frames,
                                const DriveTable& drive) {
  // The coarsest level is searched as a whole.
  constexpr std::size_t mostCoarsest = 256;
  SequencePyramid pyramid;
  pyramid.samples = frames.samples();
  pyramid.channels = frames.channels;
  pyramid.levels.push_back(pixelLevel(patterns, frames, drive));
  while (pyramid.levels.back().grid.count() > mostCoarsest)
    pyramid.levels.push_back(coarserLevel(pyramid.levels.back(), static_cast<std::size_t>(pyramid.samples)));
  for (SequencePyramid::Level& level : pyramid.levels)
    addNorms(level, static_cast<int>(frames.spatial.size()), frames.channels);
  return pyramid;
}

void readSequence(const PictureSequence& photographs, const ImportFrames& frames, std::size_t pixel,
                  CameraSequence& sequence) {
  sequence.value.clear();
  sequence.weight.clear();
  for (int k : frames.spatial) {
    float largest = 0.0f;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, photographs.value(pixel, k, c));
    for (int c = 0; c < frames.channels; ++c) {
      float value = frames.channels == 3 ? photographs.value(pixel, k, c) : photographs.grey(pixel, k);
      sequence.value.push_back(value);
      sequence.weight.push_back((frames.channels == 3 ? value : largest) < importSaturation ? 1.0f : 0.0f);
    }
  }
}

CameraMask litPixels(const PictureSequence& photographs, const ImportFrames& frames) {
  constexpr float leastShare = 0.1f;
  std::size_t pixels = photographs.size().count();
  std::vector<float> span(pixels);
  parallelFor(0, pixels, 1024, [&](std::size_t pixel) {
    float least = 1e30f, most = 0.0f;
    for (int frame : frames.fitted) {
      float value = photographs.grey(pixel, frame);
      least = std::min(least, value);
      most = std::max(most, value);
    }
    span[pixel] = most - least;
  });
  std::vector<float> sorted = span;
  auto p95 = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 95 / 100);
  std::nth_element(sorted.begin(), p95, sorted.end());
  CameraMask lit(pixels);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    lit[pixel] = span[pixel] > 0.0f && span[pixel] >= leastShare * *p95;
  return lit;
}

}  // namespace relucent::importing
