// SPDX-License-Identifier: MIT
#include "relucent/engine/frame_cost.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/engine/bench/engine_bench.h"
#include "relucent/engine/bench/noise_content.h"

namespace relucent::engine {

FrameCost measureFrameCost(const compensation::MeasuredVenue& venue, Size content, Progress& progress,
                           BackendChoice choice) {
  Progress computing =
      progress.part(0.8, RELUCENT_MESSAGE("stage.windows", "Computing the windows of the inverse"));
  const inverse::WindowInverse inverse =
      inverse::computeWindows(venue.transport, venue.usable, {}, computing);
  Progress timing = progress.part(0.2, RELUCENT_MESSAGE("stage.timing-engine", "Timing the engine"));
  const std::vector<linearization::ProjectorResponse> responses(venue.transport.projectors().devices());
  const EngineVenue engine = prepareVenue(venue, inverse, responses, {});
  timing.checkpoint();
  const EngineContent prepared = prepareContent(engine, content);
  const std::unique_ptr<EngineBackend> backend = makeBackend(engine, choice, {});
  backend->setContent(prepared);
  const NoiseContent noise(content);
  std::vector<std::uint32_t> words(venue.transport.projectors().count());
  const auto secondsWith = [&](int steps) {
    // The best: other programs, and this one's other work, only add to it.
    return timedRuns([&] {
             timing.checkpoint();
             FrameReport report;
             FrameRequest request;
             request.steps = steps;
             if (!backend->render(noise.frame(), request, words, report))
               throw Error(ErrorKind::device,
                           RELUCENT_ENGLISH_MESSAGE("engine.device-lost-while-timed",
                                                    "the device was lost while it was timed"),
                           RELUCENT_ENGLISH_MESSAGE("engine.try-again", "try again"));
             return report.seconds.count();
           })
        .best;
  };
  FrameCost cost;
  cost.seconds = secondsWith(0);
  cost.stepSeconds = std::max(0.0, secondsWith(1) - cost.seconds);
  cost.device = backend->name();
  return cost;
}

}  // namespace relucent::engine
