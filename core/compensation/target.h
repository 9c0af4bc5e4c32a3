// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/compensation/placement.h"
#include "relucent/compensation/viewer.h"
#include "relucent/compensation/views.h"
#include "relucent/image/image.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::compensation {

/// The measured venue, as compensation needs it.
struct MeasuredVenue {
  transport::TransportMatrix transport;
  CameraStack black;  // e
  CameraStack flood;  // T 1 as photographed, minus e
  CameraMask usable;  // per camera pixel: lit by the projector and not flagged
  /// Per camera pixel: directly lit, see directlyLit(). Empty: all of them.
  CameraMask direct{};
  /// Where the content of the first camera's view lies in the others', see viewMap(). Empty: in none.
  ViewMap views{};
};

/// Per pixel of all cameras: usable, and directly lit.
CameraMask seesProjection(const MeasuredVenue& venue);
/// A camera's pixels that content may cover if no corners are given: its seesProjection().
CameraMask placeable(const MeasuredVenue& venue, std::size_t camera = 0);

/// Where content lies in the view of a camera beyond the first.
enum class ViewPlacement { surface, own };
inline constexpr EnumName<ViewPlacement> viewPlacementNames[]{
    {ViewPlacement::surface, "surface", "on the surface, where the first camera's content lies"},
    {ViewPlacement::own, "own", "in a quadrilateral of its own"}};
constexpr EnumNames<ViewPlacement> namesOf(ViewPlacement) {
  return {"placement", viewPlacementNames};
}

/// What one camera's view asks for.
struct ViewSettings {
  double weight = 1.0;  // of its pixels in the solve, relative to other views; 0: it asks for nothing
  ViewPlacement placement = ViewPlacement::surface;
  std::optional<Corners> corners;      // of ViewPlacement::own; none: largestUpright() in that view
  std::optional<Position> position{};  // of its camera: metres, or in the plan that the viewer's is in
  bool operator==(const ViewSettings&) const = default;
};

struct TargetSettings {
  /// Corners of the content in the first camera's view; none: largestUpright() over placeable().
  std::optional<Corners> corners;
  std::vector<ViewSettings> views;  // camera after camera, from the first on; those left out: {}
  /// For whom it is: the views count by viewerWeights() besides. None: for all who look from the cameras.
  std::optional<Position> viewer{};
  Fit fit = Fit::fill;                // if content and corners differ in aspect ratio
  double reachablePercentile = 15.0;  // share of pixels (percent) that may be too dark to show white
  double blackLift = 0.0;             // share of white added to black
  double unreachableWeight = 0.1;     // weight of unreachable pixels
};
std::vector<Message> problems(const TargetSettings& settings);

/// The target image at the cameras.
struct Target {
  CameraStack content;        // the placed content, 0 to 1; 0 outside
  CameraStack wanted;         // camera signal per second; e outside
  CameraMask inside;          // per camera pixel: the content covers it
  CameraMask reachable;       // per camera pixel inside: e <= wanted <= T 1 + e in all channels
  std::vector<float> weight;  // per camera pixel: its view's inside, less where unreachable, 0 where unusable
  std::array<float, 3> white{};  // wanted signal of the content's white: the peak for PSNR
  Corners corners{};             // where the content was placed: within the quadrilateral for Fit::fit
  /// Per camera: where the content was placed in its own view; none: it lies on the surface.
  std::vector<std::optional<Placement>> placements{};
  std::vector<float> viewWeight{};  // per camera, of its view; the largest is 1
};

/// Whether a view beyond the first has a quadrilateral of its own.
bool hasOwnPictures(const Target& target);

/// K: the mean colour mixing of the venue,
///   K = mean over the usable pixels of diag(B_i 1)^-1 B_i,   B_i = the row sum of T.
/// Every row of K sums to one, so grey content stays grey.
transport::ColourBlock meanColourMixing(const MeasuredVenue& venue);

/// Places and scales linear content (three channels, values 0 to 1) to the target of the first camera:
///   wanted = white * (lift + (1 - lift) K content).
/// In the views of other cameras it lies on the surface where the first one sees it (MeasuredVenue::views),
/// or in a quadrilateral of their own. White is the same signal in all channels and views: as bright as
/// `reachablePercentile` allows, that is so bright that this share of the usable pixels inside, each with its
/// view's weight, cannot show it (their T 1 + e lies below it in some channel).  Source:
/// core/compensation/README.md. Throws: Error{input} if no part of the view is lit, a corner lies outside the
/// view, the corners enclose nothing usable, no view has a weight, or views of cameras are set that there are
/// not.
Target fitTarget(const image::Image& linearContent, const MeasuredVenue& venue,
                 const TargetSettings& settings);

}  // namespace relucent::compensation
