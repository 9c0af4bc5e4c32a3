// SPDX-License-Identifier: MIT
#include "pipeline/inverse_bench.h"

#include "base/stopwatch.h"
#include "compensation/methods.h"
#include "devices/temporary_folder.h"
#include "inverse/cluster_inverse.h"
#include "pipeline/calibrate.h"
#include "pipeline/evaluation.h"

namespace relucent {
namespace {

template <typename Work>
double secondsOf(const Work& work) {
  Stopwatch watch;
  work();
  return watch.seconds();
}

/// Everything that is timed works on T as it was measured.
void timeInversions(const MeasuredVenue& venue, VenueInversion& result, Progress& progress) {
  const CompensatorSettings standard;
  result.windowSeconds = secondsOf([&] {
    Progress part = progress.part(0.4, RELUCENT_MESSAGE("stage.windows", "Windows"));
    result.ridge = chooseRidge(venue, WindowSettings{}, part).ridge;
  });
  Clustering capped;
  {
    std::optional<ConnectionGraph> graph;
    result.clusterSeconds = secondsOf([&] {
      Progress part = progress.part(0.1, RELUCENT_MESSAGE("stage.algorithm-1", "Algorithm 1"));
      graph.emplace(venue.transport, venue.usable, ConnectionGraphSettings{}, part);
      ClusteringSettings printed;
      printed.cap = SizeCap::never;
      result.printed = clustered(*graph, printed, part).statistics;
    });
    result.cappedSeconds = secondsOf([&] {
      Progress part =
          progress.part(0.1, RELUCENT_MESSAGE("stage.clusters-held-size", "Clusters held to a size"));
      capped = clustered(*graph, standard.clustering, part);
    });
    result.capped = capped.statistics;
  }
  auto invert = [&](const Message& stage, ClusterSolver solver, ClusterColour colour) {
    Progress part = progress.part(0.13, stage);
    ClusterInverseSettings settings = standard.clusterInverse;
    settings.solver = solver;
    settings.colour = colour;
    return secondsOf([&] { computeClusterInverse(capped, venue.usable, settings, part); });
  };
  result.truncatedSeconds =
      invert(RELUCENT_ENGLISH_MESSAGE("stage.truncated-singular-values", "Truncated singular values"),
             ClusterSolver::truncatedSvd, ClusterColour::shared);
  result.ridgeSeconds =
      invert(RELUCENT_ENGLISH_MESSAGE("stage.ridge", "Ridge"), ClusterSolver::ridge, ClusterColour::shared);
  result.fullColourSeconds =
      invert(RELUCENT_ENGLISH_MESSAGE("stage.ridge-in-full-colour", "Ridge in full colour"),
             ClusterSolver::ridge, ClusterColour::full);
}

/// dB per method, mean over the product's pictures.
std::map<Method, double> qualityOf(const MeasuredCalibration& measured, const EvaluateSettings& settings,
                                   const std::filesystem::path& cache, Progress& progress) {
  EvaluateResult scores = evaluated(measured, settings, cache, progress).result;
  std::map<Method, double> quality;
  for (const ImageScore& image : scores.images)
    for (const MethodScore& score : image.methods)
      quality[score.method] += score.psnrReachable / static_cast<double>(scores.images.size());
  return quality;
}

double clusterQuality(const MeasuredCalibration& measured, ClusterSolver solver, ClusterColour colour,
                      const std::filesystem::path& cache, Progress& progress) {
  const Method method = Method::clusters;
  EvaluateSettings settings;
  settings.methods = {method};
  settings.compensator.clusterInverse.solver = solver;
  settings.compensator.clusterInverse.colour = colour;
  return qualityOf(measured, settings, cache, progress).at(method);
}

VenueInversion inverted(const std::string& name, const std::filesystem::path& cache, Progress& progress) {
  TemporaryFolder temporary;
  std::filesystem::path path = temporary.path() / name;
  VenueSettings venue;
  venue.name = name;
  CalibrateSettings settings;
  settings.rig = venue;
  Progress calibrating =
      progress.part(0.7, RELUCENT_MESSAGE("stage.measuring-venue", "Measuring {}").with(name));
  calibrate(path, settings, cache, calibrating);

  VenueInversion result;
  result.venue = name;
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  Progress loading = progress.part(0.05, RELUCENT_MESSAGE("stage.reading-venue", "Reading {}").with(name));
  MeasuredCalibration measured = loadCalibration(folder, loading);
  result.leaves = measured.venue.transport.leaves().blocks();
  Progress timing = progress.part(0.1, RELUCENT_MESSAGE("stage.inverting-venue", "Inverting {}").with(name));
  timeInversions(measured.venue, result, timing);
  Progress evaluating = progress.part(
      0.11, RELUCENT_MESSAGE("stage.comparing-methods-in-venue", "Comparing the methods in {}").with(name));
  result.quality = qualityOf(measured, {}, cache, evaluating);
  Progress comparing = progress.part(0.04, RELUCENT_MESSAGE("stage.comparing-cluster-inverses-in-venue",
                                                            "Comparing the inverses of clusters in {}")
                                               .with(name));
  result.truncatedQuality =
      clusterQuality(measured, ClusterSolver::truncatedSvd, ClusterColour::shared, cache, comparing);
  result.fullColourQuality =
      clusterQuality(measured, ClusterSolver::ridge, ClusterColour::full, cache, comparing);
  return result;
}

}  // namespace

InverseBenchResult benchInverse(const std::filesystem::path& cache, Progress& progress) {
  InverseBenchResult result;
  for (const VenueDescription& venue : venues()) {
    Progress part = progress.part(1.0 / static_cast<double>(venues().size()), Message::plain(venue.name));
    result.venues.push_back(inverted(venue.name, cache, part));
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent
