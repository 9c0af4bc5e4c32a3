// SPDX-License-Identifier: MIT
// The stages of a frame, as dispatches.
#include <algorithm>
#include <array>

#include "relucent/engine/opengl/backend_objects.h"
#include "relucent/engine/opengl/gl_context.h"

namespace relucent::engine {
namespace {

constexpr std::size_t group = GlProgram::group;

void bindAll(std::initializer_list<const GlBuffer*> buffers) noexcept {
  unsigned binding = 0;
  for (const GlBuffer* buffer : buffers) buffer->bind(binding++);
}

std::uint32_t unsignedOf(int value) {
  return static_cast<std::uint32_t>(value);
}

}  // namespace

void OpenGlBackend::Objects::render(const ContentFrame& picture, const FrameRequest& request,
                                    int steps) noexcept {
  place(picture, request);
  if (request.compensated) {
    const bool goesOn = request.fromLast && hasLast;
    invert(goesOn ? Inversion::last : Inversion::first);
    passThrough(true);
    spread(true, 0.0f);
    invert(goesOn ? Inversion::last : Inversion::correction);
    const std::vector<float>& lengths = engine.settings.compensator.steps;
    refining.take();
    for (int step = 0; step < steps; ++step) takeStep(lengths[static_cast<std::size_t>(step)]);
    refined.take();
  } else {
    showPlaced();
  }
  encode();
  hasLast = request.compensated;
}

void OpenGlBackend::Objects::upload(const ContentFrame& picture) noexcept {
  const std::size_t line = static_cast<std::size_t>(picture.size.width) * bytesPerPixel(picture.format);
  const auto* from = static_cast<const unsigned char*>(picture.data);
  const auto height = static_cast<std::size_t>(picture.size.height);
  frame.forget();
  if (picture.bytesPerLine == line) {
    frame.write(0, from, line * height);
    return;
  }
  for (std::size_t y = 0; y < height; ++y) frame.write(line * y, from + picture.bytesPerLine * y, line);
}

void OpenGlBackend::Objects::place(const ContentFrame& picture, const FrameRequest& request) noexcept {
  upload(picture);
  const compensation::BrightnessField wish =
      request.field != nullptr ? *request.field : compensation::BrightnessField();
  if (wish != field) {
    field = wish;
    linearOfSrgb.write(256 * sizeof(float), field.octaves.data(), sizeof field.octaves);
  }
  bindAll({&frame, &footprints, &weights, &camera, &wanted, &unmixed, &placed, &linearOfSrgb});
  placing.set(1, static_cast<std::uint32_t>(picture.format));
  placing.set(2, static_cast<std::size_t>(picture.size.width) * bytesPerPixel(picture.format));
  placing.set(3, content->white * request.brightness);
  placing.set(4, std::max(content->blackLift, request.blackLift));
  placing.set(5, unreachableWeightOf(content->target));
  placing.setMatrix(6, engine.mixing.data());
  const float white = content->white * request.brightness;
  const bool isHeld = content->target.objective == compensation::Objective::seen && white > 0.0f;
  std::array<float, 3> luminance{};
  for (std::size_t c = 0; c < 3 && isHeld; ++c) luminance[c] = image::luminanceWeights[c] / white;
  placing.set(7, luminance);
  placing.set(8, compensation::sensitivityOffset);
  placing.set(9, isHeld);
  placing.set(10, compensation::sharedLoss(content->target.clipping));
  for (const Batch& batch : cameraBatches) {
    camera.bind(3, batch.part.begin, batch.part.bytes);
    placing.set(0, batch.count);
    placing.set(11, batch.first);
    placing.run(batch.count);
  }
}

void OpenGlBackend::Objects::showPlaced() noexcept {
  constexpr std::size_t parts = 64;
  bindAll({&brightnessParts, &camera, &wanted, &placed});
  for (const Batch& batch : cameraBatches) {
    camera.bind(1, batch.part.begin, batch.part.bytes);
    brightness.set(0, batch.count);
    brightness.set(1, batch.first);
    brightness.run(parts * group);
  }
  brightnessLast.run(group);
  bindAll({&brightest, &placed, &brightnessParts, &light, &kept});
  showing.set(0, projectorPixels);
  showing.run(projectorPixels);
  counters.clear();
}

void OpenGlBackend::Objects::invert(Inversion which) noexcept {
  const compensation::CompensatorSettings& settings = engine.settings.compensator;
  const inverse::WindowArrays arrays = engine.inverse.view();
  const Rasters& projectors = engine.venue.transport.projectors();
  const GlProgram& program = which == Inversion::first  ? windows
                             : which == Inversion::last ? windowsOfLast
                                                        : windowsCorrected;
  if (which != Inversion::first) {
    counters.clear();
    program.set(10, nodeCount);
    program.set(11, engine.preconditioner.least());
    program.set(12, compensation::StepPreconditioner::nextToNothing);
  }
  if (which == Inversion::correction) {
    program.set(8, static_cast<float>(settings.correctionByInverse));
    program.set(9, static_cast<float>(settings.correctionByAdjoint));
  }
  bindAll({&tiles, &windowRows, &windowWeights, &unmixed, &light, &nodeLight, &sums, &counters});
  program.set(4, unsignedOf(arrays.tile));
  const std::size_t pairs = static_cast<std::size_t>(arrays.tile * arrays.tile) / 2;
  for (const Batch& batch : tileBatches) {
    const Size size = projectors.size(batch.projector);
    windowWeights.bind(2, batch.part.begin, batch.part.bytes);
    program.set(0, batch.first);
    program.set(1, batch.count);
    program.set(2, arrays.tiles->offset(batch.projector));
    program.set(3, unsignedOf(arrays.tiles->size(batch.projector).width));
    program.set(5, unsignedOf(size.width), unsignedOf(size.height));
    program.set(6, projectors.offset(batch.projector));
    program.set(7, batch.part.begin / sizeof(std::uint32_t));
    program.run(pairs * batch.count);
  }
}

void OpenGlBackend::Objects::passThrough(bool correction) noexcept {
  const transport::NodeLayout& layout = engine.venue.transport.layout();
  nodeLight.bind(0);
  for (int level = 1; level < layout.levels(); ++level) {
    for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector) {
      if (level >= layout.levels(projector)) continue;
      const Size pixels = layout.projectors().size(projector), grid = layout.gridSize(projector, level);
      const int device = static_cast<int>(projector);
      means.set(0, unsignedOf(pixels.width), unsignedOf(pixels.height));
      means.set(1, 1u << level);
      means.set(2, unsignedOf(grid.width), unsignedOf(grid.height));
      means.set(3, layout.index({device, level, 0, 0}));
      means.set(4, unsignedOf(layout.gridSize(projector, level - 1).width));
      means.set(5, layout.index({device, level - 1, 0, 0}));
      means.run(grid.count());
    }
  }
  bindAll({&nodes, &nodeLight, &columnLight});
  gather.set(0, columns);
  gather.run(columns);

