// SPDX-License-Identifier: MIT
#include "relucent/engine/bench/reference_products.h"

#include "relucent/base/error.h"

namespace relucent::engine {
namespace {

using Plane = ReferencePlane;
constexpr double bytesOfAnEntry = 8.0;  // a float and an index

/// The windows' channel: projector pixels x camera pixels.
Plane windowsPlane(const EngineVenue& engine, std::size_t channel) {
  inverse::WindowArrays windows = engine.inverse.view();
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

/// All three channels from one: three planes of single floats would fill gigabytes.
EngineBenchLine threeTimes(const std::string& name, const EngineBenchTiming& timing, double bytes) {
  return {name, 3.0 * timing.median, 3.0 * timing.best, 3.0 * bytes, 0.0, {}};
}

EngineBenchTiming timeEigen(const Plane& plane, ReferenceProduct product,
                            const std::function<double()>& clock) {
  Eigen::VectorXf in = Eigen::VectorXf::Random(plane.cols()), out(plane.rows()), back(plane.cols());
  return timedRuns([&] {
    const double begin = clock();
    out.noalias() = plane * in;
    if (product == ReferenceProduct::both) back.noalias() = plane.transpose() * out;
    return clock() - begin;
  });
}

}  // namespace

void benchReferences(const EngineVenue& engine, bool oneThread, const std::function<double()>& clock,
                     EngineBenchResult& result) {
  bool sciPyMissing = false;
  auto timeBoth = [&](const Plane& plane, ReferenceProduct product, const char* name) {
    const double reads = product == ReferenceProduct::both ? 2.0 : 1.0;
    const double bytes = reads * bytesOfAnEntry * static_cast<double>(plane.nonZeros());
    result.lines.push_back(
        threeTimes(fmt::format("Eigen CSR: {}", name), timeEigen(plane, product, clock), bytes));
    if (auto timing = timeSciPy(plane, product, oneThread))
      result.lines.push_back(threeTimes(fmt::format("SciPy CSR: {}", name), *timing, bytes));
    else
      sciPyMissing = true;
  };
  timeBoth(windowsPlane(engine, 0), ReferenceProduct::there, "M");
  timeBoth(transportPlane(engine, 0), ReferenceProduct::both, "step");
  if (sciPyMissing)
    result.notes.emplace_back(RELUCENT_ENGLISH_MESSAGE(
        "engine.scipy-missing", "SciPy was not timed: no python3 of this machine has it"));
}

}  // namespace relucent::engine
