// SPDX-License-Identifier: MIT
#include "relucent/engine/engine_plan.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/compensation/correspondence.h"
#include "relucent/compensation/stacks.h"

namespace relucent::engine {
namespace {

void checkFinite(const Stack& values, const char* what) {
  for (float value : values)
    if (!std::isfinite(value))
      throw Error(ErrorKind::numerics,
                  RELUCENT_ENGLISH_MESSAGE("engine.values-not-finite", "{} holds values that are not finite")
                      .with(what),
                  RELUCENT_ENGLISH_MESSAGE("compensation.measure-venue-again", "measure the venue again"));
}

compensation::Placement placementOf(const EngineVenue& engine, Size content,
                                    const compensation::Corners& chosen) {
  const compensation::TargetSettings& target = engine.settings.target;
  if (!target.corners) return {chosen, {}};
  return fitted(*target.corners, static_cast<double>(content.width) / content.height, target.fit);
}

}  // namespace

std::vector<Message> problems(const EngineSettings& settings) {
  std::vector<Message> found = problems(settings.target);
  for (const Message& problem : problems(settings.compensator)) found.push_back(problem);
  if (settings.bits != 8 && settings.bits != 10)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("engine.projector-bits-unsupported", "a projector takes 8 or 10 bits"));
  if (settings.packing.patchSide < 8 || settings.packing.patchSide > 256)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("engine.patch-side-out-of-range",
                                 "the patches of the light transport must be 8 to 256 camera pixels wide"));
  return found;
}

EngineVenue prepareVenue(const compensation::MeasuredVenue& venue, const inverse::WindowInverse& inverse,
                         const std::vector<linearization::ProjectorResponse>& responses,
                         const EngineSettings& settings) {
  auto wrong = problems(settings);
  require(wrong.empty(), "engine settings: {}", fmt::join(wrong, "; "));
  const transport::TransportMatrix& transport = venue.transport;
  require(inverse.cameras() == transport.cameras() && inverse.projectors() == transport.projectors(),
          "the inverse belongs to another venue");
  require(responses.size() == transport.projectors().devices(), "{} responses for {} projectors",
          responses.size(), transport.projectors().devices());
  std::size_t pixels = transport.cameras().count();
  require(
      venue.black.size() == 3 * pixels && venue.flood.size() == 3 * pixels && venue.usable.size() == pixels,
      "{} black, {} flood values and {} flags for {} camera pixels", venue.black.size(), venue.flood.size(),
      venue.usable.size(), pixels);
  checkFinite(venue.black, "the black level");
  checkFinite(venue.flood, "the flood image");
  for (std::size_t row = 0; row < pixels; ++row)
    if (!std::isfinite(transport.ownLeaves().scale(row)))
      throw Error(ErrorKind::numerics,
                  RELUCENT_ENGLISH_MESSAGE("engine.transport-not-finite",
                                           "the light transport holds values that are not finite"),
                  RELUCENT_ENGLISH_MESSAGE("compensation.measure-venue-again", "measure the venue again"));

  std::vector<DriveEncoder> encoders;
  for (const linearization::ProjectorResponse& response : responses)
    encoders.emplace_back(response, settings.bits, settings.dither);
  return {venue,
          inverse,
          settings,
          PackedTransport(transport, settings.packing),
          compensation::brightestCorrespondence(transport, compensation::seesProjection(venue),
                                                compensation::DirectLightSettings{}),
          compensation::meanColourMixing(venue),
          std::move(encoders)};
}

EngineContent prepareContent(const EngineVenue& engine, Size content) {
  require(!content.empty(), "content of {}x{} pixels", content.width, content.height);
  const compensation::MeasuredVenue& venue = engine.venue;
  // Where content goes and how bright its white is does not depend on what it shows.
  compensation::Target target = fitTarget(image::Image(content, 3), venue, engine.settings.target);
  EngineContent result;
  result.corners = target.corners;
  result.white = target.white[0];
  result.warp = ContentWarp(content, placementOf(engine, content, target.corners),
                            venue.transport.cameras().size(0), venue.views);

  result.free = compensation::contentPixels(engine.brightest, target);
  auto lit = compensation::stackOf<ProjectorStack>(
      3 * result.free.size(), [&](std::size_t j) { return result.free[j / 3] ? 1.0f : 0.0f; });
  result.lit = venue.transport.apply(lit);
  return result;
}

}  // namespace relucent::engine
