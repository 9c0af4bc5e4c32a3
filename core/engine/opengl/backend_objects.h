// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/engine/opengl/gl_objects.h"
#include "relucent/engine/opengl/opengl_backend.h"
#include "relucent/engine/opengl/shaders.h"
#include "relucent/engine/opengl/sliced_transport.h"

namespace relucent::engine {

/// What a camera pixel is known by: six vectors, see common.glsl.
inline constexpr std::size_t knownFloats = 24, bytesKnown = knownFloats * sizeof(float);

/// Buffers and programs of a frame on a graphics card, and its stages. The context must be current in all
/// calls.
struct OpenGlBackend::Objects {
  Objects(const EngineVenue& engine, std::size_t mostBound);

  void setContent(const EngineContent& content);
  /// What depends on what is free; `last`: with what was projected last.
  void takeFree(std::span<const float> last);
  void takeLight(std::span<const float> last);
  /// What was projected last. Waits for the graphics card.
  std::vector<float> lastLight();
  void takeWeights() noexcept;
  void render(const ContentFrame& frame, const FrameRequest& request, int steps) noexcept;
  void place(const ContentFrame& frame, const FrameRequest& request) noexcept;
  void upload(const ContentFrame& frame) noexcept;
  void showPlaced() noexcept;
  enum class Inversion { first, correction, last };
  /// p = clamp(M u), or with the correction; last: p as it is, with what follows from it, and C.
  void invert(Inversion which) noexcept;
  /// The residual and its adjoint sums of all nodes.
  void passThrough(bool correction) noexcept;
  /// Adds the adjoint sums of coarser nodes to their pixels, and ends a step by an update of p.
  void spread(bool correction, float length) noexcept;
  void takeStep(float length) noexcept;
  void encode() noexcept;
  std::size_t transportBytes() const {
    std::size_t bytes = rows.bytes() + groups.bytes() + groupBack.bytes() + nodes.bytes() +
                        nodeStart.bytes() + segments.bytes();
    for (const Slices* slices : {&forward, &groupForward, &backward})
      bytes += slices->leaves.bytes() + slices->slices.bytes();
    return bytes;
  }

  /// Part of a buffer that a shader can bind at once.
  struct Part {
    std::size_t begin = 0, bytes = 0;
  };
  struct Batch {
    std::size_t first, count;  // tiles, slices or camera pixels
    Part part;                 // of the buffer that is bound in parts
    std::size_t projector = 0;
    // Of slices of camera pixels: their rows, and the range of pixels that these are of.
    Part rows{}, camera{};
  };
  struct Slices {
    Slices() = default;
    Slices(const LeafSlices& from, std::size_t most) : Slices(from, {}, most) {}
    Slices(const LeafSlices& from, const std::vector<SlicedTransport::Row>& rows, std::size_t most);
    GlBuffer slices, leaves;
    std::vector<Batch> batches;
  };
  struct Encoder {
    GlBuffer first, lights, middles, thresholds;
  };

  const EngineVenue& engine;
  const EngineContent* content = nullptr;

  GlProgram placing{shaders::place, {"WEIGHTS"}};
  GlProgram windows{shaders::windows}, windowsCorrected{shaders::windows, {"CORRECTION"}},
      windowsOfLast{shaders::windows, {"CORRECTION", "LAST"}};
  GlProgram means{shaders::means}, gather{shaders::gather};
  GlProgram groupForwardBoth{shaders::group_forward}, groupLightBoth{shaders::group_light};
  GlProgram groupBackwardStep{shaders::group_backward},
      groupBackwardCorrected{shaders::group_backward, {"CORRECTION"}};
  GlProgram forwardStep{shaders::forward}, forwardCorrected{shaders::forward, {"CORRECTION"}};
  GlProgram backwardStep{shaders::backward}, backwardCorrected{shaders::backward, {"CORRECTION"}};
  GlProgram sum{shaders::sum_nodes}, sumLong{shaders::sum_nodes, {"LONG"}};
  GlProgram spreadStep{shaders::spread}, spreadCorrected{shaders::spread, {"CORRECTION"}};
  GlProgram brightness{shaders::brightness, {"WEIGHTS"}}, brightnessLast{shaders::brightness, {"LAST"}};
  GlProgram showing{shaders::show_placed}, encoding{shaders::encode};

  GlBuffer tiles, windowRows, windowWeights;
  std::vector<Batch> tileBatches, cameraBatches;
  Slices forward, groupForward, backward;
  GlBuffer rows, groups, groupBack, nodes, nodeStart, segments, longNodes;
  std::size_t columns = 0, groupSlots = 0, longCount = 0, nodeCount = 0, cameraPixels = 0,
              projectorPixels = 0;
  std::size_t freeValues = 0;
  std::uint64_t freeVersion = 0;  // EngineContent's
  bool hasLast = false;           // `light` holds what was projected last

  // Six vectors a camera pixel, see common.glsl; `known` is the content of `camera`.
  std::vector<float> known;
  GlBuffer camera, wanted, unmixed, placed;
  GlBuffer light, nodeLight, columnLight, groupLight, back, segmentSums, sums;
  GlBuffer counters, brightnessParts, brightest, kept, words, linearOfSrgb;
  GlBuffer frame, footprints, weights;
  compensation::BrightnessField field;  // behind linearOfSrgb
  std::vector<Encoder> encoders;
  GlTimestamp refining = GlTimestamp::make(), refined = GlTimestamp::make();
};

}  // namespace relucent::engine
