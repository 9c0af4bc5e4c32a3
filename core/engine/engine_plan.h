// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/compensation/methods.h"
#include "relucent/compensation/target.h"
#include "relucent/engine/content_warp.h"
#include "relucent/engine/drive_encoder.h"
#include "relucent/engine/packed_transport.h"
#include "relucent/inverse/windows.h"

namespace relucent::engine {

struct EngineSettings {
  compensation::TargetSettings target;  // where the content goes and how bright it is
  int bits = 8;                         // of the projectors' input: 8 or 10
  Dither dither = Dither::blueNoise;
  compensation::CompensatorSettings compensator;  // the correction of the windows, and the steps behind it
  PackingSettings packing;
};
std::vector<Message> problems(const EngineSettings& settings);

/// A venue as prepared for rendering. Back ends copy what they need in another form.
struct EngineVenue {
  const compensation::MeasuredVenue& venue;
  const inverse::WindowInverse& inverse;
  EngineSettings settings;
  PackedTransport transport;
  std::vector<std::int32_t> brightest;  // i*(j) of all views, see brightestCorrespondence()
  transport::ColourBlock mixing;        // K, see meanColourMixing()
  compensation::StepPreconditioner preconditioner;
  std::vector<DriveEncoder> encoders;  // one a projector
};

/// Prepares a venue. `responses`: one for each projector. `venue` and `inverse` must outlive the result.
/// Throws: Error{numerics} if measured values are not finite; std::logic_error if the inverse belongs to
/// another venue or settings are wrong.
EngineVenue prepareVenue(const compensation::MeasuredVenue& venue, const inverse::WindowInverse& inverse,
                         const std::vector<linearization::ProjectorResponse>& responses,
                         const EngineSettings& settings);

/// Content of one size as prepared for rendering: its placement and the projector pixels concerned.
struct EngineContent {
  ContentWarp warp;                 // into the cameras' views
  compensation::Corners corners{};  // where the content was placed
  float white = 0.0f;               // wanted signal of the content's white
  float blackLift = 0.0f;           // share of it that is added to black, at the least
  std::vector<std::array<float, 2>>
      place;           // per camera pixel: where it looks in the content, see placesInContent()
  ProjectorMask free;  // per projector pixel: it belongs to the content; the others are black
  std::vector<std::int32_t> brightest;  // i*(j), see contentCorrespondence()
  CameraStack lit;                // camera stack: the signal with all free projector pixels at full drive
  std::vector<float> weight;      // per camera pixel: of its view, the largest 1; 0 where it is not usable
  std::vector<float> viewWeight;  // per camera, of its view; the largest is 1
  std::vector<std::optional<compensation::Placement>> placements;  // as Target's
  std::uint64_t freeVersion = 0;  // another one where `free`, `brightest` and `lit` have changed
  // Of light that somebody stands in, see AvailabilityFollower; both empty: all arrives.
  std::vector<float> available;  // per projector pixel: a, 0 to 1
  CameraStack missing;           // camera stack: T (1 - a) of what is free
};

/// Prepares content of a size, placed as fitTarget() places it.
/// Throws: as fitTarget().
EngineContent prepareContent(const EngineVenue& engine, Size content);

}  // namespace relucent::engine
