// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/compensation/brightness.h"
#include "relucent/compensation/clipping.h"
#include "relucent/compensation/mask.h"
#include "relucent/compensation/placement.h"
#include "relucent/compensation/viewer.h"
#include "relucent/compensation/views.h"
#include "relucent/image/colour.h"
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
  /// T as it was measured, by which predict() judges what a threshold costs. Null: `transport`, of which
  /// nothing is cut, or which is believed.
  std::shared_ptr<const transport::TransportMatrix> uncut{};
  /// Per camera pixel, 0 to 1: how far its row of T is relied on, see trustIn(). Empty: all of them as far as
  /// can be.
  std::vector<float> trust{};
};

/// How far a camera pixel is relied on: 0 where it is not usable, else its trust.
inline float relianceOn(const MeasuredVenue& venue, std::size_t pixel) {
  if (venue.usable[pixel] == 0) return 0.0f;
  return venue.trust.empty() ? 1.0f : venue.trust[pixel];
}

/// Per pixel of all cameras: usable, and directly lit.
CameraMask seesProjection(const MeasuredVenue& venue);
/// A camera's pixels that content may cover if no corners are given: its seesProjection().
CameraMask placeable(const MeasuredVenue& venue, std::size_t camera = 0);
/// Where content of that width over height goes in a camera's view if nobody says: largestUpright() over
/// placeable(). None: no part of it is lit well enough.
std::optional<Corners> automaticCorners(const MeasuredVenue& venue, double aspect, std::size_t camera = 0);

/// Where content lies in the view of a camera beyond the first.
enum class ViewPlacement { surface, own };
inline constexpr EnumName<ViewPlacement> viewPlacementNames[]{
    {ViewPlacement::surface, "surface", "on the surface, where the first camera's content lies"},
    {ViewPlacement::own, "own", "in a quadrilateral of its own"}};
constexpr EnumNames<ViewPlacement> namesOf(ViewPlacement) {
  return {"placement", viewPlacementNames};
}

/// Which error the solve makes small.
enum class Objective {
  seen,   // as an eye weighs it: an error counts by the brightness around it
  light,  // of light alone: an error in the dark counts as one in the bright
};
inline constexpr EnumName<Objective> objectiveNames[]{
    {Objective::seen, "seen", "what an eye sees: errors in the dark count more"},
    {Objective::light, "light", "errors of light count alike, bright or dark"}};
constexpr EnumNames<Objective> namesOf(Objective) {
  return {"objective", objectiveNames};
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
  /// Share of white added to black; none: the least that hides where the projectors' black ends, see
  /// leastBlackLift().
  std::optional<double> blackLift{};
  Brightness brightness = Brightness::even;
  Objective objective = Objective::seen;
  Clipping clipping = Clipping::channels;  // of what is asked for where it is held to what can be had
  /// Weight of unreachable pixels; none: as the objective has it.
  std::optional<double> unreachableWeight{};
  /// Where nothing is to be lit; none: nobody has said, as no masks.
  std::optional<std::vector<Mask>> masks{};

  /// For measuring how well T and its inverse are known: errors of light, as one always has measured them.
  static TargetSettings ofLight() {
    TargetSettings settings;
    settings.objective = Objective::light;
    settings.blackLift = 0.0;
    return settings;
  }
};
std::vector<Message> problems(const TargetSettings& settings);

/// The target image at the cameras.
struct Target {
  CameraStack content;   // the placed content, 0 to 1; 0 outside
  CameraStack wanted;    // camera signal per second; e outside
  CameraMask inside;     // per camera pixel: the content covers it, and no mask all of it
  CameraMask reachable;  // per camera pixel inside: e <= wanted <= T 1 + e in all channels
  CameraStack asked;     // what the solve asks for, less e; Objective::seen: held between 0 and the flood
  /// Per camera pixel: its view's inside, less where unreachable, 0 where unusable; times its sensitivity()
  /// and how far its row of T is relied on.
  std::vector<float> weight;
  std::vector<float> windowsWeight;  // the same without sensitivity, for what M corrects
  std::array<float, 3> white{};      // wanted signal of the content's white: the peak for PSNR
  double blackLift = 0.0;            // share of white that is added to black
  /// Per camera pixel, of white there: who adapts to the picture sees signals over white and gain. Empty: 1.
  std::vector<float> gain{};
  Corners corners{};  // where the content was placed: within the quadrilateral for Fit::fit
  /// Per camera: where the content was placed in its own view; none: it lies on the surface.
  std::vector<std::optional<Placement>> placements{};
  std::vector<float> viewWeight{};  // per camera, of its view; the largest is 1
  Clipping clipping = Clipping::channels;
  // What masks do, see maskedLight(); all three empty: there are none.
  std::vector<float> masked{};     // s, per camera pixel
  std::vector<float> available{};  // a, per projector pixel: it is to be used up to there
  CameraStack flood{};             // T 1 less what of it is not available, not below 0
};

