// SPDX-License-Identifier: MIT
// The real-time engine against the machine's copy bandwidth and against Eigen's sparse product of the same
// operator. Needs neither Qt nor a display, so it can be carried to another machine alone.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <thread>

#include "base/parallel.h"
#include "engine/cpu_backend.h"
#include "synthetic_transport.h"
#include "transport/files.h"

using namespace relucent;
using namespace relucent::benchmarks;

namespace {

using Plane = Eigen::SparseMatrix<float, Eigen::RowMajor, int>;

/// Median and best seconds of a run, after one to warm up.
struct Timing {
  double median = 0.0, best = 0.0;
};

/// Seconds of this thread on a processor, or of the clock on the wall: on a machine that is shared, the first
/// with one thread says what a part costs, not how long it waits.
bool onlyThisThread = false;
double now() {
  if (!onlyThisThread)
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Timing timed(const std::function<void()>& run) {
  run();
  std::vector<double> seconds;
  double sum = 0.0;
  while (seconds.size() < 5 || (sum < 0.5 && seconds.size() < 60)) {
    double begin = now();
    run();
    seconds.push_back(now() - begin);
    sum += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front()};
}

struct Line {
  std::string name;
  Timing timing;
  double bytes;
};

MeasuredVenue venueOf(const SyntheticSettings& settings, const std::string& file) {
  NodeLayout layout{Rasters(settings.projector)};
  MeasuredVenue venue;
  venue.transport =
      file.empty() ? TransportMatrix(settings.camera, settings.projector, syntheticLeaves(settings, layout))
                   : loadTransport(file);
  venue.flood = venue.transport.floodlight();
  venue.black.assign(venue.flood.size(), 0.001f);
  venue.usable.assign(venue.transport.cameras().count(), 1);
  return venue;
}

/// The windows' channel as a matrix of single floats: projector pixels x camera pixels.
Plane windowsPlane(const EngineVenue& engine, std::size_t channel) {
  WindowArrays windows = engine.inverse.view();
  Size size = engine.venue.transport.projectors().size(0), grid = windows.tiles->size(0);
  auto pixels = static_cast<std::size_t>(windows.tile * windows.tile);
  Plane plane(static_cast<Eigen::Index>(size.count()),
              static_cast<Eigen::Index>(engine.venue.transport.cameras().count()));
  plane.reserve(Eigen::VectorXi::Constant(plane.rows(), 48));
  for (std::size_t tile = 0; tile < grid.count(); ++tile) {
    Pixel place = pixelAt(grid, tile);
    for (std::size_t i = 0; i < pixels; ++i) {
      Pixel pixel{place.x * windows.tile + static_cast<int>(i) % windows.tile,
                  place.y * windows.tile + static_cast<int>(i) / windows.tile};
      if (pixel.x >= size.width || pixel.y >= size.height) continue;
      for (std::size_t k = windows.start[tile]; k < windows.start[tile + 1]; ++k)
        plane.insert(static_cast<Eigen::Index>(indexOf(size, pixel)),
                     static_cast<Eigen::Index>(windows.row[k])) =
            windows.scale[3 * tile + channel] *
            static_cast<float>(windows.weight[(3 * k + channel) * pixels + i]);
    }
  }
  plane.makeCompressed();
  return plane;
}

/// The packed T's channel, before mixing: camera pixels x nodes.
Plane transportPlane(const EngineVenue& engine, std::size_t channel) {
  const PackedTransport& packed = engine.transport;
  Plane plane(static_cast<Eigen::Index>(packed.pixels().size()),
              static_cast<Eigen::Index>(engine.venue.transport.layout().count()));
  Eigen::VectorXi count(plane.rows());
  for (std::size_t row = 0; row < packed.pixels().size(); ++row)
    count[packed.pixels()[row]] = static_cast<int>(packed.leafStart()[row + 1] - packed.leafStart()[row]);
  plane.reserve(count);
  for (const TransportPatch& patch : packed.patches())
    for (std::size_t row = patch.rowBegin; row < patch.rowEnd; ++row)
      for (std::size_t i = packed.leafStart()[row]; i < packed.leafStart()[row + 1]; ++i)
        plane.insert(packed.pixels()[row], packed.nodes()[patch.columnBegin + packed.leaves()[i].column]) =
            static_cast<float>(packed.leaves()[i].code[channel]);
  plane.makeCompressed();
  return plane;
}

void add(std::vector<Line>& lines, Line line) {
  fmt::print(stderr, "{:<40} {:8.2f} ms, best {:8.2f} ms\n", line.name, 1e3 * line.timing.median,
             1e3 * line.timing.best);
  lines.push_back(std::move(line));
}

void timeBackend(CpuBackend& backend, const EngineVenue& engine, std::vector<Line>& lines) {
  const Size size{1920, 1080};
  std::vector<std::uint8_t> pixels(4 * size.count());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<std::uint8_t>(i * 2654435761u >> 24);
  ContentFrame frame{pixels.data(), size, 4 * static_cast<std::size_t>(size.width),
                     ContentFrame::Format::rgba8};
  EngineContent content = prepareContent(engine, size);
  backend.setContent(content);
  std::vector<std::uint32_t> words(engine.brightest.size());
  FrameReport report;
  std::string name(backend.name());
  auto windows = static_cast<double>(engine.inverse.bytes());
  auto transport = static_cast<double>(engine.transport.bytes());
  backend.render(frame, {}, words, report);
  add(lines, {name + ": M", timed([&] { backend.applyWindows(); }), windows});
  add(lines, {name + ": step", timed([&] { backend.takeStep(1.2f); }), transport});
  for (int steps : {0, 1, 2})
    add(lines, {fmt::format("{}: frame, K = {}", name, steps), timed([&] {
                  backend.render(frame, {true, steps, 1.0f, 0.0f}, words, report);
                }),
                2 * windows + (1 + steps) * transport});
}

void timeEigen(const EngineVenue& engine, std::vector<Line>& lines) {
  // One channel at a time, three times the time: three planes of single floats fill gigabytes.
  {
    Plane plane = windowsPlane(engine, 0);
    Eigen::VectorXf in = Eigen::VectorXf::Random(plane.cols()), out(plane.rows());
    Timing timing = timed([&] { out.noalias() = plane * in; });
    add(lines, {"Eigen CSR: M",
                {3 * timing.median, 3 * timing.best},
                3.0 * 8.0 * static_cast<double>(plane.nonZeros())});
  }
  Plane plane = transportPlane(engine, 0);
  Eigen::VectorXf in = Eigen::VectorXf::Random(plane.cols()), out(plane.rows()), back(plane.cols());
  Timing timing = timed([&] {
    out.noalias() = plane * in;
    back.noalias() = plane.transpose() * out;
  });
  add(lines, {"Eigen CSR: T p and adjoint",
              {3 * timing.median, 3 * timing.best},
              6.0 * 8.0 * static_cast<double>(plane.nonZeros())});
}

Size sizeOf(const std::string& text) {
  std::size_t cross = text.find('x');
  return {std::stoi(text.substr(0, cross)), std::stoi(text.substr(cross + 1))};
}

/// Bytes read and written per second by a plain copy, timed as everything else here is.
double copied() {
  constexpr std::size_t bytes = std::size_t{1} << 28;
  std::vector<char> from(bytes, 1), to(bytes, 2);
  Timing timing = timed([&] {
    parallelChunks(0, bytes, 64, [&](std::size_t, std::size_t begin, std::size_t end) {
      std::memcpy(&to[begin], &from[begin], end - begin);
    });
  });
  return 2.0 * static_cast<double>(bytes) / timing.best;
}

void print(const std::vector<Line>& lines, int threads, double copy, const EngineVenue& engine) {
  fmt::print(
      "{{\"machine\":{{\"threads\":{},\"copy_bytes_per_second\":{:.4g}}},\"most_columns\":{},\"benchmarks\":["
      "\n",
      threads, copy, engine.transport.mostColumns());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    fmt::print(
        "{{\"name\":\"{}\",\"seconds\":{:.5f},\"best\":{:.5f},\"bytes\":{:.4g},\"share_of_copy\":{:.3f}}}{}"
        "\n",
        line.name, line.timing.median, line.timing.best, line.bytes, line.bytes / line.timing.best / copy,
        i + 1 < lines.size() ? "," : "]}");
  }
}

}  // namespace

