// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>

#include "relucent/engine/backend.h"

namespace relucent::engine {

class GlContext;

/// The engine on a graphics card, in compute shaders of OpenGL 4.3. Deterministic on the same device and
/// driver. A frame allocates nothing here, although drivers may. May be used by any thread, one at a time.
class OpenGlBackend : public EngineBackend {
 public:
  /// `engine` must outlive it. `mostBound`: bytes of T, M and what camera pixels are known by that a shader
  /// is given at once, where the device allows for more: for tests. Throws: Error{device} if the driver
  /// rejects the shaders, or the device's memory does not hold T and M.
  OpenGlBackend(const EngineVenue& engine, std::unique_ptr<GlContext> context,
                std::size_t mostBound = std::numeric_limits<std::size_t>::max());
  ~OpenGlBackend() override;

  std::string_view name() const override { return name_; }
  void setContent(const EngineContent& content) override;
  void contentFollowed() override;
  void availabilityFollowed() override;
  void startFrom(std::span<const float> projector) override;
  bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
              FrameReport& report) noexcept override;
  bool sharesTextures() const override;
  /// To textures of its context, which is nobody else's where it is not a host's.
  bool renderToTextures(const ContentFrame& frame, const FrameRequest& request,
                        std::span<const std::uint32_t> textures, FrameReport& report) noexcept override;

  /// The parts of a frame, for benchmarks: p = clamp(M u) and one step. Return seconds on the device's clock.
  double applyWindows() noexcept;
  double takeStep(float length) noexcept;
  /// Bytes of T that a step reads: by camera pixels and by nodes.
  std::size_t transportBytes() const;
  /// Bytes read and written per second when the device copies its memory. Throws: Error{device}.
  double copyBandwidth();

  /// Simulates a lost device. For tests.
  void loseDevice() { lost_ = true; }

 private:
  struct Objects;
  [[noreturn]] void throwLost() const;
  /// `deliver` takes the words of a frame that has been computed.
  template <typename Deliver>
  bool renderTo(const ContentFrame& frame, const FrameRequest& request, const Deliver& deliver,
                FrameReport& report) noexcept;

  std::unique_ptr<GlContext> context_;
  std::string name_;
  std::unique_ptr<Objects> objects_;  // of OpenGL: made and destroyed while the context is current
  bool lost_ = false;
};

}  // namespace relucent::engine