/// The flood image of what a target may use.
inline const CameraStack& floodOf(const MeasuredVenue& venue, const Target& target) {
  return target.flood.empty() ? venue.flood : target.flood;
}
/// 1 - s of a camera pixel.
inline float unmaskedShare(const Target& target, std::size_t pixel) {
  return target.masked.empty() ? 1.0f : 1.0f - target.masked[pixel];
}
/// Whether the content, or else a mask, covers all of a camera pixel: the projector pixels there are the
/// content's.
inline bool isCovered(const Target& target, std::size_t pixel) {
  return target.inside[pixel] != 0 || (!target.masked.empty() && target.masked[pixel] >= fullyMasked);
}

/// The weight of unreachable pixels.
float unreachableWeightOf(const TargetSettings& settings);

/// How much the square of an error counts where the eye sees this much light, as a share of white:
///   s = (1 + a) / (Y + a),   Y = 0.2126 r + 0.7152 g + 0.0722 b, at most 1,   a = 0.1
/// the squared slope of the scale sqrt(Y + a), 1 at white.  Source: core/compensation/README.md.
inline constexpr float sensitivityOffset = 0.1f;
inline constexpr float largestSensitivity = (1.0f + sensitivityOffset) / sensitivityOffset;
inline float sensitivity(float luminance) {
  return (1.0f + sensitivityOffset) / ((luminance < 1.0f ? luminance : 1.0f) + sensitivityOffset);
}

/// One camera's part of a stack, over the gain of white: to be compared and viewed under Target::white.
image::Image underEvenWhite(const CameraStack& stack, const Target& target, const Rasters& cameras,
                            std::size_t camera);

/// The colours of pixels and their limits, of which the gains of white are found: at most some thousands, on
/// a regular grid.  `place`: u and v in the content, three values a camera pixel, the third unused.
class BrightnessSamples {
 public:
  BrightnessSamples(const MeasuredVenue& venue, const CameraMask& inside,
                    const std::vector<float>& weightOfPixel, const CameraStack& place, float white);
  /// Takes a pixel's colour, mixed as the venue mixes it.
  template <typename ColourAt>
  const std::vector<BrightnessSample>& of(const ColourAt& mixedAt) {
    for (std::size_t sample = 0; sample < pixel_.size(); ++sample)
      samples_[sample].wanted = mixedAt(pixel_[sample]);
    return samples_;
  }

 private:
  std::vector<std::size_t> pixel_;
  std::vector<BrightnessSample> samples_;
};

/// Where in the content, of size one by one, each camera pixel inside looks: u and v, and 0.
CameraStack placesInContent(const MeasuredVenue& venue, const Target& target);

/// Whether a view beyond the first has a quadrilateral of its own.
bool hasOwnPictures(const Target& target);

/// K: the mean colour mixing of the venue,
///   K = mean over the usable pixels of diag(B_i 1)^-1 B_i,   B_i = the row sum of T.
/// Every row of K sums to one, so grey content stays grey.
transport::ColourBlock meanColourMixing(const MeasuredVenue& venue);

/// Places and scales linear content (three channels, values 0 to 1) to the target of the first camera:
///   wanted = white * gain * (lift + (1 - lift) K content),   gain by Brightness, 1 where it is even.
/// In the views of other cameras it lies on the surface where the first one sees it (MeasuredVenue::views),
/// or in a quadrilateral of their own. White is the same signal in all channels and views: as bright as
/// `reachablePercentile` allows, that is so bright that this share of the usable pixels inside, each with its
/// view's weight, cannot show it (their T 1 + e lies below it in some channel). Towards a mask wanted goes to
/// 0 as 1 - s, and so does the weight; what is fully masked asks for nothing, and is not inside.  Source:
/// core/compensation/README.md. Throws: Error{input} if no part of the view is lit, a corner lies outside the
/// view, the corners enclose nothing usable or all of it is masked, no view has a weight, or views or masks
/// of cameras are set that there are not.
Target fitTarget(const image::Image& linearContent, const MeasuredVenue& venue,
                 const TargetSettings& settings);

}  // namespace relucent::compensation
