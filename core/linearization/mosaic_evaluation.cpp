// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic_evaluation.h"

#include <algorithm>
#include <cmath>
#include <span>

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

/// Of dark, then of every level.
std::vector<LevelResidual> residualsOf(const hdr::ResponseCurve& curve, const std::vector<double>& drives,
                                       const std::vector<double>& light,
                                       const std::vector<double>& residual) {
  std::vector<LevelResidual> residuals{{0.0, 0.0}};
  for (std::size_t i = 0; i < drives.size(); ++i)
    residuals.push_back({drives[i], light[i] + residual[i] - curve(drives[i])});
  return residuals;
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
    region.light += lights.light[lights.order.white(projector)][i];
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

/// Of every region of every camera.
std::vector<LightProducts> regionProducts(const PhotographedLight& lights, const Thinning& thinning,
                                          Progress& progress) {
  std::vector<LightProducts> products;
  for (std::size_t region = 0; region < thinning.regions(); ++region) {
    products.push_back(
        productsOf(lights, [&](std::size_t at) { return thinning.regionOf(at / 3) == region; }));
    progress.report(static_cast<double>(products.size()) / static_cast<double>(thinning.regions()));
  }
  return products;
}

LightProducts sumOf(std::span<const LightProducts> products) {
  LightProducts sum(products.front().shots());
  for (const LightProducts& each : products) sum += each;
  return sum;
}

/// What is known of all projectors when parts of the cameras' pictures are looked at.
struct Whole {
  ShownLevels shown;
  std::vector<ResponseFit> fits;
  std::vector<std::vector<RegionLight>> white;  // [projector][region]
};

/// As each camera sees it, or all of them where one sees too little.
void addFlicker(std::vector<MosaicResult>& results, const Whole& whole,
                const std::vector<LightProducts>& regions, Progress& progress) {
  const std::size_t cameras = regions.size() / Thinning::regionsOfCamera;
  std::vector<LevelLights> found;
  for (const ResponseFit& fit : whole.fits) found.push_back(fit.light);
  for (std::size_t camera = 0; camera < cameras; ++camera) {
    Progress fitting = progress.part(1.0 / static_cast<double>(cameras), progress.stage());
    const std::size_t first = Thinning::regionsOfCamera * camera, end = first + Thinning::regionsOfCamera;
    const LightProducts seen = sumOf(std::span(regions).subspan(first, end - first));
    std::vector<ResponseFit> own = whole.fits;
    if (cameras > 1 && seen.values() >= fewestInRegion)
      own = fitResponses(whole.shown.drives, whole.shown.what, seen, found, fitting);
    for (std::size_t p = 0; p < results.size(); ++p)
      results[p].flicker.push_back(shinesIn(whole.white, p, first, end) ? own[p].flicker
                                                                        : whole.fits[p].flicker);
  }
}

void addUnevenness(std::vector<MosaicResult>& results, const Whole& whole,
                   const std::vector<LightProducts>& regions, Progress& progress) {
  for (std::size_t region = 0; region < regions.size(); ++region) {
    progress.report(static_cast<double>(region) / static_cast<double>(regions.size()));
    if (regions[region].values() < fewestInRegion) continue;
    const std::vector<RegionDeviation> deviations =
        deviationsOf(whole.fits, whole.shown.what, regions[region]);
    for (std::size_t p = 0; p < results.size(); ++p) {
      if (!shinesIn(whole.white, p, region, region + 1)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(deviations[p].amplitude[c]) > certain * deviations[p].deviation[c])
          results[p].unevenness = std::max(results[p].unevenness, std::abs(deviations[p].amplitude[c]));
    }
  }
}

}  // namespace

std::vector<MosaicResult> evaluateMosaics(const MosaicPhotographs& photographs,
                                          const std::vector<hdr::CameraModel>& cameras,
                                          const Thinning& thinning, Progress& progress) {
  auto part = [&progress](double share) { return progress.part(share, progress.stage()); };
  Progress reading = part(0.3);
  const PhotographedLight lights = photographedLight(photographs, cameras, thinning.rasters(), reading);
  Progress multiplying = part(0.1);
  const std::vector<LightProducts> regions = regionProducts(lights, thinning, multiplying);

  Progress fitting = part(0.3);
  Whole whole{shownLevels(photographs), {}, {}};
  const ShownLevels& shown = whole.shown;
  whole.fits = fitResponses(shown.drives, shown.what, sumOf(regions), usualResponses(shown.drives), fitting);
  const std::vector<Additivity> additivity = additivitiesOf(photographs, lights, whole.fits);
  std::vector<MosaicResult> results(whole.fits.size());
  for (std::size_t p = 0; p < results.size(); ++p) {
    const ResponseFit& fit = whole.fits[p];
    results[p].additivity = additivity[p];
    for (std::size_t c = 0; c < 3; ++c) {
      hdr::ResponseCurve& curve = results[p].response.channels[c];
      curve = curveOf(shown.drives[p], fit.light[c], fit.deviation[c]);
      results[p].response.residuals[c] = residualsOf(curve, shown.drives[p], fit.light[c], fit.residual[c]);
    }
    whole.white.push_back(regionLights(lights, p, thinning));
  }

  Progress flickering = part(0.2);
  addFlicker(results, whole, regions, flickering);
  Progress comparing = part(0.1);
  addUnevenness(results, whole, regions, comparing);
  return results;
}

}  // namespace relucent::linearization
