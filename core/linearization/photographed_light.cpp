// SPDX-License-Identifier: MIT
#include "relucent/linearization/photographed_light.h"

#include <algorithm>
#include <cmath>

namespace relucent::linearization {
namespace {

constexpr double leastLight = 0.02;  // of the 99th percentile of white, of values that are evaluated

/// Values that white raises by more than noise could.
std::vector<bool> litBy(const hdr::HdrFrame& white, const hdr::HdrFrame& black) {
  std::vector<float> rise(white.radiance.size());
  for (std::size_t i = 0; i < rise.size(); ++i) rise[i] = white.radiance[i] - black.radiance[i];
  std::vector<float> sorted = rise;
  auto high = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
  std::nth_element(sorted.begin(), high, sorted.end());
  std::vector<bool> lit;
  for (std::size_t i = 0; i < rise.size(); ++i) {
    double light = rise[i], noise = std::sqrt(static_cast<double>(white.variance[i] + black.variance[i]));
    lit.push_back(light > leastLight * static_cast<double>(*high) && light > 5.0 * noise);
  }
  return lit;
}

}  // namespace

double PhotographedLight::whiteVariance(std::size_t value) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < lit.size(); ++p) sum += variance[order.white(p)][value];
  return sum;
}

PhotographedLight photographedLight(const MosaicPhotographs& photographs,
                                    const std::vector<hdr::CameraModel>& cameras, const Rasters& rasters,
                                    Progress& progress) {
  std::vector<hdr::HdrFrame> frames;
  for (const rig::Shot& shot : photographs.shots) {
    frames.push_back(hdr::mergeBracket(shot, cameras, rasters));
    progress.report(static_cast<double>(frames.size()) / static_cast<double>(photographs.shots.size()));
  }
  const hdr::HdrFrame before = hdr::mergeBracket(photographs.blackBefore, cameras, rasters),
                      after = photographs.blackAfter.frames.empty()
                                  ? before
                                  : hdr::mergeBracket(photographs.blackAfter, cameras, rasters);
  const double begin = photographs.blackBefore.id.number,
               end = std::max<double>(begin + 1.0, photographs.blackAfter.id.number);

  const MosaicOrder order = photographs.order();
  // While they are being taken, some projectors' own are still missing.
  const std::size_t projectors = std::min(photographs.drives.size(), frames.size() / order.own());
  std::vector<std::vector<bool>> lit;
  for (std::size_t p = 0; p < projectors; ++p) lit.push_back(litBy(frames[order.white(p)], before));

  PhotographedLight lights{order, {}, {}, {}, {}};
  lights.lit.resize(projectors);
  for (std::size_t i = 0; i < before.valid.size(); ++i) {
    bool usable = before.valid[i] != 0;
    for (const hdr::HdrFrame& frame : frames) usable = usable && frame.valid[i] != 0;
    if (!usable || std::ranges::none_of(lit, [i](const std::vector<bool>& by) { return by[i]; })) continue;
    lights.at.push_back(i);
    for (std::size_t p = 0; p < projectors; ++p) lights.lit[p].push_back(lit[p][i]);
  }
  for (std::size_t m = 0; m < frames.size(); ++m) {
    double share = std::clamp((photographs.what[m].time - begin) / (end - begin), 0.0, 1.0);
    std::vector<double>& light = lights.light.emplace_back();
    std::vector<double>& variance = lights.variance.emplace_back();
    for (std::size_t i : lights.at) {
      double last = after.valid[i] != 0 ? static_cast<double>(after.radiance[i])
                                        : static_cast<double>(before.radiance[i]);
      double black = static_cast<double>(before.radiance[i]);
      black += share * (last - black);
      light.push_back(static_cast<double>(frames[m].radiance[i]) - black);
      variance.push_back(static_cast<double>(frames[m].variance[i]));
    }
  }
  return lights;
}

LightProducts productsOf(const PhotographedLight& lights, const std::function<bool(std::size_t)>& wanted) {
  LightProducts products(lights.light.size());
  std::vector<double> light(lights.light.size()), variance(lights.light.size());
  for (std::size_t i = 0; i < lights.at.size(); ++i) {
    if (!wanted(lights.at[i])) continue;
    for (std::size_t m = 0; m < light.size(); ++m) {
      light[m] = lights.light[m][i];
      variance[m] = lights.variance[m][i];
    }
    products.add(light, variance, 1.0 / lights.whiteVariance(i));
  }
  return products;
}

}  // namespace relucent::linearization
