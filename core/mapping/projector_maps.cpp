// SPDX-License-Identifier: MIT
#include "relucent/mapping/projector_maps.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::mapping {
namespace {

using Place = std::array<float, 2>;

bool isKnown(const Place& place) {
  return std::isfinite(place[0]);
}

/// Where a place in the first camera's view lies in the content.
class IntoContent {
 public:
  explicit IntoContent(const compensation::Placement& placement)
      : squareFromView_(compensation::unitSquareFrom(placement.corners)), part_(placement.part) {}

  /// Unknown beyond the horizon.
  Place operator()(const Place& view) const {
    const Eigen::Vector3d square =
        squareFromView_ * Eigen::Vector3d(static_cast<double>(view[0]), static_cast<double>(view[1]), 1.0);
    if (!(square[2] > 0.0)) return {std::nanf(""), std::nanf("")};
    return {static_cast<float>(part_.x0 + (part_.x1 - part_.x0) * square[0] / square[2]),
            static_cast<float>(part_.y0 + (part_.y1 - part_.y0) * square[1] / square[2])};
  }

 private:
  Eigen::Matrix3d squareFromView_;
  compensation::ImagePart part_;
};

/// From the known pixels of a projector into the others, each as the nearest one.
void spread(std::span<Place> places, Size size) {
  std::deque<std::size_t> reached;
  for (std::size_t j = 0; j < places.size(); ++j)
    if (isKnown(places[j])) reached.push_back(j);
  if (reached.empty()) std::fill(places.begin(), places.end(), Place{0.0f, 0.0f});
  constexpr std::array<Pixel, 4> beside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for (; !reached.empty(); reached.pop_front()) {
    const Pixel at = pixelAt(size, reached.front());
    for (const Pixel& step : beside) {
      const Pixel to{at.x + step.x, at.y + step.y};
      if (to.x < 0 || to.y < 0 || to.x >= size.width || to.y >= size.height) continue;
      Place& place = places[indexOf(size, to)];
      if (isKnown(place)) continue;
      place = places[reached.front()];
      reached.push_back(indexOf(size, to));
    }
  }
}

}  // namespace

ProjectorMaps projectorMaps(const compensation::Compensator& compensator, Size canvas,
                            const compensation::TargetSettings& settings, Progress& progress) {
  const compensation::MeasuredVenue& venue = compensator.venue();
  const compensation::Target white = compensation::fitTarget(image::Image(canvas, 3, 1.0f), venue, settings);
  if (compensation::hasOwnPictures(white))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("export.views-have-own-pictures",
                                 "views have pictures of their own, and other players show one content"),
        RELUCENT_ENGLISH_MESSAGE("export.lay-views-on-surface",
                                 "lay the content on the surface in all views, then export again"));
  ProjectorMaps maps;
  maps.projectors = venue.transport.projectors();
  maps.alpha = compensator.solve(compensation::Method::refined, white, progress).projector;
  maps.place = compensation::projectorPlaces(venue.transport, venue.usable, venue.views,
                                             compensator.settings().direct);
  const IntoContent intoContent(white.placements.empty() || !white.placements.front()
                                    ? compensation::Placement{white.corners, {}}
                                    : *white.placements.front());
  for (Place& place : maps.place)
    if (isKnown(place)) place = intoContent(place);
  for (std::size_t j = 0; j < maps.place.size(); ++j)
    if (!isKnown(maps.place[j]))
      std::fill_n(maps.alpha.begin() + static_cast<std::ptrdiff_t>(3 * j), 3, 0.0f);
  for (std::size_t device = 0; device < maps.projectors.devices(); ++device)
    spread({maps.place.data() + maps.projectors.offset(device), maps.projectors.size(device).count()},
           maps.projectors.size(device));
  return maps;
}

ProjectorStack shownBy(const ProjectorMaps& maps, const image::Image& content) {
  require(!content.empty() && content.channels() == 3, "content of {} channels", content.channels());
  ProjectorStack shown(maps.alpha.size());
  parallelFor(0, maps.place.size(), 1024, [&](std::size_t j) {
    const float x = maps.place[j][0] * static_cast<float>(content.width()) - 0.5f;
    const float y = maps.place[j][1] * static_cast<float>(content.height()) - 0.5f;
    const int left = static_cast<int>(std::floor(x)), above = static_cast<int>(std::floor(y));
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(above);
    auto at = [&](int column, int line, int channel) {
      return content.at(std::clamp(column, 0, content.width() - 1), std::clamp(line, 0, content.height() - 1),
                        channel);
    };
    for (int c = 0; c < 3; ++c) {
      const float upper = (1.0f - u) * at(left, above, c) + u * at(left + 1, above, c);
      const float lower = (1.0f - u) * at(left, above + 1, c) + u * at(left + 1, above + 1, c);
      const std::size_t value = 3 * j + static_cast<std::size_t>(c);
      shown[value] = maps.alpha[value] * ((1.0f - v) * upper + v * lower);
    }
  });
  return shown;
}

}  // namespace relucent::mapping
