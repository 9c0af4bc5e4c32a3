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
  void contentFollowed() override;
  void availabilityFollowed() override;
  void startFrom(std::span<const float> projector) override;
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
  /// Gains of white, where they are not those of the frame before.
  void takeGains(const compensation::BrightnessField& field) noexcept;
  void warpOnly(OutputWords words) noexcept;
  /// What depends on weights and on what is free.
  void takeWeights();
  /// What depends on the light that arrives.
  void takeAvailable();
  /// The part of a projector pixel's light that may be used: 0 where it is not free.
  float shareOf(std::size_t pixel) const noexcept {
    const float free = content_->free[pixel] ? 1.0f : 0.0f;
    return content_->available.empty() ? free : free * content_->available[pixel];
  }
  /// The means of level 1 of what was projected last.
  void fillMeans() noexcept;
  /// p = clamp(M u).
  void invert() noexcept;
  /// p = clamp(p + m M u + a C adjoint) with the settings' shares m and a.
  void correct(OutputWords words) noexcept;
  /// p = clamp(p + length C adjoint).
  void refine(float length, OutputWords words) noexcept;
  /// p with its means; those of level 1 are kept up to date by whoever changes p for a pass through T.
  std::span<float> nodeValues() noexcept { return {nodes_.data(), nodes_.size() - 1}; }
  int pairsOfLines(std::size_t device) const noexcept;
  /// The update of a refine() or a correct() on two lines, and their words if requested, otherwise their
  /// means.
  void finishPair(Pass pass, std::size_t device, int pair, float length, OutputWords words) noexcept;
  void encodeLine(std::size_t device, int y, OutputWords words) const noexcept;
  void encodeAll(OutputWords words) const noexcept;
  /// One row of tiles of M u: put(p, values, count) for the lines of its tiles where something is free.
  template <typename Put>
  void putTiles(std::size_t device, std::size_t tileRow, bool clamped, const Put& put) noexcept;
  void findFreeTiles();

  /// C, of the correction's pass.
  void makePreconditioner() noexcept;
  void preconditionLine(std::size_t device, int y) noexcept;
  bool isDimmed(std::size_t device, int y) const noexcept {
    return !dimmed_.empty() && dimmed_[lineOf(device, y)] != 0;
  }
  std::size_t lineOf(std::size_t device, int y) const noexcept {
    return firstLine_[device] + static_cast<std::size_t>(y);
  }
  /// r = W (wanted - T p), the adjoint T^T r of all nodes, and for the correction u = U r and green of
  /// T^T W lit.
  void passThrough(Pass pass) noexcept;
  PatchRows rowsOf(const TransportPatch& patch) const noexcept;

  const EngineVenue& engine_;
  const EngineContent* content_ = nullptr;
  const EngineKernels& kernels_;
  std::string name_;
  inverse::WindowArrays windows_;
  std::array<float, 256> linearOfSrgb_{};

  // Per camera pixel, see ContentTarget.
  std::vector<float> known_, wanted_, held_, unmixed_, placed_;
  compensation::BrightnessField field_;  // whose gains are known
  std::vector<float> lit_;               // see CameraArrays
  std::vector<PackedMixings> unmix_;     // of every slice of T's rows
  // Node values: p with its means; and the adjoint sums, three of the residual and one of what is lit.
  std::vector<float> nodes_, adjoint_;
  PatchSums patchSums_;
  std::vector<float> waiting_;
  // Of projector pixels, what the latter must exceed; and C of the frame, of all values.
  std::vector<float> leastBound_, preconditioner_;
  ScratchPool scratch_, contentScratch_;
  WarpTiles warp_;
  enum class Free : std::uint8_t { none, some, all };
  std::vector<Free> freeOfTile_;        // of the windows' tiles
  std::vector<std::size_t> firstLine_;  // of each projector, and the number of all lines
  std::vector<std::uint8_t>
      dimmed_;  // per line of all projectors: less than all of some pixel's light arrives
  std::atomic<std::size_t> clipped_{0};
  std::size_t freeValues_ = 0;
  bool hasLast_ = false;  // nodes_ hold what was projected last
};

}  // namespace relucent::engine
