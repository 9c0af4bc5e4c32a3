// SPDX-License-Identifier: MIT
#include "relucent/pipeline/moved_content.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace relucent::pipeline {
namespace {

using compensation::Corners;
using compensation::Mask;
using compensation::MeasuredVenue;
using sentinels::Movement;

constexpr double samePlace = 1.0;  // pixels: who looks does not see it

using Point = std::array<double, 2>;

Point movedPoint(const Point& point, const Movement& moved, Size view) {
  const double centreX = 0.5 * view.width, centreY = 0.5 * view.height;
  const double angle = moved.degrees * std::numbers::pi / 180.0;
  const double x = point[0] - centreX, y = point[1] - centreY;
  return {std::cos(angle) * x - std::sin(angle) * y + centreX + moved.x,
          std::sin(angle) * x + std::cos(angle) * y + centreY + moved.y};
}

Point heldWithin(const Point& point, Size view) {
  return {std::clamp(point[0], 0.0, static_cast<double>(view.width)),
          std::clamp(point[1], 0.0, static_cast<double>(view.height))};
}

/// None: nothing of it is left in the view.
std::optional<Corners> movedWithin(const Corners& corners, const Movement& moved, Size view) {
  Corners there = movedCorners(corners, moved, view);
  for (Point& corner : there) corner = heldWithin(corner, view);
  return compensation::isConvex(there) ? std::optional(there) : std::nullopt;
}

bool areSame(const Corners& a, const Corners& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1]) > samePlace) return false;
  return true;
}

/// A mask that has no sense any more stays as it is: rather dark at a wrong place than light.
Mask movedMask(Mask mask, const Movement& moved, Size view) {
  const Mask before = mask;
  for (Point& point : mask.points) {
    const Point there =
        heldWithin(movedPoint({point[0] * view.width, point[1] * view.height}, moved, view), view);
    point = {there[0] / view.width, there[1] / view.height};
  }
  return compensation::problems({mask}).empty() ? mask : before;
}

}  // namespace

Corners movedCorners(const Corners& corners, const Movement& moved, Size view) {
  Corners there = corners;
  for (Point& corner : there) corner = movedPoint(corner, moved, view);
  return there;
}

ContentSettings movedContent(ContentSettings content, double aspect, const MeasuredVenue& before,
                             const MeasuredVenue& now, const std::vector<Movement>& moved) {
  const Rasters& cameras = now.transport.cameras();
  const auto move = [&](std::optional<Corners>& corners, std::size_t camera) {
    const std::optional<Corners> former =
        corners ? corners : compensation::automaticCorners(before, aspect, camera);
    if (!former) return;
    const std::optional<Corners> there = movedWithin(*former, moved[camera], cameras.size(camera));
    const std::optional<Corners> automatic =
        corners ? std::nullopt : compensation::automaticCorners(now, aspect, camera);
    const bool staysAutomatic = !corners && automatic && there && areSame(*automatic, *there);
    if (!staysAutomatic) corners = there;
  };
  move(content.corners, 0);
  for (std::size_t camera = 1; camera < content.views.size() && camera < cameras.devices(); ++camera)
    if (content.views[camera].placement == compensation::ViewPlacement::own)
      move(content.views[camera].corners, camera);
  for (Mask& mask : content.masks)
    if (mask.camera < cameras.devices())
      mask = movedMask(mask, moved[mask.camera], cameras.size(mask.camera));
  return content;
}

}  // namespace relucent::pipeline
