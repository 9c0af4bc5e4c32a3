// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstring>

#include "relucent/base/parallel.h"
#include "relucent/engine/cpu_backend.h"

namespace relucent::engine {

PatchRows CpuBackend::rowsOf(const TransportPatch& patch) const noexcept {
  const PackedTransport& transport = engine_.transport;
  return {{transport.squares().data() + patch.squareBegin, patch.squareEnd - patch.squareBegin},
          transport.rowSlices().data(),
          transport.rowSlices().size(),
          transport.groupSlices().data(),
          transport.leaves().data()};
}

void CpuBackend::passThrough(Pass pass) noexcept {
  const PackedTransport& transport = engine_.transport;
  const transport::NodeLayout& layout = engine_.venue.transport.layout();
  layout.fillMeansFrom(2, nodeValues());
  const bool correct = pass == Pass::correct;
  const CameraArrays camera{correct ? held_.data() : wanted_.data(), lit_.data(), unmixed_.data(),
                            unmix_.data()};
  parallelFor(0, transport.patches().size(), 1, [&](std::size_t index) {
    const TransportPatch& patch = transport.patches()[index];
    const std::uint32_t* node = transport.nodes().data() + patch.columnBegin;
    const std::size_t columns = patch.columnEnd - patch.columnBegin;
    ScratchPool::BorrowedBuffer loan(scratch_);
    float* to = loan.data();
    constexpr std::size_t ahead = 32;
    for (std::size_t column = 0; column < columns; ++column, to += columnFloats) {
      if (column + ahead < columns) __builtin_prefetch(&nodes_[3 * std::size_t{node[column + ahead]}]);
      std::memcpy(to, &nodes_[3 * std::size_t{node[column]}], 4 * sizeof(float));
      std::fill(to + 4, to + columnFloats, 0.0f);
    }
    std::fill_n(to, columnFloats, 0.0f);  // what fills up rows
    (correct ? kernels_.correct : kernels_.step)(rowsOf(patch), camera, loan.data());
    patchSums_.addPatch(index, loan.data() + 4, columnFloats, adjoint_.data(), waiting_.data());
  });
  patchSums_.addStored(waiting_.data(), adjoint_.data());
  layout.gatherAboveLines(adjoint_, sumFloats);
}

}  // namespace relucent::engine
