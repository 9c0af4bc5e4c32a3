// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
  std::vector<float> weight;      // per camera pixel: of its view, at most 1, by its trust; 0 where unusable
  std::vector<float> viewWeight;  // per camera, of its view; the largest is 1
  std::vector<std::optional<compensation::Placement>> placements;  // as Target's
  std::uint64_t freeVersion = 0;  // another one where `free`, `brightest` and `lit` have changed
  // Of light that a mask takes or that somebody stands in, see AvailabilityFollower; both empty: all is used.
  std::vector<float> available;  // per projector pixel: a, 0 to 1
  CameraStack missing;           // camera stack: T (1 - a) of what is free
  // Of masks alone, see compensation::maskedLight(); both empty: there are none.
  std::vector<float> kept;    // per projector pixel: a
  std::vector<float> masked;  // per camera pixel: s
  // Which error of it the steps make small, and how it is held to what can be had.
  compensation::TargetSettings target{};

  /// 1 - s of a camera pixel: what is wanted there, and its weight, are that much of what they were.
  float unmaskedShare(std::size_t pixel) const { return masked.empty() ? 1.0f : 1.0f - masked[pixel]; }
  /// a of masks.
  float keptOf(std::size_t pixel) const { return kept.empty() ? 1.0f : kept[pixel]; }
  /// What of a value that is projected, by what masks leave, is when somebody stands in the light besides.
  float availableOf(std::size_t pixel, float value) const {
    if (available.empty()) return value;
    const float most = keptOf(pixel);
    return most > 0.0f ? available[pixel] / most * std::min(value, most) : 0.0f;
  }
};

/// T (1 - a) of what is free.
CameraStack missingLight(const EngineVenue& engine, const ProjectorMask& free,
                         const std::vector<float>& available);

/// Prepares content of a size, placed as fitTarget() places it: by the venue's settings, or by another target
/// in their place, so that one venue shows several in turn (EngineBackend::setContent()).
/// Throws: as fitTarget(); std::logic_error for a wrong target.
EngineContent prepareContent(const EngineVenue& engine, Size content);
EngineContent prepareContent(const EngineVenue& engine, Size content,
                             const compensation::TargetSettings& target);

}  // namespace relucent::engine
