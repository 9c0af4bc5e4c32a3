// SPDX-License-Identifier: MIT
#include "relucent/linearization/coverage.h"

#include <algorithm>
#include <cmath>

#include "relucent/linearization/test_light.h"

namespace relucent::linearization {
namespace {

constexpr int mostBits = 4;
constexpr int leastSide = 8;           // of a cell, pixels
constexpr float modulation = 0.4f;     // of the light of a camera pixel, stripes against inverted ones
constexpr double leastCodes = 3.0;     // of the camera, to be light
constexpr float leastSignal = 0.006f;  // of full scale
constexpr double leastOfUsual = 0.1;   // of the pixels that see a cell usually

int bitsFor(int projector, int camera) {
  int bits = 1;
  while (bits < mostBits && std::min(projector, camera) >> (bits + 1) >= leastSide) ++bits;
  return bits;
}

int grayOf(int number) {
  return number ^ (number >> 1);
}

/// One bit of the column's or the row's code.
struct Stripes {
  bool rows = false;
  int bit = 0;
};

image::Image stripesOf(Size picture, Size cells, const Stripes& stripes, bool inverted) {
  image::Image pattern(picture, 3, 0.0f);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const int cell = stripes.rows ? y * cells.height / picture.height : x * cells.width / picture.width;
      if (((grayOf(cell) >> stripes.bit) & 1) != (inverted ? 1 : 0)) continue;
      for (std::size_t c = 0; c < 3; ++c) pattern.pixel(indexOf(picture, {x, y}))[c] = 1.0f;
    }
  return pattern;
}

/// All channels together.
std::vector<float> lightOf(const image::Image& signal) {
  std::vector<float> light(signal.pixels());
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = (signal.pixel(i)[0] + signal.pixel(i)[1] + signal.pixel(i)[2]) / 3.0f;
  return light;
}

int numberOf(int gray) {
  int number = 0;
  for (; gray > 0; gray >>= 1) number ^= gray;
  return number;
}

double missingOf(const Coverage& coverage, bool isColumn, int at) {
  const int count = isColumn ? coverage.cells.height : coverage.cells.width;
  int missing = 0;
  for (int i = 0; i < count; ++i) {
    const Pixel cell = isColumn ? Pixel{at, i} : Pixel{i, at};
    missing += coverage.seen[indexOf(coverage.cells, cell)] == 0 ? 1 : 0;
  }
  return static_cast<double>(missing) / count;
}

/// Of one projector.
class Looking {
 public:
  Looking(rig::ShotTaker& shots, std::size_t projector, double exposure, const Progress& progress)
      : shots_(shots), projector_(projector), exposure_(exposure), progress_(progress) {}

  Coverage run() {
    const Size picture = shots_.rig().projectors[projector_]->size();
    const Size camera = shots_.rig().cameras.front()->size();
    const int columnBits = bitsFor(picture.width, camera.width),
              rowBits = bitsFor(picture.height, camera.height);
    const Size cells{1 << columnBits, 1 << rowBits};
    const std::vector<float> black = photographed(image::Image(picture, 3, 0.0f));
    column_.assign(black.size(), 0);
    row_.assign(black.size(), 0);
    follows_.assign(black.size(), 1);
    for (int bit = 0; bit < columnBits; ++bit) follow(picture, cells, {false, bit}, black, column_);
    for (int bit = 0; bit < rowBits; ++bit) follow(picture, cells, {true, bit}, black, row_);
    return seenOf(cells);
  }

 private:
  std::vector<float> photographed(const image::Image& pattern) {
    std::vector<image::Image> patterns = evenPatterns(shots_.rig(), {0, 0, 0});
    patterns[projector_] = pattern;
    const rig::Shot shot = shots_.take(patterns, {exposure_}, progress_);
    const rig::RawFrame& frame = shot.frames.front().front();
    const double step = frame.bits > 0 ? 1.0 / (std::ldexp(1.0, frame.bits) - 1.0) : 0.0;
    floor_ = std::max(leastSignal, static_cast<float>(leastCodes * step));
    return lightOf(frame.signal);
  }

  void follow(Size picture, Size cells, const Stripes& stripes, const std::vector<float>& black,
              std::vector<int>& code) {
    const std::vector<float> shown = photographed(stripesOf(picture, cells, stripes, false)),
                             inverted = photographed(stripesOf(picture, cells, stripes, true));
    for (std::size_t i = 0; i < black.size(); ++i) {
      const float apart = shown[i] - inverted[i], all = shown[i] + inverted[i] - 2.0f * black[i];
      if (!(std::abs(apart) > std::max(floor_, modulation * all))) follows_[i] = 0;
      // Cells whose bit is 0 are lit by the stripes themselves.
      if (apart < 0.0f) code[i] |= 1 << stripes.bit;
    }
  }

  Coverage seenOf(Size cells) const {
    std::vector<int> pixels(cells.count(), 0);
    for (std::size_t i = 0; i < follows_.size(); ++i)
      if (follows_[i] != 0) ++pixels[indexOf(cells, {numberOf(column_[i]), numberOf(row_[i])})];
    std::vector<int> some;
    for (int count : pixels)
      if (count > 0) some.push_back(count);
    std::ranges::sort(some);
    const double usual = some.empty() ? 0.0 : some[some.size() / 2];
    Coverage coverage{cells, {}};
    for (int count : pixels) coverage.seen.push_back(count > 0 && count >= leastOfUsual * usual ? 1 : 0);
    return coverage;
  }

  rig::ShotTaker& shots_;
  std::size_t projector_;
  double exposure_;
  const Progress& progress_;
  float floor_ = 0.0f;
  std::vector<int> column_, row_;      // Gray codes
  std::vector<std::uint8_t> follows_;  // every stripe so far
};

}  // namespace

double Coverage::share() const {
  const auto count = std::ranges::count_if(seen, [](std::uint8_t cell) { return cell != 0; });
  return seen.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(seen.size());
}

double Coverage::missingLeft() const {
  return missingOf(*this, true, 0);
}
double Coverage::missingRight() const {
  return missingOf(*this, true, cells.width - 1);
}
double Coverage::missingTop() const {
  return missingOf(*this, false, 0);
}
double Coverage::missingBottom() const {
  return missingOf(*this, false, cells.height - 1);
}

std::vector<Coverage> coverageOf(rig::ShotTaker& shots, double exposure, Progress& progress) {
  std::vector<Coverage> coverages;
  const std::size_t projectors = shots.rig().projectors.size();
  for (std::size_t projector = 0; projector < projectors; ++projector) {
    coverages.push_back(Looking(shots, projector, exposure, progress).run());
    progress.report(static_cast<double>(projector + 1) / static_cast<double>(projectors));
  }
  return coverages;
}

}  // namespace relucent::linearization
