// SPDX-License-Identifier: MIT
#include "relucent/compensation/target.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::compensation {
namespace {

Size firstCamera(const MeasuredVenue& venue) {
  return venue.transport.cameras().size(0);
}

void checkShapes(const image::Image& content, const MeasuredVenue& venue) {
  std::size_t pixels = venue.transport.cameras().count();
  require(venue.black.size() == 3 * pixels && venue.flood.size() == 3 * pixels &&
              venue.usable.size() == pixels && (venue.direct.empty() || venue.direct.size() == pixels) &&
              (venue.views.empty() || venue.views.size() == pixels),
          "{} black, {} flood values and {} flags for {} camera pixels", venue.black.size(),
          venue.flood.size(), venue.usable.size(), pixels);
  require(!content.empty() && content.channels() == 3, "content of {} channels; three are needed",
          content.channels());
}

/// Where the content goes when nobody says.
Corners chosenCorners(const image::Image& content, const MeasuredVenue& venue) {
  Size view = firstCamera(venue);
  double aspect = static_cast<double>(content.width()) / content.height();
  std::optional<Corners> found = largestUpright(placeable(venue), view, aspect);
  if (!found)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("compensation.no-lit-area",
                                         "no part of the camera's view is lit well enough to hold a picture"),
                RELUCENT_ENGLISH_MESSAGE(
                    "compensation.aim-camera-or-set-corners",
                    "aim the camera at the projection or set the corners of the content by hand"));
  return *found;
}

/// Throws: Error{input} naming the first corner that the camera does not see.
void checkInView(const Corners& corners, Size view) {
  // Whoever drags a corner to the edge may end up a little beyond it.
  constexpr double tolerance = 1.0;
  constexpr std::array names{"upper left", "upper right", "lower right", "lower left"};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto [x, y] = corners[i];
    if (x >= -tolerance && y >= -tolerance && x <= view.width + tolerance && y <= view.height + tolerance)
      continue;
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE(
            "compensation.corner-outside-view",
            "the {} corner of the content at ({}, {}) lies outside the camera's view of {} pixels")
            .with(names[i], as::number(x, as::digits(6)), as::number(y, as::digits(6)), as::size(view)),
        RELUCENT_ENGLISH_MESSAGE("compensation.move-corners-into-view", "move the corners into the view"));
  }
}

Placement placementOf(const image::Image& content, const MeasuredVenue& venue,
                      const TargetSettings& settings) {
  if (!settings.corners) return {chosenCorners(content, venue), {}};  // of the content's own shape
  checkInView(*settings.corners, firstCamera(venue));
  double aspect = static_cast<double>(content.width()) / content.height();
  return fitted(*settings.corners, aspect, settings.fit);
}

/// What is wrong with the corners, empty if nothing is.
Message cornerProblem(const Corners& corners) {
  for (const auto& corner : corners)
    if (!std::isfinite(corner[0]) || !std::isfinite(corner[1]))
      return RELUCENT_ENGLISH_MESSAGE("compensation.corners-not-finite",
                                      "the corners of the content must be finite numbers");
  if (isConvex(corners)) return {};
  if (isConvex({corners[0], corners[3], corners[2], corners[1]}))
    return RELUCENT_ENGLISH_MESSAGE(
        "compensation.corners-counter-clockwise",
        "the corners of the content go counter-clockwise: they must go clockwise from top left");
  return RELUCENT_ENGLISH_MESSAGE(
      "compensation.corners-not-convex",
      "the corners of the content do not span a convex quadrilateral: they must go clockwise from top left");
}

/// Content and what it covers, from the first camera's view into the others.
void lieInOtherViews(const MeasuredVenue& venue, Target& target) {
  const Size view = firstCamera(venue);
  const CameraMask inside(target.inside.begin(),
                          target.inside.begin() + static_cast<std::ptrdiff_t>(view.count()));
  parallelFor(view.count(), target.inside.size(), 1024, [&](std::size_t i) {
    const std::optional<ViewSample> sample = sampleAt(venue.views[i], view, inside);
    if (!sample) return;
    target.inside[i] = 1;
    for (std::size_t k = 0; k < sample->pixel.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        target.content[3 * i + c] += sample->share[k] * target.content[3 * sample->pixel[k] + c];
  });
}

/// The brightest white that all but `percentile` percent of the usable pixels inside can show.
float whiteLevel(const MeasuredVenue& venue, const CameraMask& inside, double percentile) {
  std::vector<float> brightest;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i] || !venue.usable[i]) continue;
    float least = venue.flood[3 * i] + venue.black[3 * i];
    for (std::size_t c = 1; c < 3; ++c)
      least = std::min(least, venue.flood[3 * i + c] + venue.black[3 * i + c]);
    brightest.push_back(least);
  }
  if (brightest.empty())
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("compensation.corners-enclose-nothing-lit",
                                 "the corners of the content enclose no pixel that the projector lights"),
        RELUCENT_ENGLISH_MESSAGE("compensation.move-corners-into-lit-part",
                                 "move the corners into the lit part of the camera's view"));
  auto rank = static_cast<std::size_t>(percentile / 100.0 * static_cast<double>(brightest.size() - 1));
  auto chosen = brightest.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(brightest.begin(), chosen, brightest.end());
  if (!(*chosen > 0.0f))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("compensation.colour-hardly-seen",
                                 "some colour of the projector hardly reaches the camera within the content"),
        RELUCENT_ENGLISH_MESSAGE("compensation.move-corners-into-lit-part",
                                 "move the corners into the lit part of the camera's view"));
  return *chosen;
}

}  // namespace