  auto overSlices = [](const GlProgram& program, const Slices& slices, const auto& bindMore) {
    for (const Batch& batch : slices.batches) {
      slices.leaves.bind(1, batch.part.begin, batch.part.bytes);
      program.set(0, batch.first);
      program.set(1, batch.count);
      program.set(2, batch.part.begin / (LeafSlices::lanes * sizeof(PackedLeaf)));
      bindMore(batch);
      program.run(LeafSlices::lanes * batch.count);
    }
  };
  const auto nothingMore = [](const Batch&) {};
  bindAll({&groupForward.slices, &groupForward.leaves, &columnLight, &groups, &groupLight});
  overSlices(groupForwardBoth, groupForward, nothingMore);
  bindAll({&groups, &groupLight, &columnLight});
  groupLightBoth.set(0, groupSlots);
  groupLightBoth.set(1, columns);
  groupLightBoth.run(groupSlots);

  const GlProgram& rowsForward = correction ? forwardCorrected : forwardStep;
  bindAll({&forward.slices, &forward.leaves, &columnLight, &rows, &wanted, &back, &camera, &unmixed});
  rowsForward.set(3, columns);
  overSlices(rowsForward, forward, [&](const Batch& batch) {
    rows.bind(3, batch.rows.begin, batch.rows.bytes);
    if (!correction) return;
    camera.bind(6, batch.camera.begin, batch.camera.bytes);
    rowsForward.set(4, batch.camera.begin / bytesKnown);
  });

