// SPDX-License-Identifier: MIT
#include "relucent/inverse/window_system.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <utility>

#include "relucent/base/matrix_size.h"

namespace relucent::inverse {
namespace {

/// Pixels told apart on either side of the tile: the camera pixels of a window lie within about as many.
constexpr int farthest = 8;
/// Beyond, areas of 8 x 8 pixels or more.
constexpr int beyondLevel = 3;

float brightness(const NearField::Value& value) {
  return std::abs(value[0] + value[1] + value[2]);
}

bool overlap(const transport::Block& a, const transport::Block& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

transport::Block intersection(const transport::Block& a, const transport::Block& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

}  // namespace

void WindowSystem::gather(const transport::Block& tile, int side, int projector,
                          std::span<const std::uint32_t> rows) {
  tile_ = tile;
  side_ = side;
  projector_ = projector;
  rows_ = static_cast<Eigen::Index>(rows.size());
  gatherLeaves(rows);
  chooseRegions();
  gatherBeyond();
}

void WindowSystem::gatherLeaves(std::span<const std::uint32_t> rows) {
  leaves_.clear();
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t leaf = near_.start[rows[k]]; leaf < near_.start[rows[k] + 1]; ++leaf)
      leaves_.push_back({near_.node[leaf], static_cast<std::uint32_t>(k), near_.value(rows[k], leaf)});
  std::sort(leaves_.begin(), leaves_.end(), [](const Leaf& a, const Leaf& b) {
    return a.node != b.node ? a.node < b.node : a.local < b.local;
  });
  groups_.clear();
  transport::NodeCursor nodeAt(layout_);
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    if (i == 0 || leaves_[i].node != leaves_[i - 1].node) {
      transport::Node place = nodeAt(leaves_[i].node);
      groups_.push_back({leaves_[i].node, place, static_cast<float>(layout_.block(place).count()), i, i});
    }
    groups_.back().end = i + 1;
  }
}

/// The box round all that the window's camera pixels see of a projector, no further than `farthest` from the
/// tile, or from the centre of the light on a projector that is not the tile's.
void WindowSystem::chooseRegions() {
  regions_.clear();
  for (int device = 0; device < static_cast<int>(layout_.projectors().devices()); ++device) {
    transport::Block box{INT_MAX, INT_MAX, 0, 0};
    double x = 0.0, y = 0.0, light = 0.0;
    for (const Group& group : groups_) {
      if (group.place.projector != device) continue;
      transport::Block block = layout_.block(group.place);
      box = {std::min(box.x0, block.x0), std::min(box.y0, block.y0), std::max(box.x1, block.x1),
             std::max(box.y1, block.y1)};
      double sum = 0.0;
      for (std::size_t i = group.begin; i < group.end; ++i)
        sum += static_cast<double>(brightness(leaves_[i].value));
      x += sum * 0.5 * (block.x0 + block.x1);
      y += sum * 0.5 * (block.y0 + block.y1);
      light += sum;
    }
    if (!(light > 0.0)) continue;
    transport::Block centre = tile_;
    if (device != projector_) {
      int left = static_cast<int>(x / light) - side_ / 2, top = static_cast<int>(y / light) - side_ / 2;
      centre = {left, top, left + side_, top + side_};
    }
    box = intersection(
        box, {centre.x0 - farthest, centre.y0 - farthest, centre.x1 + farthest, centre.y1 + farthest});
    if (box.x0 < box.x1 && box.y0 < box.y1) regions_.push_back({device, box});
  }
}

void WindowSystem::gatherBeyond() {
  areaSide_.clear();
  std::vector<std::pair<std::size_t, Eigen::Index>> areas;
  for (Group& group : groups_) {
    transport::Block block = layout_.block(group.place);
    group.beyond = -1;
    if (std::any_of(regions_.begin(), regions_.end(), [&](const Region& region) {
          return region.projector == group.place.projector && overlap(block, region.block);
        }))
      continue;
    transport::Node area = group.place;
    int top = layout_.levels(static_cast<std::size_t>(area.projector)) - 1;
    while (area.level < std::min(beyondLevel, top)) area = layout_.parent(area);
    std::size_t key = layout_.index(area);
    auto found = std::find_if(areas.begin(), areas.end(), [&](const auto& a) { return a.first == key; });
    if (found == areas.end()) {
      found = areas.insert(areas.end(), {key, static_cast<Eigen::Index>(areas.size())});
      areaSide_.push_back(static_cast<float>(1 << area.level));
    }
    group.beyond = found->second;
  }
}

/// T_W over the pixels of a region, from leaves of all levels.
void WindowSystem::expand(const Region& region, std::size_t channel) {
  int width = region.size().width;
  sizeTo(seen_, rows_, static_cast<Eigen::Index>(region.size().count()));
  seen_.setZero();
  for (const Group& group : groups_) {
    if (group.place.projector != region.projector) continue;
    transport::Block block = intersection(region.block, layout_.block(group.place));
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x) {
        float* column = seen_.col((y - region.block.y0) * width + x - region.block.x0).data();
        for (std::size_t i = group.begin; i < group.end; ++i)
          column[leaves_[i].local] += leaves_[i].value[channel] / group.pixels;
      }
  }
}

/// Light v even over n x n pixels is v / n^2 on each: its share of G is that of one column of v / n.
void WindowSystem::expandBeyond(std::size_t channel) {
  sizeTo(beyond_, rows_, static_cast<Eigen::Index>(areaSide_.size()));
  beyond_.setZero();
  for (const Group& group : groups_) {
    if (group.beyond < 0) continue;
    float side = areaSide_[static_cast<std::size_t>(group.beyond)];
    for (std::size_t i = group.begin; i < group.end; ++i)
      beyond_(leaves_[i].local, group.beyond) += leaves_[i].value[channel] / side;
  }
}

void WindowSystem::correlate(std::size_t channel) {
  sizeTo(gram_, rows_, rows_);
  gram_.setZero();
  expandBeyond(channel);
  if (beyond_.cols() > 0) gram_.selfadjointView<Eigen::Lower>().rankUpdate(beyond_);
  sizeTo(columns_, rows_, side_ * side_);
  columns_.setZero();
  for (const Region& region : regions_) {
    expand(region, channel);
    gram_.selfadjointView<Eigen::Lower>().rankUpdate(seen_);
    if (region.projector != projector_) continue;
    transport::Block block = intersection(tile_, region.block);
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x)
        columns_.col((y - tile_.y0) * side_ + x - tile_.x0) =
            seen_.col((y - region.block.y0) * region.size().width + x - region.block.x0);
  }
}

}  // namespace relucent::inverse
