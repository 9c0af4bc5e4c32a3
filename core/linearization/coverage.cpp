// SPDX-License-Identifier: MIT
#include "relucent/linearization/coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "relucent/base/error.h"
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

/// One camera's pixels while the stripes of a projector are shown.
struct Following {
  std::vector<float> black{};
  float floor = 0.0f;
  std::vector<int> column{}, row{};                         // Gray codes
  std::vector<std::uint8_t> follows{};                      // every stripe so far
  std::vector<std::uint8_t> missedColumns{}, missedRows{};  // how many stripes it does not follow

  explicit Following(std::vector<float> dark, float least)
      : black(std::move(dark)),
        floor(least),
        column(black.size(), 0),
        row(black.size(), 0),
        follows(black.size(), 1),
        missedColumns(black.size(), 0),
        missedRows(black.size(), 0) {}

  void learn(const std::vector<float>& shown, const std::vector<float>& inverted, const Stripes& stripes) {
    std::vector<int>& code = stripes.rows ? row : column;
    for (std::size_t i = 0; i < black.size(); ++i) {
      const float apart = shown[i] - inverted[i], all = shown[i] + inverted[i] - 2.0f * black[i];
      if (!(std::abs(apart) > std::max(floor, modulation * all))) {
        follows[i] = 0;
        ++(stripes.rows ? missedRows : missedColumns)[i];
      }
      // Cells whose bit is 0 are lit by the stripes themselves.
      if (apart < 0.0f) code[i] |= 1 << stripes.bit;
    }
  }

  /// At the edge of two cells one stripe ends, of columns and of rows, and no more: such is Gray code.
  /// Of few stripes, what follows all but one might be scattered.
  bool isLit(std::size_t pixel, int columnBits, int rowBits) const {
    constexpr int enough = 3;
    return missedColumns[pixel] <= (columnBits >= enough ? 1 : 0) &&
           missedRows[pixel] <= (rowBits >= enough ? 1 : 0);
  }

  Coverage seenOf(Size cells) const {
    std::vector<int> pixels(cells.count(), 0);
    for (std::size_t i = 0; i < follows.size(); ++i)
      if (follows[i] != 0) ++pixels[indexOf(cells, {numberOf(column[i]), numberOf(row[i])})];
    std::vector<int> some;
    for (int count : pixels)
      if (count > 0) some.push_back(count);
    std::ranges::sort(some);
    const double usual = some.empty() ? 0.0 : some[some.size() / 2];
    Coverage coverage{cells, {}};
    for (int count : pixels) coverage.seen.push_back(count > 0 && count >= leastOfUsual * usual ? 1 : 0);
    return coverage;
  }
};

/// At one projector.
class Looking {
 public:
  Looking(rig::ShotTaker& shots, std::size_t projector, double exposure, const Progress& progress)
      : shots_(shots), projector_(projector), exposure_(exposure), progress_(progress) {}

  void run(RigCoverage& result) {
    const Size picture = shots_.rig().projectors[projector_]->size();
    Size camera = shots_.rig().cameras.front()->size();
    for (const auto& other : shots_.rig().cameras)
      camera = {std::min(camera.width, other->size().width), std::min(camera.height, other->size().height)};
    const int columnBits = bitsFor(picture.width, camera.width),
              rowBits = bitsFor(picture.height, camera.height);
    const Size cells{1 << columnBits, 1 << rowBits};
    const rig::Shot dark = photographed(image::Image(picture, 3, 0.0f));
    for (const rig::RawFrame& frame : dark.frames.front()) {
      const double step = frame.bits > 0 ? 1.0 / (std::ldexp(1.0, frame.bits) - 1.0) : 0.0;
      cameras_.emplace_back(lightOf(frame.signal),
                            std::max(leastSignal, static_cast<float>(leastCodes * step)));
    }
    for (int bit = 0; bit < columnBits; ++bit) follow(picture, cells, {false, bit});
    for (int bit = 0; bit < rowBits; ++bit) follow(picture, cells, {true, bit});
    std::vector<Coverage>& coverages = result.coverages.emplace_back();
    result.litBy.resize(cameras_.size());
    for (std::size_t number = 0; number < cameras_.size(); ++number) {
      coverages.push_back(cameras_[number].seenOf(cells));
      std::vector<std::uint32_t>& lit = result.litBy[number];
      lit.resize(cameras_[number].follows.size());
      for (std::size_t i = 0; i < lit.size(); ++i)
        if (cameras_[number].isLit(i, columnBits, rowBits)) lit[i] |= std::uint32_t{1} << projector_;
    }
  }

 private:
  rig::Shot photographed(const image::Image& pattern) {
    std::vector<image::Image> patterns = evenPatterns(shots_.rig(), {0, 0, 0});
    patterns[projector_] = pattern;
    return shots_.take(patterns, {exposure_}, progress_);
  }

  void follow(Size picture, Size cells, const Stripes& stripes) {
    const rig::Shot shown = photographed(stripesOf(picture, cells, stripes, false)),
                    inverted = photographed(stripesOf(picture, cells, stripes, true));
    for (std::size_t camera = 0; camera < cameras_.size(); ++camera)
      cameras_[camera].learn(lightOf(shown.frames.front()[camera].signal),
                             lightOf(inverted.frames.front()[camera].signal), stripes);
  }

  rig::ShotTaker& shots_;
  std::size_t projector_;
  double exposure_;
  const Progress& progress_;
  std::vector<Following> cameras_;
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

std::vector<Coverage> RigCoverage::byAnyCamera() const {
  std::vector<Coverage> all;
  for (const std::vector<Coverage>& cameras : coverages) {
    Coverage& any = all.emplace_back(cameras.front());
    for (const Coverage& camera : cameras)
      for (std::size_t cell = 0; cell < any.seen.size(); ++cell) any.seen[cell] |= camera.seen[cell];
  }
  return all;
}

std::vector<double> RigCoverage::overlaps(std::size_t camera) const {
  std::vector<double> shares(coverages.size(), 0.0);
  double lit = 0.0;
  for (std::uint32_t projectors : litBy[camera]) {
    if (projectors == 0) continue;
    shares[static_cast<std::size_t>(std::popcount(projectors)) - 1] += 1.0;
    lit += 1.0;
  }
  if (!(lit > 0.0)) return {};
  for (double& share : shares) share /= lit;
  return shares;
}

RigCoverage coverageOf(rig::ShotTaker& shots, double exposure, Progress& progress) {
  RigCoverage result;
  const std::size_t projectors = shots.rig().projectors.size();
  require(projectors <= 32, "{} projectors", projectors);
  for (std::size_t projector = 0; projector < projectors; ++projector) {
    Looking(shots, projector, exposure, progress).run(result);
    progress.report(static_cast<double>(projector + 1) / static_cast<double>(projectors));
  }
  return result;
}

}  // namespace relucent::linearization
