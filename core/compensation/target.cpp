// SPDX-License-Identifier: MIT
#include "relucent/compensation/target.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/black_steps.h"
#include "relucent/compensation/stacks.h"
#include "relucent/compensation/white_levels.h"

namespace relucent::compensation {
namespace {

Size viewOf(const MeasuredVenue& venue, std::size_t camera) {
  return venue.transport.cameras().size(camera);
}

void checkShapes(const image::Image& content, const MeasuredVenue& venue) {
  std::size_t pixels = venue.transport.cameras().count();
  require(venue.black.size() == 3 * pixels && venue.flood.size() == 3 * pixels &&
              venue.usable.size() == pixels && (venue.direct.empty() || venue.direct.size() == pixels) &&
              (venue.views.empty() || venue.views.size() == pixels) &&
              (venue.trust.empty() || venue.trust.size() == pixels),
          "{} black, {} flood values and {} flags for {} camera pixels", venue.black.size(),
          venue.flood.size(), venue.usable.size(), pixels);
  require(!content.empty() && content.channels() == 3, "content of {} channels; three are needed",
          content.channels());
}

/// Where the content goes when nobody says.
Corners chosenCorners(const image::Image& content, const MeasuredVenue& venue, std::size_t camera) {
  double aspect = static_cast<double>(content.width()) / content.height();
  std::optional<Corners> found = automaticCorners(venue, aspect, camera);
  if (!found && camera > 0)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE(
            "compensation.no-lit-area-in-view",
            "no part of camera {}'s view is lit well enough to hold a picture of its own")
            .with(as::label(camera + 1)),
        RELUCENT_ENGLISH_MESSAGE("compensation.let-content-lie-on-surface",
                                 "let the content lie on the surface in that view, or aim that camera at the "
                                 "projection and measure again"));
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
void checkInView(const Corners& corners, Size view, std::size_t camera) {
  // Whoever drags a corner to the edge may end up a little beyond it.
  constexpr double tolerance = 1.0;
  constexpr std::array names{"upper left", "upper right", "lower right", "lower left"};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto [x, y] = corners[i];
    if (x >= -tolerance && y >= -tolerance && x <= view.width + tolerance && y <= view.height + tolerance)
      continue;
    const Argument atX = as::number(x, as::digits(6)), atY = as::number(y, as::digits(6));
    throw Error(
        ErrorKind::input,
        camera == 0
            ? RELUCENT_ENGLISH_MESSAGE(
                  "compensation.corner-outside-view",
                  "the {} corner of the content at ({}, {}) lies outside the camera's view of {} pixels")
                  .with(names[i], atX, atY, as::size(view))
            : RELUCENT_ENGLISH_MESSAGE(
                  "compensation.corner-outside-other-view",
                  "the {} corner of camera {}'s content at ({}, {}) lies outside its view of {} pixels")
                  .with(names[i], as::label(camera + 1), atX, atY, as::size(view)),
        RELUCENT_ENGLISH_MESSAGE("compensation.move-corners-into-view", "move the corners into the view"));
  }
}

Placement placementOf(const image::Image& content, const MeasuredVenue& venue, std::size_t camera,
                      const std::optional<Corners>& corners, Fit fit) {
  if (!corners) return {chosenCorners(content, venue, camera), {}};  // of the content's own shape
  checkInView(*corners, viewOf(venue, camera), camera);
  double aspect = static_cast<double>(content.width()) / content.height();
  return fitted(*corners, aspect, fit);
}

/// As a show follows him, see followedWeights().
/// Throws: Error{input} naming the first camera whose position is not known, or for a viewer far from all.
void weighFor(const Position& viewer, std::vector<ViewSettings>& views) {
  std::vector<Position> cameras;
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    if (!views[camera].position)
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("compensation.camera-position-unknown",
                                           "there is a viewer, but where camera {} stands is not known")
                      .with(as::label(camera + 1)),
                  RELUCENT_ENGLISH_MESSAGE("compensation.give-camera-positions",
                                           "give the position of every camera, in the viewer's units"));
    cameras.push_back(*views[camera].position);
  }
  if (Message far = farFromCameras(cameras, viewer); !far.empty())
    throw Error(
        ErrorKind::input, std::move(far),
        RELUCENT_ENGLISH_MESSAGE("compensation.give-viewer-as-cameras",
                                 "give his position in the units and from the origin of the cameras'"));
  std::vector<double> home;
  for (const ViewSettings& view : views) home.push_back(view.weight);
  const std::vector<double> weights = followedWeights(cameras, home, viewer);
  for (std::size_t camera = 0; camera < views.size(); ++camera)
    views[camera].weight = weights.empty() ? 0.0 : weights[camera];
}

