// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <vector>

#include "engine/backend.h"
#include "engine/engine_kernels.h"
#include "engine/scratch_pool.h"

namespace relucent {

/// The engine on the processor: all cores, the widest instructions that there are. The same bits for every
/// number of threads. A frame allocates nothing.
class CpuBackend : public EngineBackend {
 public:
  /// `engine` must outlive it. `kernels`: none is the quickest.
  explicit CpuBackend(const EngineVenue& engine, const EngineKernels* kernels = nullptr);

  std::string_view name() const override { return name_; }
  void setContent(const EngineContent& content) override;
  bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
              FrameReport& report) noexcept override;

  /// Linear drive of the last frame. Shape: projector stack.
  std::span<const float> projector() const { return {nodes_.data(), 3 * engine_.brightest.size()}; }

  /// The parts of a frame, for benchmarks: p = clamp(M u) and one step with its update.
  void applyWindows() noexcept { invert(false); }
  void takeStep(float length) noexcept { refine(length); }

 private:
  /// Some columns of one patch that lie in one range of nodes.
  struct Piece {
    std::uint32_t begin, end;  // of PackedTransport::nodes()
  };
  enum class Pass { correct, step };

  void placeContent(const ContentFrame& frame, const FrameRequest& request) noexcept;
  void warpOnly() noexcept;
  /// p = clamp(M u), or p = clamp(p + m M u + a C adjoint) with the settings' shares m and a.
  void invert(bool correction) noexcept;
  /// r = W (wanted - T p), the adjoint T^T r of all nodes, and for the correction C and u = U r.
  void passThrough(Pass pass) noexcept;
  void sumPatches(Pass pass) noexcept;
  void makePreconditioner() noexcept;
  void refine(float length) noexcept;
  /// p = clamp(p + length C adjoint), and how many values that cut off.
  void update(float length) noexcept;
  void encode(std::span<std::uint32_t> words) const noexcept;

  const EngineVenue& engine_;
  const EngineContent* content_ = nullptr;
  const EngineKernels& kernels_;
  std::string name_;
  WindowArrays windows_;
  std::array<float, 256> linearOfSrgb_{};

  // Camera stacks.
  std::vector<float> wanted_, held_, weight_, unmixed_, placed_;
  // Node values: p with its means, what comes back of the residual, and C^-1 on its way to C.
  std::vector<float> nodes_, adjoint_, bound_;
  std::vector<float> sums_;  // 8 for every column of every patch
  std::vector<float> free_;  // per projector value: 1 or 0
  ScratchPool scratch_;
  std::vector<std::uint32_t> rangeStart_;  // pieces of range r: [rangeStart_[r], rangeStart_[r + 1])
  std::vector<Piece> piece_;
  std::atomic<std::size_t> clipped_{0};
  std::size_t freeValues_ = 0;
};

}  // namespace relucent
