// SPDX-License-Identifier: MIT
#include "relucent/engine/availability.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::engine {
namespace {

constexpr double fadeSeconds = 0.05;  // to a part of 1 / e: nineteen twentieths in 0.15 s
constexpr float asGoodAsThere = 1.0f / 512.0f;

}  // namespace

bool Availability::isComplete() const {
  return std::ranges::all_of(projectors, [](const Grid& grid) {
    return std::ranges::all_of(grid.share, [](float share) { return share >= 1.0f; });
  });
}

Availability::Grid completeGrid(Size projector, int side) {
  const Size cells{(projector.width + side - 1) / side, (projector.height + side - 1) / side};
  return {side, cells, std::vector<float>(cells.count(), 1.0f)};
}

std::vector<float> sharesOfPixels(const Availability::Grid& grid, Size projector) {
  std::vector<float> shares(projector.count());
  const auto placeOf = [&](int pixel, int cells) {
    const float at = (static_cast<float>(pixel) + 0.5f) / static_cast<float>(grid.side) - 0.5f;
    const float held = std::clamp(at, 0.0f, static_cast<float>(cells - 1));
    const int first = std::min(static_cast<int>(held), std::max(0, cells - 2));
    return std::pair(first, held - static_cast<float>(first));
  };
  parallelFor(0, static_cast<std::size_t>(projector.height), 16, [&](std::size_t line) {
    const int y = static_cast<int>(line);
    const auto [row, down] = placeOf(y, grid.cells.height);
    const int below = std::min(row + 1, grid.cells.height - 1);
    for (int x = 0; x < projector.width; ++x) {
      const auto [column, right] = placeOf(x, grid.cells.width);
      const int beside = std::min(column + 1, grid.cells.width - 1);
      const auto at = [&](int u, int v) { return grid.share[indexOf(grid.cells, {u, v})]; };
      // Of equal ones the same, not nearly.
      const float upper = at(column, row) + right * (at(beside, row) - at(column, row));
      const float lower = at(column, below) + right * (at(beside, below) - at(column, below));
      shares[indexOf(projector, {x, y})] = std::clamp(upper + down * (lower - upper), 0.0f, 1.0f);
    }
  });
  return shares;
}

void AvailabilityFollower::aim(const Availability& wanted, const EngineContent& content) {
  const Rasters& projectors = engine_.venue.transport.projectors();
  require(wanted.projectors.size() == projectors.devices(), "light of {} projectors, of {}",
          wanted.projectors.size(), projectors.devices());
  wanted_.clear();
  missing_.clear();
  settled_ = false;
  if (wanted.isComplete()) {
    findMissing(content);
    return;
  }
  for (std::size_t j = 0; j < projectors.devices(); ++j) {
    const std::vector<float> shares = sharesOfPixels(wanted.projectors[j], projectors.size(j));
    wanted_.insert(wanted_.end(), shares.begin(), shares.end());
  }
  for (std::size_t j = 0; j < content.kept.size(); ++j) wanted_[j] *= content.kept[j];
  findMissing(content);
}

void AvailabilityFollower::findMissing(const EngineContent& content) {
  freeVersion_ = content.freeVersion;
  const std::vector<float>& towards = wanted_.empty() ? content.kept : wanted_;
  missing_ = towards.empty() ? CameraStack() : missingLight(engine_, content.free, towards);
}

bool AvailabilityFollower::advance(std::chrono::duration<double> elapsed, EngineContent& content) {
  if (freeVersion_ != content.freeVersion) {
    findMissing(content);
    settled_ = false;
  }
  if (settled_) return false;
  const std::size_t pixels = content.free.size(), values = 3 * content.weight.size();
  const std::vector<float>& wanted = wanted_.empty() ? content.kept : wanted_;
  if (content.available.empty()) {
    content.available.assign(pixels, 1.0f);
    content.missing = CameraStack(values, 0.0f);
  }
  const auto left = static_cast<float>(std::exp(-elapsed.count() / fadeSeconds));
  const auto farthest = [&](std::size_t begin, std::size_t end) {
    float most = 0.0f;
    for (std::size_t j = begin; j < end; ++j)
      most = std::max(most, std::abs(content.available[j] - (wanted.empty() ? 1.0f : wanted[j])));
    return most;
  };
  std::array<float, fixedParts> apart{};
  parallelChunks(0, pixels, fixedParts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    apart[part] = farthest(begin, end);
  });
  settled_ = left * std::ranges::max(apart) < asGoodAsThere;
  if (settled_) {
    content.available = wanted;
    content.missing = missing_;
    return true;
  }
  parallelFor(0, pixels, 16384, [&](std::size_t j) {
    const float there = wanted.empty() ? 1.0f : wanted[j];
    content.available[j] = there + left * (content.available[j] - there);
  });
  parallelFor(0, values, 16384, [&](std::size_t i) {
    const float there = missing_.empty() ? 0.0f : missing_[i];
    content.missing[i] = there + left * (content.missing[i] - there);
  });
  return true;
}

}  // namespace relucent::engine
