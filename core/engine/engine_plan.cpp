// SPDX-License-Identifier: MIT
#include "relucent/engine/engine_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Per camera pixel the weight of its view as far as its row of T is relied on, 0 where it is not usable.
std::vector<float> weightsOf(const compensation::MeasuredVenue& venue, const compensation::Target& target) {
  const Rasters& cameras = venue.transport.cameras();
  std::vector<float> weight(cameras.count());
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera), end = begin + cameras.size(camera).count();
    for (std::size_t i = begin; i < end; ++i)
      weight[i] = target.viewWeight[camera] * compensation::relianceOn(venue, i) *
                  compensation::unmaskedShare(target, i);
  }
  return weight;
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
          compensation::StepPreconditioner(transport, venue.usable),
          std::move(encoders)};
}

CameraStack missingLight(const EngineVenue& engine, const ProjectorMask& free,
                         const std::vector<float>& available) {
  return engine.venue.transport.apply(compensation::stackOf<ProjectorStack>(
      3 * available.size(), [&](std::size_t i) { return free[i / 3] ? 1.0f - available[i / 3] : 0.0f; }));
}

EngineContent prepareContent(const EngineVenue& engine, Size content) {
  return prepareContent(engine, content, engine.settings.target);
}

EngineContent prepareContent(const EngineVenue& engine, Size content,
                             const compensation::TargetSettings& wanted) {
  require(!content.empty(), "content of {}x{} pixels", content.width, content.height);
  const std::vector<Message> wrong = problems(wanted);
  require(wrong.empty(), "target settings: {}", fmt::join(wrong, "; "));
  const compensation::MeasuredVenue& venue = engine.venue;
  // Where content goes and how bright its white is does not depend on what it shows.
  compensation::Target target = fitTarget(image::Image(content, 3), venue, wanted);
  EngineContent result;
  result.target = wanted;
  result.corners = target.corners;
  result.white = target.white[0];
  result.blackLift = static_cast<float>(target.blackLift);
  result.warp = ContentWarp(content, target.placements, venue.transport.cameras(), venue.views);
  result.weight = weightsOf(venue, target);
  result.viewWeight = target.viewWeight;
  result.placements = target.placements;
  const CameraStack places = placesInContent(venue, target);
  result.place.resize(places.size() / 3);
  for (std::size_t i = 0; i < result.place.size(); ++i) result.place[i] = {places[3 * i], places[3 * i + 1]};

  compensation::ContentCorrespondence correspondence = contentCorrespondence(
      venue.transport, seesProjection(venue), target, engine.brightest, compensation::DirectLightSettings{});
  result.free = std::move(correspondence.free);
  result.brightest = std::move(correspondence.brightest);
  auto lit = compensation::stackOf<ProjectorStack>(
      3 * result.free.size(), [&](std::size_t j) { return result.free[j / 3] ? 1.0f : 0.0f; });
  result.lit = venue.transport.apply(lit);
  result.masked = std::move(target.masked);
  result.kept = std::move(target.available);
  if (!result.kept.empty()) {
    result.available = result.kept;
    result.missing = missingLight(engine, result.free, result.kept);
  }
  return result;
}

}  // namespace relucent::engine
