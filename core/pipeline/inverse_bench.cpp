// SPDX-License-Identifier: MIT
#include "relucent/pipeline/inverse_bench.h"

#include "relucent/base/stopwatch.h"
#include "relucent/compensation/methods.h"
#include "relucent/devices/temporary_folder.h"
#include "relucent/inverse/cluster_inverse.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/evaluation.h"

namespace relucent::pipeline {
namespace {

template <typename Work>
double secondsOf(const Work& work) {
  Stopwatch watch;
  work();
  return watch.seconds();
}

/// Everything that is timed works on T as it was measured.
void timeInversions(const compensation::MeasuredVenue& venue, VenueInversion& result, Progress& progress) {
  const compensation::CompensatorSettings standard;
  result.windowSeconds = secondsOf([&] {
    Progress part =
        progress.part(0.4, RELUCENT_MESSAGE("stage.windows", "Computing the windows of the inverse"));
    result.ridge = chooseRidge(venue, inverse::WindowSettings{}, part).ridge;
  });
  clustering::Clustering capped;
  {
    std::optional<clustering::ConnectionGraph> graph;
    result.clusterSeconds = secondsOf([&] {
      Progress part = progress.part(0.1, RELUCENT_MESSAGE("stage.algorithm-1", "Algorithm 1"));
      graph.emplace(venue.transport, venue.usable, clustering::ConnectionGraphSettings{}, part);
      clustering::ClusteringSettings printed;
      printed.cap = clustering::SizeCap::never;
      result.printed = clustering::clustered(*graph, printed, part).statistics;
    });
    result.cappedSeconds = secondsOf([&] {
      Progress part =
          progress.part(0.1, RELUCENT_MESSAGE("stage.capped-clusters", "Clusters held to a size"));
      capped = clustering::clustered(*graph, standard.clustering, part);
    });
    result.capped = capped.statistics;
  }
  auto invert = [&](const Message& stage, inverse::ClusterSolver solver, inverse::ClusterColour colour) {
    Progress part = progress.part(0.13, stage);
    inverse::ClusterInverseSettings settings = standard.clusterInverse;
    settings.solver = solver;
    settings.colour = colour;
    return secondsOf([&] { inverse::computeClusterInverse(capped, venue.usable, settings, part); });
  };
  result.truncatedSeconds =
      invert(RELUCENT_ENGLISH_MESSAGE("stage.truncated-singular-values", "Truncated singular values"),
             inverse::ClusterSolver::truncatedSvd, inverse::ClusterColour::shared);
  result.ridgeSeconds = invert(RELUCENT_ENGLISH_MESSAGE("stage.ridge", "Ridge"),
                               inverse::ClusterSolver::ridge, inverse::ClusterColour::shared);
  result.fullColourSeconds =
      invert(RELUCENT_ENGLISH_MESSAGE("stage.ridge-in-full-colour", "Ridge in full colour"),
             inverse::ClusterSolver::ridge, inverse::ClusterColour::full);
}

EvaluateSettings judgedByLight() {
  EvaluateSettings settings;
  settings.target = compensation::TargetSettings::ofLight();
  settings.fewImages = true;
  return settings;
}

/// dB per method, mean over the product's pictures.
std::map<compensation::Method, double> qualityOf(const MeasuredCalibration& measured,
                                                 const EvaluateSettings& settings,
                                                 const std::filesystem::path& cache, Progress& progress) {
  EvaluateResult scores = evaluated(measured, settings, cache, progress).result;
  std::map<compensation::Method, double> quality;
  for (const ImageScore& image : scores.images)
    for (const MethodScore& score : image.methods)
      quality[score.method] += score.psnrReachable / static_cast<double>(scores.images.size());
  return quality;
}

double clusterQuality(const MeasuredCalibration& measured, inverse::ClusterSolver solver,
                      inverse::ClusterColour colour, const std::filesystem::path& cache, Progress& progress) {
  const compensation::Method method = compensation::Method::clusters;
  EvaluateSettings settings = judgedByLight();
  settings.methods = {method};
  settings.compensator.clusterInverse.solver = solver;
  settings.compensator.clusterInverse.colour = colour;
  return qualityOf(measured, settings, cache, progress).at(method);
}

VenueInversion inverted(const std::string& name, const std::filesystem::path& cache, Progress& progress) {
  devices::TemporaryFolder temporary;
  std::filesystem::path path = temporary.path() / name;
  venue::VenueSettings venue;
  venue.name = name;
  CalibrateSettings settings;
  settings.rig = venue;
  Progress calibrating =
      progress.part(0.7, RELUCENT_MESSAGE("stage.measuring-venue", "Measuring {}").with(name));
  calibrate(path, settings, cache, calibrating);

  VenueInversion result;
  result.venue = name;
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  Progress loading = progress.part(0.05, RELUCENT_MESSAGE("stage.reading-venue", "Reading {}").with(name));
  MeasuredCalibration measured = loadCalibration(folder, loading);
  result.leaves = measured.venue.transport.storedLeaves();
  Progress timing = progress.part(0.1, RELUCENT_MESSAGE("stage.inverting-venue", "Inverting {}").with(name));
  timeInversions(measured.venue, result, timing);
  Progress evaluating = progress.part(
      0.11, RELUCENT_MESSAGE("stage.comparing-methods-in-venue", "Comparing the methods in {}").with(name));
  result.quality = qualityOf(measured, judgedByLight(), cache, evaluating);
  Progress comparing = progress.part(0.04, RELUCENT_MESSAGE("stage.comparing-cluster-inverses-in-venue",
                                                            "Comparing the inverses of clusters in {}")
                                               .with(name));
  result.truncatedQuality = clusterQuality(measured, inverse::ClusterSolver::truncatedSvd,
                                           inverse::ClusterColour::shared, cache, comparing);
  result.fullColourQuality =
      clusterQuality(measured, inverse::ClusterSolver::ridge, inverse::ClusterColour::full, cache, comparing);
  return result;
}

}  // namespace

InverseBenchResult benchInverse(const std::filesystem::path& cache, Progress& progress) {
  InverseBenchResult result;
  for (const venue::VenueDescription& venue : venue::venues()) {
    Progress part =
        progress.part(1.0 / static_cast<double>(venue::venues().size()), Message::plain(venue.name));
    result.venues.push_back(inverted(venue.name, cache, part));
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
