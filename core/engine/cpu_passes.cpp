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

CameraArrays CpuBackend::cameraArrays(const float* wanted) noexcept {
  return {wanted, reach_.data(), content_->isWeighted ? weightedLit_.data() : content_->lit.data(),
          unmixed_.data(), unmix_.data()};
}

void CpuBackend::passThrough(Pass pass) noexcept {
  const PackedTransport& transport = engine_.transport;
  const transport::NodeLayout& layout = engine_.venue.transport.layout();
  layout.fillMeansFrom(2, nodeValues());
  const bool correct = pass == Pass::correct;
  const CameraArrays camera = cameraArrays(correct ? held_.data() : wanted_.data());
  parallelFor(0, transport.patches().size(), 1, [&](std::size_t index) {
    const TransportPatch& patch = transport.patches()[index];
    const std::uint32_t* node = transport.nodes().data() + patch.columnBegin;
    const std::size_t columns = patch.columnEnd - patch.columnBegin;
    ScratchPool::BorrowedBuffer loan(scratch_);
    float* to = loan.data();
    constexpr std::size_t ahead = 32;
    for (std::size_t column = 0; column < columns; ++column, to += stepFloats) {
      if (column + ahead < columns) __builtin_prefetch(&nodes_[3 * std::size_t{node[column + ahead]}]);
      std::memcpy(to, &nodes_[3 * std::size_t{node[column]}], 4 * sizeof(float));
      std::memset(to + 4, 0, 4 * sizeof(float));
    }
    std::fill_n(to, stepFloats, 0.0f);  // what fills up rows
    (correct ? kernels_.correct : kernels_.step)(rowsOf(patch), camera, loan.data());
    patchSums_.addPatch(index, loan.data() + 4, stepFloats, adjoint_.data(), waiting_.data());
  });
  patchSums_.addStored(waiting_.data(), adjoint_.data());
  layout.gatherAboveLines(adjoint_);
}

void CpuBackend::passBack(float reach, std::vector<float>& sums) noexcept {
  const PackedTransport& transport = engine_.transport;
  const CameraArrays camera = cameraArrays(wanted_.data());
  parallelFor(0, transport.patches().size(), 1, [&](std::size_t index) {
    const TransportPatch& patch = transport.patches()[index];
    ScratchPool::BorrowedBuffer loan(scratch_);
    std::fill_n(loan.data(), sumFloats * (patch.columnEnd - patch.columnBegin + 1), 0.0f);
    kernels_.bound(rowsOf(patch), camera, reach, loan.data());
    patchSums_.addPatch(index, loan.data(), sumFloats, sums.data(), waiting_.data());
  });
  patchSums_.addStored(waiting_.data(), sums.data());
  engine_.venue.transport.layout().gatherMeansAdjoint(sums);
}

/// What frames need for C: T^T W T 1 while all content is reachable.
void CpuBackend::prepareBound() noexcept {
  for (std::size_t i = 0; i < reach_.size(); ++i)
    reach_[i] = content_->warp.inside(i) && content_->weight[i] > 0.0f ? 1.0f : 0.0f;
  passBack(1.0f, part_);
  largestBound_ = 0.0f;
  constexpr float notFree = -1e30f;  // so that C is 0
  for (std::size_t j = 0; j < bound_.size(); ++j) {
    bound_[j] = content_->free[j / 3] ? part_[j] : notFree;
    largestBound_ = std::max(largestBound_, bound_[j]);
  }
  kernels_.reciprocal(reachableC_.data(), bound_.data(), bound_.data(), 1.0f, 0.0f, leastBound(),
                      bound_.size());
  preconditioner_ = reachableC_.data();
  preconditionerScale_ = 1.0f;
}

/// What cannot be reached counts by a weight u, so
///   T^T W T 1 = bound + (u - 1) T^T (what cannot be reached) = u bound + (1 - u) T^T (what can):
/// only the fewer ones are passed back through T, most often none.
void CpuBackend::makePreconditioner() noexcept {
  const auto u = static_cast<float>(engine_.settings.target.unreachableWeight);
  const std::size_t fewer = std::min<std::size_t>(reachable_, unreachable_);
  // A weight of 0 tells nobody who cannot be reached from who is not there.
  const bool mostReachable = u > 0.0f && unreachable_ <= reachable_;
  const float share = mostReachable ? 1.0f : u;
  preconditioner_ = reachableC_.data();
  preconditionerScale_ = 1.0f;
  if (u == 1.0f || unreachable_ == 0) return;
  if (fewer == 0 && u > 0.0f) {
    preconditionerScale_ = 1.0f / u;
    return;
  }
  passBack(mostReachable ? u : 1.0f, part_);
  constexpr std::size_t parts = 64;
  parallelChunks(0, bound_.size(), parts, [&](std::size_t, std::size_t begin, std::size_t end) {
    kernels_.reciprocal(&frameC_[begin], &bound_[begin], &part_[begin], share,
                        mostReachable ? u - 1.0f : 1.0f - u, leastBound(), end - begin);
  });
  preconditioner_ = frameC_.data();
}

}  // namespace relucent::engine
