// SPDX-License-Identifier: MIT
#include "relucent/compensation/seams.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/lit_by.h"
#include "relucent/image/colour.h"

namespace relucent::compensation {
namespace {

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(values.size());
}

/// Per camera pixel that a pair has, L*a*b* of the mean of it and its neighbours within the mask.
std::vector<image::Colour> smoothedLab(const CameraStack& seen, const Rasters& cameras,
                                       const CameraMask& mask, const std::array<float, 3>& white,
                                       const SeamPairs& pairs) {
  CameraMask asked(cameras.count(), 0);
  for (const auto* some : {&pairs.across, &pairs.elsewhere})
    for (const auto& [a, b] : *some) asked[a] = asked[b] = 1;
  std::vector<image::Colour> lab(cameras.count());
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const std::size_t begin = cameras.offset(camera);
    parallelFor(0, size.count(), 256, [&](std::size_t i) {
      if (asked[begin + i] == 0) return;
      const Pixel at = pixelAt(size, i);
      std::array<double, 3> sum{};
      double count = 0.0;
      for (int y = std::max(0, at.y - 1); y <= std::min(at.y + 1, size.height - 1); ++y)
        for (int x = std::max(0, at.x - 1); x <= std::min(at.x + 1, size.width - 1); ++x) {
          const std::size_t row = begin + indexOf(size, {x, y});
          if (mask[row] == 0) continue;
          for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(seen[3 * row + c]);
          count += 1.0;
        }
      image::Colour light{};
      for (std::size_t c = 0; c < 3; ++c)
        light[c] = std::clamp(sum[c] / count / static_cast<double>(white[c]), 0.0, 1.0);
      lab[begin + i] = image::labFromXyz(image::xyzFromLinearRgb(light));
    });
  }
  return lab;
}

}  // namespace

SeamPairs seamPairs(const transport::TransportMatrix& transport, const CameraMask& mask, int apart,
                    const DirectLightSettings& settings) {
  const Rasters& cameras = transport.cameras();
  require(mask.size() == cameras.count() && apart > 0, "{} flags for {} camera pixels, {} apart", mask.size(),
          cameras.count(), apart);
  const DirectLeaves direct(transport, settings);
  std::vector<std::uint64_t> projectors(cameras.count(), 0);  // a bit each
  require(transport.projectors().devices() <= 64, "{} projectors", transport.projectors().devices());
  parallelFor(0, cameras.count(), 256, [&](std::size_t row) {
    if (mask[row] == 0) return;
    const std::vector<LitBy> lit = litBy(transport, direct, row);
    for (std::size_t k = 0; k < lit.size(); ++k)
      if (lit[k].light > 0.0) projectors[row] |= std::uint64_t{1} << k;
  });
  SeamPairs pairs;
  std::map<std::tuple<std::size_t, std::uint64_t, std::uint64_t, bool, int, int>, std::size_t> stretches;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const std::size_t begin = cameras.offset(camera);
    for (std::size_t i = 0; i < size.count(); ++i) {
      const Pixel at = pixelAt(size, i);
      for (const Pixel& to : {Pixel{at.x + apart, at.y}, Pixel{at.x, at.y + apart}}) {
        if (to.x >= size.width || to.y >= size.height) continue;
        const std::size_t a = begin + i, b = begin + indexOf(size, to);
        if (mask[a] == 0 || mask[b] == 0 || projectors[a] == 0 || projectors[b] == 0) continue;
        if (projectors[a] == projectors[b]) {
          pairs.elsewhere.push_back({a, b});
          continue;
        }
        const bool turned = projectors[b] < projectors[a];
        pairs.across.push_back(turned ? std::array{b, a} : std::array{a, b});
        constexpr int length = 8;
        pairs.stretch.push_back(stretches
                                    .try_emplace({camera, std::min(projectors[a], projectors[b]),
                                                  std::max(projectors[a], projectors[b]), to.x == at.x,
                                                  at.x / length, at.y / length},
                                                 stretches.size())
                                    .first->second);
      }
    }
  }
  return pairs;
}

namespace {

double percentile95(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  return values[(values.size() - 1) * 95 / 100];
}

/// Of every pair across, between the means of both sides of its stretch.
std::vector<double> alongEdges(const std::vector<image::Colour>& lab, const SeamPairs& pairs) {
  struct Stretch {
    image::Colour one{}, other{};
    double count = 0.0;
  };
  std::vector<Stretch> stretches(pairs.across.size());
  for (std::size_t i = 0; i < pairs.across.size(); ++i) {
    Stretch& stretch = stretches[pairs.stretch[i]];
    for (std::size_t c = 0; c < 3; ++c) {
      stretch.one[c] += lab[pairs.across[i][0]][c];
      stretch.other[c] += lab[pairs.across[i][1]][c];
    }
    stretch.count += 1.0;
  }
  std::vector<double> differences;
  for (std::size_t of : pairs.stretch) {
    Stretch stretch = stretches[of];
    for (std::size_t c = 0; c < 3; ++c) {
      stretch.one[c] /= stretch.count;
      stretch.other[c] /= stretch.count;
    }
    differences.push_back(image::ciede2000(stretch.one, stretch.other));
  }
  return differences;
}

}  // namespace

Seams seamsOf(const CameraStack& seen, const Rasters& cameras, const CameraMask& mask,
              const std::array<float, 3>& white, const SeamPairs& pairs) {
  const std::vector<image::Colour> lab = smoothedLab(seen, cameras, mask, white, pairs);
  const auto apart = [&](const std::vector<std::array<std::size_t, 2>>& all) {
    std::vector<double> differences;
    differences.reserve(all.size());
    for (const auto& [a, b] : all) differences.push_back(image::ciede2000(lab[a], lab[b]));
    return differences;
  };
  const std::vector<double> across = apart(pairs.across), elsewhere = apart(pairs.elsewhere);
  return {meanOf(across), percentile95(across), meanOf(elsewhere), percentile95(elsewhere),
          percentile95(alongEdges(lab, pairs))};
}

}  // namespace relucent::compensation
