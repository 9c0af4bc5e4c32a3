// SPDX-License-Identifier: MIT
// What the page of acquisition knows before it measures: what it will take, and what it will look at.
#include <QStorageInfo>
#include <algorithm>
#include <numeric>

#include "transport/node_layout.h"
#include "wizard/acquire_page.h"

namespace relucent {
namespace {

// Share of the samples that may be brighter than white in a picture of the floodlight image: gloss, lamps.
constexpr double brighterThanWhite = 0.01;

/// Linear, 1 at nearly the brightest.
Image brightened(Image linear) {
  std::vector<float> sorted = linear.data();
  if (sorted.empty()) return linear;
  auto place = sorted.begin() + static_cast<std::ptrdiff_t>((1.0 - brighterThanWhite) *
                                                            static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), place, sorted.end());
  if (!(*place > 0.0f)) return linear;
  for (float& value : linear.data()) value /= *place;
  return linear;
}

}  // namespace

std::optional<WorkLeft> AcquirePage::expected(const AcquisitionSettings& settings) const {
  if (!response_ || response_->exposures.empty()) return std::nullopt;
  const std::vector<double>& exposures = response_->exposures;
  const double mean =
      std::accumulate(exposures.begin(), exposures.end(), 0.0) / static_cast<double>(exposures.size());
  const Size projector = session_.projectorSize();
  if (projector.empty()) return std::nullopt;
  // Photographs are counted, not their pixels.
  return relucent::forecast(Rasters(projector), Rasters(projector), exposures.size(), mean, settings,
                            response_->times, {});
}

std::vector<BlockLevel> AcquirePage::levels() const {
  if (session_.projectorSize().empty()) return {};
  std::vector<Size> sizes;
  for (std::size_t i = 0; i < session_.projectors(); ++i) sizes.push_back(session_.projectorSize(i));
  const Rasters projectors(sizes);
  const AcquisitionTrace::Growth growth = trace_.growth();
  // Of an earlier session only the sum is on record.
  if (isDone() && growth.levels.empty()) return {};
  const AcquisitionSettings& settings = session_.settings().acquisition;
  std::vector<PatternRange> patterns = levelPatterns(projectors, lightCount(settings), growth.levels,
                                                     colourFactor(settings.relativeThreshold));
  std::vector<BlockLevel> levels;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    BlockLevel level{1 << (patterns.size() - 1 - i), patterns[i]};
    level.isKnown = i < growth.levels.size();
    if (i + 1 < growth.levels.size()) level.through = growth.levels[i];
    if (i + 1 == growth.levels.size()) level.through = growth.through;
    levels.push_back(level);
  }
  // What it ended before needed none.
  while (isDone() && !levels.empty() && !levels.back().isKnown) levels.pop_back();
  return levels;
}

std::uint64_t AcquirePage::freeBytes() const {
  const QString folder = QString::fromStdString(session_.path().string());
  return static_cast<std::uint64_t>(std::max<qint64>(0, QStorageInfo(folder).bytesAvailable()));
}

bool AcquirePage::isDone() const {
  return !isMeasuring() && session_.progress(Step::acquisition) == StepProgress::done;
}

void AcquirePage::enter() {
  if (isDone() && floodlightNumber() == 0) session_.wantAcquisition();
}

int AcquirePage::floodlightNumber() const {
  if (!session_.isOpen()) return 0;
  if (int number = session_.live().floodlightNumber(camera())) return number;
  return session_.acquisition() ? -1 : 0;
}

Image AcquirePage::floodlight() const {
  if (floodlightNumber() > 0) return brightened(session_.live().floodlight(camera()).signal);
  auto measured = session_.acquisition();
  if (!measured) return {};
  const Rasters& cameras = measured->transport.cameras();
  if (camera() >= cameras.devices()) return {};
  Image linear(cameras.size(camera()), 3);
  const auto first = measured->flood.begin() + static_cast<std::ptrdiff_t>(3 * cameras.offset(camera()));
  std::copy_n(first, linear.data().size(), linear.data().begin());
  return brightened(std::move(linear));
}

void AcquirePage::setSecondsToLeave(int seconds) {
  if (std::exchange(secondsToLeave_, seconds) == seconds) return;
  Q_EMIT secondsToLeaveChosen(seconds);
  Q_EMIT changed();
}

void AcquirePage::setSound(bool sound) {
  if (std::exchange(sound_, sound) == sound) return;
  Q_EMIT soundChosen(sound);
  Q_EMIT changed();
}

}  // namespace relucent