/// Per camera, as the settings have it.
std::vector<ViewSettings> viewsOf(const MeasuredVenue& venue, const TargetSettings& settings) {
  const std::size_t cameras = venue.transport.cameras().devices();
  if (settings.views.size() > cameras)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("compensation.more-views-than-cameras",
                                         "the view of camera {} is set, but there are {} cameras")
                    .with(as::label(settings.views.size()), as::label(cameras)),
                RELUCENT_ENGLISH_MESSAGE("compensation.set-views-of-cameras",
                                         "set the views of the cameras that measured this calibration"));
  std::vector<ViewSettings> views = settings.views;
  views.resize(cameras);
  if (settings.viewer) weighFor(*settings.viewer, views);
  if (std::ranges::all_of(views, [](const ViewSettings& view) { return view.weight == 0.0; }))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("compensation.no-view-has-weight",
                                 "every view has the weight 0: nobody asks for a picture"),
        RELUCENT_ENGLISH_MESSAGE("compensation.give-view-weight", "give at least one view a weight above 0"));
  return views;
}

/// Relative to the heaviest.
std::vector<float> relativeWeights(const std::vector<ViewSettings>& views) {
  double most = 0.0;
  for (const ViewSettings& view : views) most = std::max(most, view.weight);
  std::vector<float> weights;
  for (const ViewSettings& view : views) weights.push_back(static_cast<float>(view.weight / most));
  return weights;
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

/// Content into a camera's view, as its placement has it.
void placeInView(const image::Image& content, const MeasuredVenue& venue, std::size_t camera,
                 const Placement& placement, CameraStack& to, CameraMask& inside) {
  const Placed placed = place(content, placement, viewOf(venue, camera));
  const auto first = static_cast<std::ptrdiff_t>(venue.transport.cameras().offset(camera));
  std::ranges::copy(placed.inside, inside.begin() + first);
  std::ranges::copy(placed.image.data(), to.begin() + 3 * first);
}

/// Content and what it covers, from the first camera's view into another.
void lieOnSurface(const MeasuredVenue& venue, std::size_t camera, CameraStack& to, CameraMask& covered) {
  const Size view = viewOf(venue, 0);
  const CameraMask inside(covered.begin(), covered.begin() + static_cast<std::ptrdiff_t>(view.count()));
  const std::size_t begin = venue.transport.cameras().offset(camera);
  parallelFor(begin, begin + viewOf(venue, camera).count(), 1024, [&](std::size_t i) {
    const std::optional<ViewSample> sample = sampleAt(venue.views[i], view, inside);
    if (!sample) return;
    covered[i] = 1;
    for (std::size_t k = 0; k < sample->pixel.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) to[3 * i + c] += sample->share[k] * to[3 * sample->pixel[k] + c];
  });
}

/// Gains of white, per camera pixel.
std::vector<float> gainsOf(const MeasuredVenue& venue, const Target& target,
                           const transport::ColourBlock& mixing, Brightness way, double aspect) {
  const CameraStack places = placesInContent(venue, target);
  const Rasters& cameras = venue.transport.cameras();
  std::vector<float> weight(target.inside.size());
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    for (std::size_t i = cameras.offset(camera); i < cameras.offset(camera) + cameras.size(camera).count();
         ++i)
      weight[i] = venue.usable[i] != 0 ? target.viewWeight[camera] : 0.0f;
  BrightnessSamples samples(venue, target.inside, weight, places, target.white[0]);
  const BrightnessField field = BrightnessFit(way, aspect).fit(samples.of([&](std::size_t i) {
    const Eigen::Vector3f mixed = mixing * Eigen::Map<const Eigen::Vector3f>(&target.content[3 * i]);
    return std::array{mixed[0], mixed[1], mixed[2]};
  }));
  std::vector<float> gain(target.inside.size(), 1.0f);
  parallelFor(0, gain.size(), 1024, [&](std::size_t i) {
    if (target.inside[i] != 0) gain[i] = field.gain(places[3 * i], places[3 * i + 1]);
  });
  return gain;
}

}  // namespace