  const GlProgram& groupsBack = correction ? groupBackwardCorrected : groupBackwardStep;
  bindAll({&groups, &groupBack, &back});
  groupsBack.set(0, groupSlots);
  groupsBack.run(groupSlots);
  bindAll({&backward.slices, &backward.leaves, &back, &segmentSums});
  overSlices(correction ? backwardCorrected : backwardStep, backward, nothingMore);

  bindAll({&nodeStart, &segments, &segmentSums, &sums, &longNodes});
  sum.set(0, nodeCount);
  sum.set(1, SlicedTransport::longNode);
  sum.run(nodeCount);
  sumLong.set(0, longCount);
  sumLong.run(group * longCount);
}

void OpenGlBackend::Objects::spread(bool correction, float length) noexcept {
  const transport::NodeLayout& layout = engine.venue.transport.layout();
  const GlProgram& program = correction ? spreadCorrected : spreadStep;
  bindAll({&sums, &light, &counters, &nodeLight});
  if (!correction) {
    counters.clear();
    program.set(0, length);
    program.set(36, nodeCount);
  }
  for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector) {
    const Size size = layout.projectors().size(projector);
    std::array<std::uint32_t, 64> levels{};
    for (int level = 0; level < layout.levels(projector); ++level) {
      auto place = 2 * static_cast<std::size_t>(level);
      levels[place] = static_cast<std::uint32_t>(layout.index({static_cast<int>(projector), level, 0, 0}));
      levels[place + 1] = unsignedOf(layout.gridSize(projector, level).width);
    }
    program.set(1, layout.projectors().offset(projector));
    program.set(2, unsignedOf(size.width), unsignedOf(size.height));
    program.set(3, unsignedOf(layout.levels(projector)));
    program.setPairs(4, levels);
    program.run(size.count());
  }
}

void OpenGlBackend::Objects::takeStep(float length) noexcept {
  passThrough(false);
  spread(false, length);
}

void OpenGlBackend::Objects::encode() noexcept {
  const Rasters& projectors = engine.venue.transport.projectors();
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    const DriveEncoder& encoder = engine.encoders[projector];
    const Encoder& tables = encoders[projector];
    const Size size = projectors.size(projector);
    bindAll({&light, &tables.first, &tables.lights, &tables.middles, &tables.thresholds, &words});
    encoding.set(0, projectors.offset(projector));
    encoding.set(1, unsignedOf(size.width), unsignedOf(size.height));
    encoding.set(2, unsignedOf(encoder.bits()));
    encoding.set(3, !encoder.thresholds().empty());
    encoding.set(4, DriveEncoder::steps);
    encoding.set(5, DriveEncoder::knee);
    encoding.set(6, unsignedOf(DriveEncoder::shift));
    encoding.set(7, unsignedOf(encoder.mostPerStep()));
    encoding.run(size.count());
  }
}

double OpenGlBackend::applyWindows() noexcept {
  GlContext::Current current(*context_);
  objects_->refining.take();
  objects_->invert(Objects::Inversion::first);
  objects_->refined.take();
  return objects_->refined.seconds() - objects_->refining.seconds();
}

double OpenGlBackend::takeStep(float length) noexcept {
  GlContext::Current current(*context_);
  objects_->refining.take();
  objects_->takeStep(length);
  objects_->refined.take();
  return objects_->refined.seconds() - objects_->refining.seconds();
}

std::size_t OpenGlBackend::transportBytes() const {
  return objects_->transportBytes();
}

double OpenGlBackend::copyBandwidth() {
  GlContext::Current current(*context_);
  const std::size_t bytes = std::min(std::size_t{1} << 28, GlBuffer::largest() / 16 * 16);
  constexpr std::size_t bytesOfAnInvocation = 16;
  constexpr int copies = 8;
  const GlProgram program(shaders::copy);
  const GlBuffer from(bytes), to(bytes);
  const GlTimestamp begin = GlTimestamp::make(), end = GlTimestamp::make();
  bindAll({&from, &to});
  program.set(0, bytes / bytesOfAnInvocation);
  double best = 0.0;
  for (int copy = 0; copy < copies; ++copy) {
    begin.take();
    program.run(bytes / bytesOfAnInvocation);
    end.take();
    best = std::max(best, 2.0 * static_cast<double>(bytes) / (end.seconds() - begin.seconds()));
  }
  return best;
}

}  // namespace relucent::engine
