// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string_view>

#include "relucent/engine/content_frame.h"
#include "relucent/engine/engine_plan.h"

namespace relucent::engine {

/// Parameters of one frame.
struct FrameRequest {
  bool compensated = true;  // false: only warped into place, with the best single brightness
  int steps = 2;            // K: number of refinement steps
  float brightness = 1.0f;  // of the content's white, relative to the target's
  float blackLift = 0.0f;   // share of white added to black, where that is more than the content's own
  /// Starts from what was projected last instead of from the windows, where there is something: no M and no
  /// correction, only the steps, from the first on, so that what is wanted now grows in none of them.
  bool fromLast = false;
  const compensation::BrightnessField* field = nullptr;  // gains of white over the content; none: 1
};

/// Timing and statistics of a frame.
struct FrameReport {
  int steps = 0;
  double clipped = 0.0;  // share of the content's projector values that the projector's limits cut off
  std::chrono::duration<double> seconds{};      // the whole frame
  std::chrono::duration<double> stepSeconds{};  // all its refinement steps
};

/// Computes projector pictures from content, frame by frame.
class EngineBackend {
 public:
  virtual ~EngineBackend() = default;

  /// Name of the device, for display: "CPU, AVX2, FMA".
  virtual std::string_view name() const = 0;
  /// Switches to content of another size. May allocate. `content` must outlive its use.
  /// Throws: Error{device} if the device is out of memory or gone.
  virtual void setContent(const EngineContent& content) = 0;
  /// Takes over what ViewFollower changed in the content that was set; what was projected last stays.
  /// Throws: as setContent().
  virtual void contentFollowed() = 0;
  /// Takes over what AvailabilityFollower changed; of what was projected last that stays which may.
  /// Throws: as setContent().
  virtual void availabilityFollowed() = 0;
  /// What counts as projected last: a projector stack, 0 to 1, of which a pixel has as much as is available.
  /// Throws: as setContent().
  virtual void startFrom(std::span<const float> projector) = 0;
  /// One frame. `frame.size` must be what setContent() was given. `words`: one 32-bit word for each pixel of
  /// all projectors in turn, see DriveEncoder. False: the device was lost, `words` are invalid.
  virtual bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
                      FrameReport& report) noexcept = 0;

  /// Whether there is renderToTextures(): the device's context is a host's (gl_host.h).
  virtual bool sharesTextures() const { return false; }
  /// The same words as textures of the host: RGBA8, one for each projector, of its size. They are complete
  /// when this returns. Contract: sharesTextures(), drive of 8 bits. False: the device was lost.
  virtual bool renderToTextures(const ContentFrame& /*frame*/, const FrameRequest& /*request*/,
                                std::span<const std::uint32_t> /*textures*/,
                                FrameReport& /*report*/) noexcept {
    return false;
  }
};

}  // namespace relucent::engine
