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

/// T from a projector channel to the camera channel of its number: camera pixels x nodes.
Plane transportPlane(const EngineVenue& engine, std::size_t channel) {
  const transport::TransportMatrix flat = engine.venue.transport.flattened();
  const transport::BlockSparse& leaves = flat.ownLeaves();
  Plane plane(static_cast<Eigen::Index>(leaves.rows()), static_cast<Eigen::Index>(leaves.columns()));
  Eigen::VectorXi count(plane.rows());
  for (std::size_t row = 0; row < leaves.rows(); ++row)
    count[static_cast<Eigen::Index>(row)] = static_cast<int>(leaves.rowBegin(row + 1) - leaves.rowBegin(row));
  plane.reserve(count);
  const auto c = static_cast<Eigen::Index>(channel);
  for (std::size_t row = 0; row < leaves.rows(); ++row)
    for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
      plane.insert(static_cast<Eigen::Index>(row), leaves.column(entry)) = leaves.block(row, entry)(c, c);
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
