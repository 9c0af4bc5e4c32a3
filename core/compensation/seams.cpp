// SPDX-License-Identifier: MIT
#include "relucent/compensation/seams.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

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

/// Per camera pixel of the mask, L*a*b* of the mean of it and its neighbours.
std::vector<image::Colour> smoothedLab(const CameraStack& seen, const Rasters& cameras,
                                       const CameraMask& mask, const std::array<float, 3>& white) {
  std::vector<image::Colour> lab(cameras.count());
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const std::size_t begin = cameras.offset(camera);
    parallelFor(0, size.count(), 256, [&](std::size_t i) {
      if (mask[begin + i] == 0) return;
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
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const std::size_t begin = cameras.offset(camera);
    for (std::size_t i = 0; i < size.count(); ++i) {
      const Pixel at = pixelAt(size, i);
      for (const Pixel& to : {Pixel{at.x + apart, at.y}, Pixel{at.x, at.y + apart}}) {
        if (to.x >= size.width || to.y >= size.height) continue;
        const std::size_t a = begin + i, b = begin + indexOf(size, to);
        if (mask[a] == 0 || mask[b] == 0 || projectors[a] == 0 || projectors[b] == 0) continue;
        (projectors[a] != projectors[b] ? pairs.across : pairs.elsewhere).push_back({a, b});
      }
    }
  }
  return pairs;
}

Seams seamsOf(const CameraStack& seen, const Rasters& cameras, const CameraMask& mask,
              const std::array<float, 3>& white, const SeamPairs& pairs) {
  const std::vector<image::Colour> lab = smoothedLab(seen, cameras, mask, white);
  const auto apart = [&](const std::vector<std::array<std::size_t, 2>>& all) {
    std::vector<double> differences;
    differences.reserve(all.size());
    for (const auto& [a, b] : all) differences.push_back(image::ciede2000(lab[a], lab[b]));
    return differences;
  };
  std::vector<double> across = apart(pairs.across);
  Seams seams{meanOf(across), std::numeric_limits<double>::quiet_NaN(), meanOf(apart(pairs.elsewhere))};
  if (!across.empty()) {
    std::ranges::sort(across);
    seams.p95 = across[(across.size() - 1) * 95 / 100];
  }
  return seams;
}

}  // namespace relucent::compensation