std::vector<Message> problems(const TargetSettings& settings) {
  std::vector<Message> found;
  if (settings.corners)
    if (Message problem = cornerProblem(*settings.corners); !problem.empty()) found.push_back(problem);
  for (std::size_t camera = 0; camera < settings.views.size(); ++camera) {
    const ViewSettings& view = settings.views[camera];
    if (!(view.weight >= 0.0 && std::isfinite(view.weight)))
      found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.view-weight-negative",
                                               "the weight of camera {}'s view must be 0 or more")
                          .with(as::label(camera + 1)));
    if (view.position && !isFinite(*view.position))
      found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.camera-position-not-finite",
                                               "the position of camera {} must be finite numbers")
                          .with(as::label(camera + 1)));
    if (view.corners)
      if (Message problem = cornerProblem(*view.corners); !problem.empty())
        found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.of-camera", "camera {}: {}")
                            .with(as::label(camera + 1), problem));
  }
  if (settings.viewer && !isFinite(*settings.viewer))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.viewer-position-not-finite",
                                             "the viewer's position must be finite numbers"));
  if (!settings.views.empty() && settings.views.front().placement == ViewPlacement::own)
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "compensation.first-view-has-the-corners",
        "the first camera's quadrilateral is that of the content: it has no other of its own"));
  if (!(settings.reachablePercentile >= 0.0 && settings.reachablePercentile <= 100.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "compensation.reachable-percentile-out-of-range",
        "the share of pixels too dark for white must lie between 0 and 100 percent"));
  if (settings.blackLift && !(*settings.blackLift >= 0.0 && *settings.blackLift < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.black-lift-out-of-range",
                                             "the black lift must lie between 0 and 1"));
  if (settings.masks)
    for (Message& problem : problems(*settings.masks)) found.push_back(std::move(problem));
  if (settings.unreachableWeight &&
      !(*settings.unreachableWeight >= 0.0 && *settings.unreachableWeight <= 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.unreachable-weight-out-of-range",
                                             "the weight of unreachable pixels must lie between 0 and 1"));
  return found;
}

namespace {

/// Takes what masks cover out of a target that is placed.
void takeMasks(const MeasuredVenue& venue, const TargetSettings& settings, Target& target) {
  if (!settings.masks || settings.masks->empty()) return;
  MaskedLight light = maskedLight(venue, *settings.masks);
  target.masked = std::move(light.masked);
  target.available = std::move(light.available);
  const CameraStack missing = venue.transport.apply(stackOf<ProjectorStack>(
      3 * target.available.size(), [&](std::size_t i) { return 1.0f - target.available[i / 3]; }));
  target.flood = stackOf<CameraStack>(
      missing.size(), [&](std::size_t i) { return std::max(0.0f, venue.flood[i] - missing[i]); });
  bool wasAny = false, isAny = false;
  for (std::size_t i = 0; i < target.inside.size(); ++i) {
    wasAny = wasAny || target.inside[i] != 0;
    if (target.masked[i] >= fullyMasked) target.inside[i] = 0;
    isAny = isAny || target.inside[i] != 0;
  }
  if (wasAny && !isAny)
    throw Error(ErrorKind::input,
                RELUCENT_MESSAGE("compensation.masks-cover-everything", "the masks cover the whole picture"),
                RELUCENT_MESSAGE("compensation.shrink-masks", "make a mask smaller, or remove one"));
}

}  // namespace

CameraMask seesProjection(const MeasuredVenue& venue) {
  CameraMask pixels(venue.usable.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = venue.usable[i] && (venue.direct.empty() || venue.direct[i]);
  return pixels;
}

CameraMask placeable(const MeasuredVenue& venue, std::size_t camera) {
  const CameraMask pixels = seesProjection(venue);
  const auto begin = pixels.begin() + static_cast<std::ptrdiff_t>(venue.transport.cameras().offset(camera));
  return {begin, begin + static_cast<std::ptrdiff_t>(viewOf(venue, camera).count())};
}

std::optional<Corners> automaticCorners(const MeasuredVenue& venue, double aspect, std::size_t camera) {
  return largestUpright(placeable(venue, camera), viewOf(venue, camera), aspect);
}

float unreachableWeightOf(const TargetSettings& settings) {
  // Measured, see the README. Objective::light asks for what cannot be had: little weight limits the harm.
  const double ofObjective = settings.objective == Objective::light ? 0.1 : 0.5;
  return static_cast<float>(settings.unreachableWeight.value_or(ofObjective));
}

image::Image underEvenWhite(const CameraStack& stack, const Target& target, const Rasters& cameras,
                            std::size_t camera) {
  image::Image image = image::imageFromStack(stack, cameras, camera);
  if (target.gain.empty()) return image;
  const float* gain = &target.gain[cameras.offset(camera)];
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] /= gain[i / 3];
  return image;
}

CameraStack placesInContent(const MeasuredVenue& venue, const Target& target) {
  constexpr Size steps{256, 256};
  image::Image ramps(steps, 3);
  for (int y = 0; y < steps.height; ++y)
    for (int x = 0; x < steps.width; ++x) {
      ramps.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / static_cast<float>(steps.width);
      ramps.at(x, y, 1) = (static_cast<float>(y) + 0.5f) / static_cast<float>(steps.height);
    }
  CameraStack places(3 * venue.usable.size(), 0.0f);
  CameraMask inside(venue.usable.size(), 0);
  for (std::size_t camera = 0; camera < target.placements.size(); ++camera)
    if (target.placements[camera])
      placeInView(ramps, venue, camera, *target.placements[camera], places, inside);
    else if (!venue.views.empty())
      lieOnSurface(venue, camera, places, inside);
  return places;
}

