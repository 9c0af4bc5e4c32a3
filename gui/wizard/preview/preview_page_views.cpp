// SPDX-License-Identifier: MIT
// What each camera's view asks for, and a viewer who stands somewhere between the cameras.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "relucent/compensation/viewer.h"
#include "wizard/preview/preview_page.h"

namespace relucent::gui {

compensation::ViewSettings PreviewPage::view(std::size_t camera) const {
  return camera < settings_.views.size() ? settings_.views[camera] : compensation::ViewSettings();
}

void PreviewPage::setView(std::size_t camera, const compensation::ViewSettings& view, const QString& what) {
  pipeline::ContentSettings after = settings_;
  after.views.resize(std::max(after.views.size(), camera + 1));
  after.views[camera] = view;
  setSettings(after, what);
}

bool PreviewPage::areCamerasPlaced() const {
  for (std::size_t camera = 0; camera < cameras(); ++camera)
    if (!view(camera).position) return false;
  return true;
}

std::vector<compensation::Position> PreviewPage::cameraPositions() const {
  constexpr double away = 3.0, widest = std::numbers::pi / 4.0;  // metres, to either side
  const auto count = static_cast<double>(cameras());
  std::vector<compensation::Position> positions;
  const bool arePlaced = areCamerasPlaced();
  for (std::size_t camera = 0; camera < cameras(); ++camera) {
    const double angle =
        cameras() == 1 ? 0.0 : widest * (2.0 * static_cast<double>(camera) / (count - 1.0) - 1.0);
    const compensation::Position around{away * std::sin(angle), away * std::cos(angle), 0.0};
    positions.push_back(arePlaced ? view(camera).position.value_or(around) : around);
  }
  return positions;
}

void PreviewPage::placeCamera(std::size_t camera, const compensation::Position& position) {
  if (camera >= cameras() || !compensation::isFinite(position)) return;
  const std::vector<compensation::Position> now = cameraPositions();
  pipeline::ContentSettings after = settings_;
  after.views.resize(std::max(after.views.size(), cameras()));
  for (std::size_t each = 0; each < cameras(); ++each)
    after.views[each].position = each == camera ? position : now[each];
  setSettings(after, tr("Place of a camera"));
}

/// With places for all cameras where there is a viewer, whoever gave them.
pipeline::ContentSettings PreviewPage::placedSettings() const {
  pipeline::ContentSettings placed = settings_;
  if (!viewer()) return placed;
  placed.views.resize(std::max(placed.views.size(), cameras()));
  const std::vector<compensation::Position> positions = cameraPositions();
  for (std::size_t camera = 0; camera < cameras(); ++camera)
    placed.views[camera].position = positions[camera];
  return placed;
}

void PreviewPage::setViewer(const std::optional<compensation::Position>& viewer) {
  if (viewer == settings_.viewer || (viewer && !compensation::isFinite(*viewer)) || cameras() < 2) return;
  pipeline::ContentSettings after = settings_;
  after.viewer = viewer;
  setSettings(after, tr("Place of the viewer"));
}

void PreviewPage::setViewerOnPath(double place) {
  const std::vector<compensation::Position> stops = cameraPositions();
  const double within = std::clamp(place, 0.0, static_cast<double>(stops.size() - 1));
  const auto before = std::min(static_cast<std::size_t>(within), stops.size() - 1);
  const std::size_t after = std::min(before + 1, stops.size() - 1);
  const double share = within - static_cast<double>(before);
  compensation::Position viewer{};
  for (std::size_t axis = 0; axis < viewer.size(); ++axis)
    viewer[axis] = (1.0 - share) * stops[before][axis] + share * stops[after][axis];
  setViewer(viewer);
}

double PreviewPage::viewerOnPath() const {
  const std::optional<compensation::Position> viewer = this->viewer();
  if (!viewer) return 0.0;
  const std::vector<compensation::Position> stops = cameraPositions();
  double best = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    double along = 0.0, length = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = stops[i + 1][axis] - stops[i][axis];
      along += step * ((*viewer)[axis] - stops[i][axis]);
      length += step * step;
    }
    const double share = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
    double apart = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      apart += std::pow((1.0 - share) * stops[i][axis] + share * stops[i + 1][axis] - (*viewer)[axis], 2.0);
    if (apart >= nearest) continue;
    nearest = apart;
    best = static_cast<double>(i) + share;
  }
  return best;
}

std::vector<double> PreviewPage::viewerShares() const {
  const std::optional<compensation::Position> viewer = this->viewer();
  if (!viewer) return {};
  return compensation::viewerWeights(cameraPositions(), *viewer);
}

}  // namespace relucent::gui
