// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <vector>

#include "relucent/engine/backend.h"
#include "relucent/engine/engine_kernels.h"
#include "relucent/engine/patch_sums.h"
#include "relucent/engine/scratch_pool.h"

namespace relucent::engine {

/// The engine on the processor: all cores, the widest available instructions. The same bits for every number
/// of threads. A frame allocates nothing.
class CpuBackend : public EngineBackend {
 public:
  /// `engine` must outlive it. `kernels`: none selects the fastest.
  explicit CpuBackend(const EngineVenue& engine, const EngineKernels* kernels = nullptr);

  std::string_view name() const override { return name_; }
  void setContent(const EngineContent& content) override;
  bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
              FrameReport& report) noexcept override;

  /// Linear drive of the last frame. Shape: projector stack.
  std::span<const float> projector() const { return {nodes_.data(), 3 * engine_.brightest.size()}; }

  /// The parts of a frame, for benchmarks: p = clamp(M u) and one step with its update.
  void applyWindows() noexcept { invert(); }
  void takeStep(float length) noexcept { refine(length, {}); }

 private:
  enum class Pass { correct, step };
  using OutputWords = std::span<std::uint32_t>;

  void placeContent(const ContentFrame& frame, const FrameRequest& request) noexcept;
  /// The target of some camera pixels, wanted = mixing c + offset, and its weight.
  void fitTarget(std::size_t begin, std::size_t end, const transport::ColourBlock& mixing,
                 float offset) noexcept;
  void warpOnly(OutputWords words) noexcept;
  /// p = clamp(M u).
  void invert() noexcept;
  /// p = clamp(p + m M u + a C adjoint) with the settings' shares m and a.
  void correct(OutputWords words) noexcept;
  /// p = clamp(p + length C adjoint).
  void refine(float length, OutputWords words) noexcept;
  /// The update of a refine() or a correct() on one line, and its words if requested.
  void finishLine(std::size_t device, int y, float length, OutputWords words) noexcept;
  void encodeLine(std::size_t device, int y, OutputWords words) const noexcept;
  /// One row of tiles of M u: put(p, value) for all its values where something is free.
  template <typename Put>
  void putTiles(std::size_t device, std::size_t tileRow, bool clamped, const Put& put) noexcept;

  /// r = W (wanted - T p), the adjoint T^T r of all nodes, and for the correction u = U r.
  void passThrough(Pass pass) noexcept;
  /// `sums` = T^T lit of all nodes, only of the camera pixels with that reach.
  void passBack(float reach, std::vector<float>& sums) noexcept;
  void prepareBound() noexcept;
  /// Without this limit, projector pixels that hardly any weighted pixel sees would take arbitrarily long
  /// steps because of rounding errors.
  float leastBound() const noexcept { return 1e-7f * largestBound_; }
  void makePreconditioner() noexcept;
  PatchRows rowsOf(const TransportPatch& patch) const noexcept;
  CameraArrays cameraArrays(const float* wanted) noexcept;

  const EngineVenue& engine_;
  const EngineContent* content_ = nullptr;
  const EngineKernels& kernels_;
  std::string name_;
  inverse::WindowArrays windows_;
  std::array<float, 256> linearOfSrgb_{};

  // Camera stacks.
  std::vector<float> wanted_, held_, weight_, unmixed_, placed_;
  // Where views differ in weight: `weight_` without the views' share, and their share of what is lit.
  std::vector<float> reach_, weightedLit_;
  // Node values: p with its means, and the adjoint sums of the residual or of a part of the lit pixels.
  std::vector<float> nodes_, adjoint_, part_;
  PatchSums patchSums_;
  std::vector<float> waiting_;
  // Projector values: T^T W lit while all content is reachable, C then and C of the frame.
  std::vector<float> bound_, reachableC_, frameC_;
  float largestBound_ = 0.0f;
  const float* preconditioner_ = nullptr;  // C = scale * preconditioner
  float preconditionerScale_ = 1.0f;
  ScratchPool scratch_;
  std::atomic<std::size_t> clipped_{0}, reachable_{0}, unreachable_{0};
  std::size_t freeValues_ = 0;
};

}  // namespace relucent::engine