BrightnessSamples::BrightnessSamples(const MeasuredVenue& venue, const CameraMask& inside,
                                     const std::vector<float>& weightOfPixel, const CameraStack& place,
                                     float white) {
  constexpr std::size_t mostSamples = 4096;
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i] != 0 && weightOfPixel[i] > 0.0f) pixels.push_back(i);
  const std::size_t count = std::min(pixels.size(), mostSamples);
  for (std::size_t sample = 0; sample < count; ++sample) {
    const std::size_t i = pixels[sample * pixels.size() / count];
    pixel_.push_back(i);
    BrightnessSample one;
    one.u = place[3 * i];
    one.v = place[3 * i + 1];
    one.weight = weightOfPixel[i];
    for (std::size_t c = 0; c < 3; ++c) {
      one.least[c] = venue.black[3 * i + c] / white;
      one.most[c] = (venue.black[3 * i + c] + std::max(0.0f, venue.flood[3 * i + c])) / white;
    }
    samples_.push_back(one);
  }
}

bool hasOwnPictures(const Target& target) {
  return std::any_of(target.placements.begin() + 1, target.placements.end(),
                     [](const auto& placement) { return placement.has_value(); });
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
  const std::vector<ViewSettings> views = viewsOf(venue, settings);
  const Rasters& cameras = venue.transport.cameras();
  const std::size_t pixels = cameras.count();
  target.viewWeight = relativeWeights(views);
  target.placements.resize(cameras.devices());
  target.inside.assign(pixels, 0);
  target.content.assign(3 * pixels, 0.0f);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    if (camera == 0 || views[camera].placement == ViewPlacement::own) {
      target.placements[camera] = placementOf(
          linearContent, venue, camera, camera == 0 ? settings.corners : views[camera].corners, settings.fit);
      placeInView(linearContent, venue, camera, *target.placements[camera], target.content, target.inside);
    } else if (!venue.views.empty()) {
      lieOnSurface(venue, camera, target.content, target.inside);
    }
  }
  target.corners = target.placements.front()->corners;
  takeMasks(venue, settings, target);

  const float white = WhiteLevels(venue, target.inside).at(target.viewWeight, settings.reachablePercentile);
  target.white = {white, white, white};
  transport::ColourBlock mixing = meanColourMixing(venue);
  target.blackLift = settings.blackLift ? *settings.blackLift : leastBlackLift(venue, target);
  auto lift = static_cast<float>(target.blackLift);
  const float unreachableWeight = unreachableWeightOf(settings);
  target.wanted = venue.black;
  if (settings.brightness != Brightness::even)
    target.gain = gainsOf(venue, target, mixing, settings.brightness,
                          static_cast<double>(linearContent.width()) / linearContent.height());
  target.clipping = settings.clipping;
  target.asked.assign(3 * pixels, 0.0f);
  target.reachable.assign(pixels, 0);
  target.weight.assign(pixels, 0.0f);
  target.windowsWeight.assign(pixels, 0.0f);
  const CameraStack& most = floodOf(venue, target);
  const auto fit = [&](std::size_t i, float weight) {
    if (!target.inside[i]) return;
    Eigen::Map<const Eigen::Vector3f> content(&target.content[3 * i]);
    Eigen::Map<Eigen::Vector3f> wanted(&target.wanted[3 * i]);
    wanted = white * (target.gain.empty() ? 1.0f : target.gain[i]) *
             (lift + (1.0f - lift) * (mixing * content).array());
    if (!target.masked.empty()) {
      wanted *= unmaskedShare(target, i);
      weight *= unmaskedShare(target, i);
    }
    Eigen::Map<const Eigen::Vector3f> black(&venue.black[3 * i]), flood(&most[3 * i]);
    Eigen::Map<Eigen::Vector3f> asked(&target.asked[3 * i]);
    asked = wanted - black;
    if (settings.objective == Objective::seen)
      asked = held(asked, Eigen::Vector3f::Zero(), flood.cwiseMax(0.0f), settings.clipping);
    if (!venue.usable[i]) return;
    weight *= relianceOn(venue, i);
    bool reachable =
        (wanted.array() >= black.array()).all() && (wanted.array() <= (black + flood).array()).all();
    target.reachable[i] = reachable;
    target.windowsWeight[i] = weight * (reachable ? 1.0f : unreachableWeight);
    target.weight[i] = target.windowsWeight[i];
    if (settings.objective == Objective::seen)
      target.weight[i] *=
          sensitivity(Eigen::Vector3f((asked + black) / white)
                          .dot(Eigen::Map<const Eigen::Vector3f>(image::luminanceWeights.data())));
  };
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera);
    parallelFor(begin, begin + viewOf(venue, camera).count(), 1024,
                [&](std::size_t i) { fit(i, target.viewWeight[camera]); });
  }
  return target;
}

}  // namespace relucent::compensation