std::vector<Message> problems(const TargetSettings& settings) {
  std::vector<Message> found;
  if (settings.corners)
    if (Message problem = cornerProblem(*settings.corners); !problem.empty()) found.push_back(problem);
  if (!(settings.reachablePercentile >= 0.0 && settings.reachablePercentile <= 100.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "compensation.reachable-percentile-out-of-range",
        "the share of pixels too dark for white must lie between 0 and 100 percent"));
  if (!(settings.blackLift >= 0.0 && settings.blackLift < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.black-lift-out-of-range",
                                             "the black lift must lie between 0 and 1"));
  if (!(settings.unreachableWeight >= 0.0 && settings.unreachableWeight <= 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.unreachable-weight-out-of-range",
                                             "the weight of unreachable pixels must lie between 0 and 1"));
  return found;
}

CameraMask seesProjection(const MeasuredVenue& venue) {
  CameraMask pixels(venue.usable.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = venue.usable[i] && (venue.direct.empty() || venue.direct[i]);
  return pixels;
}

CameraMask placeable(const MeasuredVenue& venue) {
  CameraMask pixels = seesProjection(venue);
  pixels.resize(firstCamera(venue).count());
  return pixels;
}

transport::ColourBlock meanColourMixing(const MeasuredVenue& venue) {
  std::vector<transport::ColourBlock> mixing = venue.transport.rowSums();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double rows = 0.0;
  for (std::size_t i = 0; i < mixing.size(); ++i) {
    if (!venue.usable[i]) continue;
    Eigen::Vector3f flood = mixing[i].rowwise().sum();
    if (!(flood.minCoeff() > 0.0f)) continue;
    sum += (flood.cwiseInverse().asDiagonal() * mixing[i]).eval().cast<double>();
    rows += 1.0;
  }
  if (rows == 0.0) return transport::ColourBlock::Identity();
  return (sum / rows).cast<float>();
}

Target fitTarget(const image::Image& linearContent, const MeasuredVenue& venue,
                 const TargetSettings& settings) {
  checkShapes(linearContent, venue);
  auto wrong = problems(settings);
  require(wrong.empty(), "target settings: {}", fmt::join(wrong, "; "));

  Target target;
  Placement placement = placementOf(linearContent, venue, settings);
  target.corners = placement.corners;
  Placed placed = place(linearContent, placement, firstCamera(venue));
  std::size_t pixels = venue.transport.cameras().count();
  target.inside = std::move(placed.inside);
  target.inside.resize(pixels, 0);
  target.content = CameraStack(std::move(placed.image.data()));
  target.content.resize(3 * pixels, 0.0f);
  if (!venue.views.empty()) lieInOtherViews(venue, target);

  float white = whiteLevel(venue, target.inside, settings.reachablePercentile);
  target.white = {white, white, white};
  transport::ColourBlock mixing = meanColourMixing(venue);
  auto lift = static_cast<float>(settings.blackLift);
  target.wanted = venue.black;
  target.reachable.assign(pixels, 0);
  target.weight.assign(pixels, 0.0f);
  parallelFor(0, pixels, 1024, [&](std::size_t i) {
    if (!target.inside[i]) return;
    Eigen::Map<const Eigen::Vector3f> content(&target.content[3 * i]);
    Eigen::Map<Eigen::Vector3f> wanted(&target.wanted[3 * i]);
    wanted = white * (lift + (1.0f - lift) * (mixing * content).array());
    if (!venue.usable[i]) return;
    Eigen::Map<const Eigen::Vector3f> black(&venue.black[3 * i]), flood(&venue.flood[3 * i]);
    bool reachable =
        (wanted.array() >= black.array()).all() && (wanted.array() <= (black + flood).array()).all();
    target.reachable[i] = reachable;
    target.weight[i] = reachable ? 1.0f : static_cast<float>(settings.unreachableWeight);
  });
  return target;
}

}  // namespace relucent::compensation
