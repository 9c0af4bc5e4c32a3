// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <Eigen/SparseCore>
#include <chrono>

#include "copy_bandwidth.h"
#include "synthetic_transport.h"

namespace relucent::benchmarks {
namespace {

using Reference = Eigen::SparseMatrix<float, Eigen::RowMajor, int>;

/// Made on first use: a filter that leaves a benchmark out also saves its data.
const transport::NodeLayout& layout() {
  static const transport::NodeLayout layout{Rasters(SyntheticSettings{}.projector)};
  return layout;
}

const transport::BlockSparse& leaves() {
  static const transport::BlockSparse leaves = syntheticLeaves(SyntheticSettings{}, layout());
  return leaves;
}

/// The same values, one by one.
const Reference& reference() {
  static const Reference reference = [] {
    const transport::BlockSparse& from = leaves();
    Reference matrix(static_cast<int>(3 * from.rows()), static_cast<int>(3 * from.columns()));
    matrix.reserve(static_cast<Eigen::Index>(9 * from.blocks()));
    for (std::size_t row = 0; row < from.rows(); ++row) {
      for (int channel = 0; channel < 3; ++channel) {
        matrix.startVec(static_cast<int>(3 * row) + channel);
        for (std::size_t entry = from.rowBegin(row); entry < from.rowBegin(row + 1); ++entry) {
          transport::ColourBlock block = from.block(row, entry);
          for (int c = 0; c < 3; ++c)
            matrix.insertBack(static_cast<int>(3 * row) + channel,
                              static_cast<int>(3 * from.column(entry)) + c) = block(channel, c);
        }
      }
    }
    matrix.finalize();
    return matrix;
  }();
  return reference;
}

std::size_t bytesOf(const Reference& matrix) {
  return static_cast<std::size_t>(matrix.nonZeros()) * (sizeof(float) + sizeof(int)) +
         static_cast<std::size_t>(matrix.outerSize() + 1) * sizeof(int);
}

/// Limits the threads for the life of a benchmark, and says at the end what the memory had to do.
class Measured {
 public:
  explicit Measured(benchmark::State& state)
      : state_(state),
        copy_(copyBandwidth(static_cast<int>(state.range(0)))),
        limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(0))),
        start_(std::chrono::steady_clock::now()) {}

  void finish(std::size_t bytesPerRun) {
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    auto bytes = static_cast<double>(bytesPerRun);
    double bytesPerSecond = bytes * static_cast<double>(state_.iterations()) / seconds.count();
    state_.counters["bytes"] = bytes;
    state_.counters["bytes_per_second"] = bytesPerSecond;
    state_.counters["share_of_copy"] = bytesPerSecond / copy_;
  }

 private:
  benchmark::State& state_;
  double copy_;
  tbb::global_control limit_;
  std::chrono::steady_clock::time_point start_;
};

void everyNumberOfThreads(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("threads")->Arg(1)->UseRealTime()->Unit(benchmark::kMillisecond);
  if (int all = tbb::info::default_concurrency(); all > 1) benchmark->Arg(all);
}

void oneThread(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("threads")->Arg(1)->UseRealTime()->Unit(benchmark::kMillisecond);
}

void multiply(benchmark::State& state) {
  const transport::BlockSparse& matrix = leaves();
  ProjectorStack x(randomStack(matrix.columns(), 1));
  Measured measured(state);
  for (auto _ : state) benchmark::DoNotOptimize(matrix.multiply(x));
  measured.finish(matrix.bytes() + (x.size() + 3 * matrix.rows()) * sizeof(float));
}
BENCHMARK(multiply)->Apply(everyNumberOfThreads);

void multiplyTransposed(benchmark::State& state) {
  const transport::BlockSparse& matrix = leaves();
  Stack y = randomStack(matrix.rows(), 2);
  Measured measured(state);
  for (auto _ : state) benchmark::DoNotOptimize(matrix.multiplyTransposed(y));
  measured.finish(matrix.bytes() + (y.size() + 3 * matrix.columns()) * sizeof(float));
}
BENCHMARK(multiplyTransposed)->Apply(everyNumberOfThreads);

/// A pattern of which one pixel in 64 is lit, through the matrix stored by columns: acquisition's
/// predictions.
void multiplyDarkPattern(benchmark::State& state) {
  static const transport::BlockSparse byColumns = leaves().transposed();
  ProjectorStack pattern(3 * byColumns.rows(), 0.0f);
  std::size_t lit = 0;
  for (std::size_t pixel = 0; pixel < SyntheticSettings{}.projector.count(); pixel += 64) {
    pattern[3 * pixel] = 1.0f;
    lit += byColumns.rowBegin(pixel + 1) - byColumns.rowBegin(pixel);
  }
  Measured measured(state);
  for (auto _ : state) benchmark::DoNotOptimize(byColumns.multiplyTransposed(pattern));
  constexpr std::size_t bytesPerBlock = 22;
  measured.finish(lit * bytesPerBlock + (pattern.size() + 3 * byColumns.columns()) * sizeof(float));
}
BENCHMARK(multiplyDarkPattern)->Apply(everyNumberOfThreads);

void means(benchmark::State& state) {
  ProjectorStack pattern(randomStack(layout().projectors().count(), 3));
  Measured measured(state);
  for (auto _ : state) benchmark::DoNotOptimize(layout().means(pattern));
  measured.finish((pattern.size() + 3 * layout().count()) * sizeof(float));
}
BENCHMARK(means)->Apply(everyNumberOfThreads);

void meansAdjoint(benchmark::State& state) {
  transport::NodeStack values(randomStack(layout().count(), 4));
  Measured measured(state);
  for (auto _ : state) benchmark::DoNotOptimize(layout().meansAdjoint(values));
  measured.finish((values.size() + 3 * layout().projectors().count()) * sizeof(float));
}
BENCHMARK(meansAdjoint)->Apply(everyNumberOfThreads);

void eigenMultiply(benchmark::State& state) {
  const Reference& matrix = reference();
  Eigen::VectorXf x = Eigen::VectorXf::Random(matrix.cols());
  Eigen::VectorXf y(matrix.rows());
  Measured measured(state);
  for (auto _ : state) {
    y.noalias() = matrix * x;
    benchmark::DoNotOptimize(y.data());
  }
  measured.finish(bytesOf(matrix) + static_cast<std::size_t>(matrix.rows() + matrix.cols()) * sizeof(float));
}
BENCHMARK(eigenMultiply)->Apply(oneThread);

void eigenMultiplyTransposed(benchmark::State& state) {
  const Reference& matrix = reference();
  Eigen::VectorXf y = Eigen::VectorXf::Random(matrix.rows());
  Eigen::VectorXf x(matrix.cols());
  Measured measured(state);
  for (auto _ : state) {
    x.noalias() = matrix.transpose() * y;
    benchmark::DoNotOptimize(x.data());
  }
  measured.finish(bytesOf(matrix) + static_cast<std::size_t>(matrix.rows() + matrix.cols()) * sizeof(float));
}
BENCHMARK(eigenMultiplyTransposed)->Apply(oneThread);

}  // namespace
}  // namespace relucent::benchmarks