// relucent-engine-benchmark [--one-thread] [--no-eigen] [--patch N] [--projector WxH] [--camera WxH]
// [--transport FILE]
//   --one-thread  seconds of one core instead of seconds on the wall: for machines that others use too
int main(int argc, char** argv) {
  SyntheticSettings synthetic;
  // As relucent-cli's bench has it.
  synthetic.coarseNodes = 36;
  synthetic.finestCoarse = 4;
  synthetic.coarseLevels = 3;
  EngineSettings settings;
  bool eigen = true;
  std::string file;
  for (int i = 1; i < argc; ++i) {
    std::string option = argv[i];
    if (option == "--one-thread") onlyThisThread = true;
    if (option == "--no-eigen") eigen = false;
    if (i + 1 == argc) break;
    if (option == "--transport") file = argv[i + 1];
    if (option == "--patch") settings.patchSide = std::stoi(argv[i + 1]);
    if (option == "--projector") synthetic.projector = sizeOf(argv[i + 1]);
    if (option == "--camera") synthetic.camera = sizeOf(argv[i + 1]);
  }
  MeasuredVenue venue = venueOf(synthetic, file);
  Progress silent;
  WindowInverse inverse = computeWindows(venue.transport, venue.usable, {}, silent);
  EngineVenue engine = prepareVenue(venue, inverse, {ProjectorResponse{}}, settings);

  int threads = onlyThisThread ? 1 : static_cast<int>(std::thread::hardware_concurrency());
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  double copy = copied();
  std::vector<Line> lines;
  for (std::size_t i = engineKernels().size(); i-- > 0;) {
    CpuBackend backend(engine, &engineKernels()[i]);
    timeBackend(backend, engine, lines);
  }
  Stack projector = randomStack(venue.transport.projectors().count(), 1);
  Stack camera = randomStack(venue.transport.cameras().count(), 2);
  lines.push_back(
      {"WindowInverse::apply", timed([&] { inverse.apply(camera); }), static_cast<double>(inverse.bytes())});
  add(lines, {"TransportMatrix: T p and adjoint",
              timed([&] { venue.transport.applyTransposed(venue.transport.apply(projector)); }),
              2.0 * static_cast<double>(venue.transport.leaves().bytes())});
  if (eigen) timeEigen(engine, lines);
  print(lines, threads, copy, engine);
}
