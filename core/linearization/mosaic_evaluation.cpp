// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic_evaluation.h"

#include <algorithm>
#include <cmath>

#include "relucent/hdr/isotonic.h"
#include "relucent/linearization/mosaic_additivity.h"
#include "relucent/linearization/photographed_light.h"

namespace relucent::linearization {
namespace {

constexpr double fewestInRegion = 60.0;  // values
constexpr double leastPart = 0.15;       // of the light of all projectors
constexpr double certain = 6.0;          // deviations

hdr::ResponseCurve curveOf(const std::vector<double>& drives, const std::vector<double>& light,
                           const std::vector<double>& deviation) {
  std::vector<double> x{0.0}, y{0.0}, weights{0.0};
  double most = 0.0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    x.push_back(drives[i]);
    y.push_back(light[i]);
    weights.push_back(1.0 / std::pow(std::max(deviation[i], 1e-7), 2.0));
    if (i + 1 < drives.size()) most = std::max(most, weights.back());
  }
  // Black is the zero and full drive the one by definition, not by measurements.
  weights.front() = weights.back() = 100.0 * std::max(most, 1.0);
  return hdr::curveFromRamp(x, y, weights);
}

/// A projector's white in one region.
struct RegionLight {
  double values = 0.0;  // that it lights
  double light = 0.0;
};

std::vector<RegionLight> regionLights(const PhotographedLight& lights, std::size_t projector,
                                      const Thinning& thinning) {
  std::vector<RegionLight> regions(thinning.regions());
  for (std::size_t i = 0; i < lights.at.size(); ++i) {
    RegionLight& region = regions[thinning.regionOf(lights.at[i] / 3)];
    region.light += lights.light[whitePhotograph(projector)][i];
    if (lights.lit[projector][i]) region.values += 1.0;
  }
  return regions;
}

/// Whether a projector lights regions [first, end) enough to tell its response from what is not exactly known
/// of the others'. `lights`: [projector][region].
bool shinesIn(const std::vector<std::vector<RegionLight>>& lights, std::size_t projector, std::size_t first,
              std::size_t end) {
  double values = 0.0, own = 0.0, all = 0.0;
  for (std::size_t region = first; region < end; ++region) {
    values += lights[projector][region].values;
    own += lights[projector][region].light;
    for (const std::vector<RegionLight>& each : lights) all += each[region].light;
  }
  return values >= fewestInRegion && own >= leastPart * all;
}

}  // namespace

std::vector<MosaicResult> evaluateMosaics(const MosaicPhotographs& photographs,
                                          const std::vector<hdr::CameraModel>& cameras,
                                          const Thinning& thinning) {
  const PhotographedLight lights = photographedLight(photographs, cameras, thinning.rasters());
  std::vector<LightProducts> regions;
  for (std::size_t region = 0; region < thinning.regions(); ++region)
    regions.push_back(
        productsOf(lights, [&](std::size_t at) { return thinning.regionOf(at / 3) == region; }));
  auto sumOf = [&](std::size_t first, std::size_t end) {
    LightProducts sum(photographs.what.size());
    for (std::size_t region = first; region < end; ++region) sum += regions[region];
    return sum;
  };

  const ShownLevels shown = shownLevels(photographs);
  const std::vector<ResponseFit> fits =
      fitResponses(shown.drives, shown.what, sumOf(0, regions.size()), usualResponses(shown.drives));
  std::vector<LevelLights> found;
  std::vector<std::vector<RegionLight>> white;
  std::vector<MosaicResult> results(fits.size());
  const std::vector<Additivity> additivity = additivitiesOf(photographs, lights, fits);
  for (std::size_t p = 0; p < fits.size(); ++p) {
    found.push_back(fits[p].light);
    white.push_back(regionLights(lights, p, thinning));
    results[p].additivity = additivity[p];
    for (std::size_t c = 0; c < 3; ++c)
      results[p].response.channels[c] = curveOf(shown.drives[p], fits[p].light[c], fits[p].deviation[c]);
  }

  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    const LightProducts seen = sumOf(9 * camera, 9 * camera + 9);
    std::vector<ResponseFit> own = fits;
    if (cameras.size() > 1 && seen.values() >= fewestInRegion)
      own = fitResponses(shown.drives, shown.what, seen, found);
    for (std::size_t p = 0; p < fits.size(); ++p) {
      const bool enough = shinesIn(white, p, 9 * camera, 9 * camera + 9);
      results[p].flicker.push_back(enough ? own[p].flicker : fits[p].flicker);
    }
  }
  for (std::size_t region = 0; region < regions.size(); ++region) {
    if (regions[region].values() < fewestInRegion) continue;
    const std::vector<RegionDeviation> deviations = deviationsOf(fits, shown.what, regions[region]);
    for (std::size_t p = 0; p < fits.size(); ++p) {
      if (!shinesIn(white, p, region, region + 1)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(deviations[p].amplitude[c]) > certain * deviations[p].deviation[c])
          results[p].unevenness = std::max(results[p].unevenness, std::abs(deviations[p].amplitude[c]));
    }
  }
  return results;
}

}  // namespace relucent::linearization
