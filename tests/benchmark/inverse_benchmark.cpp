// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

#include "relucent/clustering/grouping.h"
#include "relucent/inverse/cluster_inverse.h"
#include "relucent/inverse/windows.h"
#include "synthetic_transport.h"

namespace relucent::benchmarks {
namespace {

Progress quiet;

const transport::TransportMatrix& venue() {
  static const transport::TransportMatrix venue = [] {
    SyntheticSettings settings;
    transport::NodeLayout layout{Rasters(settings.projector)};
    return transport::TransportMatrix(settings.camera, settings.projector,
                                      defocusedLeaves(settings, DefocusSettings{}, layout));
  }();
  return venue;
}

const CameraMask& usable() {
  static const CameraMask usable(venue().cameras().count(), 1);
  return usable;
}

const clustering::ConnectionGraph& graph() {
  static const clustering::ConnectionGraph graph(venue(), usable(), {}, quiet);
  return graph;
}

/// The whole capped chain keeps what Algorithm 1 would cut inside clusters, as the inverse is better for it.
clustering::ClusteringSettings capped(int most) {
  clustering::ClusteringSettings settings;
  settings.patchCut = 0.1;
  settings.cap = clustering::SizeCap::always;
  settings.mostUnknowns = most;
  return settings;
}

/// A line of /proc/self/status in MiB.
double mebibytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024.0;
  return 0.0;
}

/// From here on the most memory held counts again.
double forgetPeak() {
  std::ofstream("/proc/self/clear_refs") << "5";
  return mebibytes("VmRSS");
}

void describe(benchmark::State& state, const clustering::ClusteringStatistics& s, std::size_t clusters) {
  state.counters["clusters"] = static_cast<double>(clusters);
  state.counters["largest"] = s.largest;
  state.counters["kept"] = static_cast<double>(s.kept);
  state.counters["kept_light"] = s.keptLight;
  state.counters["error_median"] = s.errorMedian;
}

void announceThreshold(benchmark::State& state) {
  venue();
  for (auto _ : state) benchmark::DoNotOptimize(transport::statisticsOf(venue(), {0.001f, 0.01f, 0.95}));
  state.counters["leaves"] = static_cast<double>(venue().ownLeaves().blocks());
}

void applyThreshold(benchmark::State& state) {
  CameraStack flood = venue().floodlight();
  for (auto _ : state) benchmark::DoNotOptimize(transport::thresholded(venue(), {0.0f, 0.01f, 1.0}, flood));
}

void prepareGraph(benchmark::State& state) {
  usable();
  double before = forgetPeak();
  for (auto _ : state) {
    clustering::ConnectionGraph prepared(venue(), usable(), {}, quiet);
    state.counters["connections"] = static_cast<double>(prepared.connections());
  }
  state.counters["peak_MiB_beyond"] = mebibytes("VmHWM") - before;
}

/// Graph, patches, re-insertion, components, scaling, error map.
void algorithmOne(benchmark::State& state) {
  usable();
  double before = forgetPeak();
  for (auto _ : state) {
    clustering::ConnectionGraph prepared(venue(), usable(), {}, quiet);
    clustering::ClusteringSettings settings;
    settings.cap = clustering::SizeCap::never;
    clustering::Clustering result = clustering::clustered(prepared, settings, quiet);
    describe(state, result.statistics, result.sizes.size());
  }
  state.counters["peak_MiB_beyond"] = mebibytes("VmHWM") - before;
}

/// What moving a slider costs: the graph is there.
void changeThreshold(benchmark::State& state) {
  clustering::ClusteringSettings settings;
  settings.cap = state.range(0) ? clustering::SizeCap::whenPercolated : clustering::SizeCap::never;
  graph();
  for (auto _ : state) {
    settings.patchCut = settings.patchCut == 0.5 ? 0.6 : 0.5;
    clustering::Clustering result = clustering::clustered(graph(), settings, quiet);
    describe(state, result.statistics, result.sizes.size());
  }
}

/// What moving a slider costs until its map is known. `most`: the cap, 0: none; `cut`: per cent of a patch's
/// brightest; `moved`: the slider is the cap's own, else that of the distance.
void groupAgain(benchmark::State& state) {
  auto most = static_cast<int>(state.range(0));
  clustering::ClusteringSettings settings;
  settings.cap = most > 0 ? clustering::SizeCap::always : clustering::SizeCap::never;
  settings.mostUnknowns = std::max(1, most);
  settings.patchCut = 0.01 * static_cast<double>(state.range(1));
  clustering::Grouper grouper(graph());
  grouper.group(settings, quiet);
  double before = forgetPeak();
  for (auto _ : state) {
    if (state.range(2))
      settings.mostUnknowns = settings.mostUnknowns == most ? most + 16 : most;
    else
      settings.patchRadius = settings.patchRadius == 8.0 ? 9.0 : 8.0;
    const clustering::Grouping& result = grouper.group(settings, quiet);
    describe(state, result.statistics, result.sizes.size());
  }
  state.counters["peak_MiB_beyond"] = mebibytes("VmHWM") - before;
}

/// ... and from then until its errors are.
void errorsOfGrouping(benchmark::State& state) {
  clustering::ClusteringSettings settings;
  clustering::Grouper grouper(graph());
  const clustering::Grouping& grouping = grouper.group(settings, quiet);
  for (auto _ : state) benchmark::DoNotOptimize(errorOf(graph(), grouping, settings, quiet));
}

void cappedClusters(benchmark::State& state) {
  graph();
  double before = forgetPeak();
  for (auto _ : state) {
    clustering::Clustering result =
        clustering::clustered(graph(), capped(static_cast<int>(state.range(0))), quiet);
    describe(state, result.statistics, result.sizes.size());
  }
  state.counters["peak_MiB_beyond"] = mebibytes("VmHWM") - before;
}

/// Graph, capped clusters, inverses: all of it.
void cappedInverse(benchmark::State& state) {
  usable();
  double before = forgetPeak();
  for (auto _ : state) {
    clustering::ConnectionGraph prepared(venue(), usable(), {}, quiet);
    clustering::Clustering result =
        clustering::clustered(prepared, capped(static_cast<int>(state.range(0))), quiet);
    inverse::ClusterInverseSettings settings;
    settings.colour = state.range(1) ? inverse::ClusterColour::full : inverse::ClusterColour::shared;
    settings.solver = state.range(2) ? inverse::ClusterSolver::truncatedSvd : inverse::ClusterSolver::ridge;
    inverse::ClusterInverse inverse = inverse::computeClusterInverse(result, usable(), settings, quiet);
    state.counters["inverse_MiB"] = static_cast<double>(inverse.bytes()) / 1048576.0;
    describe(state, result.statistics, result.sizes.size());
  }
  state.counters["peak_MiB_beyond"] = mebibytes("VmHWM") - before;
}

/// The default operator, with a given ridge.
void windows(benchmark::State& state) {
  usable();
  double before = forgetPeak();
  for (auto _ : state) {
    inverse::WindowInverse inverse = inverse::computeWindows(venue(), usable(), {}, quiet);
    state.counters["inverse_MiB"] = static_cast<double>(inverse.bytes()) / 1048576.0;
  }
  state.counters["peak_MiB_beyond"] = mebibytes("VmHWM") - before;
}

void applyInverse(benchmark::State& state) {
  clustering::Clustering result = clustering::clustered(graph(), capped(256), quiet);
  inverse::ClusterInverse inverse = inverse::computeClusterInverse(result, usable(), {}, quiet);
  CameraStack residual = venue().floodlight();
  for (auto _ : state) benchmark::DoNotOptimize(inverse.apply(residual));
}

// What needs most memory comes before anything that stays in memory.
BENCHMARK(announceThreshold)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(applyThreshold)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(prepareGraph)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(algorithmOne)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(cappedInverse)
    ->ArgNames({"most", "full", "svd"})
    ->Args({128, 0, 0})
    ->Args({256, 0, 0})
    ->Args({128, 1, 0})
    ->Args({128, 0, 1})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(windows)->Iterations(1)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(changeThreshold)->ArgName("cap")->Arg(0)->Arg(1)->UseRealTime()->Unit(benchmark::kMillisecond);
// Of all threads: on a machine that others use too, it says more than seconds on the wall.
BENCHMARK(groupAgain)
    ->ArgNames({"most", "cut", "cap_moved"})
    ->Args({0, 50, 0})
    ->Args({128, 50, 0})
    ->Args({256, 50, 0})
    ->Args({256, 10, 0})
    ->Args({256, 50, 1})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(errorsOfGrouping)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(cappedClusters)->ArgName("most")->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(applyInverse)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace relucent::benchmarks
