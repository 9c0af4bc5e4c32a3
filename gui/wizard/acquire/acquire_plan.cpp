// SPDX-License-Identifier: MIT
// What the page of acquisition knows and decides before it measures: how finely, what that will take, and
// what it will look at.
#include <numeric>
#include <utility>

#include "jobs/free_space.h"
#include "relucent/calibration/results.h"
#include "wizard/acquire/acquire_page.h"

namespace relucent::gui {
namespace {

constexpr double fastThreshold = 0.03, fineThreshold = 0.006;
constexpr int fastVerification = 4;

struct CameraSize {
  Size operator()(const venue::VenueSettings& rig) const { return rig.camera; }
  Size operator()(const pipeline::ImportedRigSettings& rig) const { return rig.camera; }
  Size operator()(const pipeline::ReplayRigSettings&) const { return {}; }
  Size operator()(const auto& rig) const { return rig.camera.value_or(rig.projector); }
};

}  // namespace

Fineness AcquirePage::fineness() const {
  const acquisition::AcquisitionSettings& settings = session_.settings().acquisition;
  if (settings.singleExposure || settings.relativeThreshold >= fastThreshold) return Fineness::fast;
  return settings.relativeThreshold <= fineThreshold ? Fineness::fine : Fineness::usual;
}

void AcquirePage::change(const QString& what, const acquisition::AcquisitionSettings& acquisition) {
  changeUndoably(what, session_.settings().acquisition, acquisition,
                 [this](const acquisition::AcquisitionSettings& wanted) { keep(wanted); });
}

void AcquirePage::keep(const acquisition::AcquisitionSettings& acquisition) {
  if (!whyLocked().isEmpty()) return tellSettings();
  pipeline::CalibrateSettings settings = session_.settings();
  settings.acquisition = acquisition;
  settings.acquisition.seed = session_.settings().acquisition.seed;
  try {
    session_.changeSettings(settings);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
  }
}

acquisition::AcquisitionSettings AcquirePage::settingsOf(Fineness fineness) const {
  if (fineness == this->fineness()) return session_.settings().acquisition;
  acquisition::AcquisitionSettings settings =
      acquisition::settingsOf(acquisition::AcquisitionMode::multiplexed);
  if (fineness == Fineness::fine) settings.relativeThreshold = fineThreshold;
  if (fineness == Fineness::fast) {
    settings.relativeThreshold = fastThreshold;
    settings.verificationPatterns = fastVerification;
  }
  return settings;
}

void AcquirePage::setFineness(Fineness fineness) {
  if (!whyLocked().isEmpty() || fineness == this->fineness()) return tellSettings();
  change(tr("Fineness"), settingsOf(fineness));
}

std::optional<WorkLeft> AcquirePage::expected(const acquisition::AcquisitionSettings& settings) const {
  if (!response_ || response_->exposures.empty()) return std::nullopt;
  const std::vector<double>& exposures = response_->exposures;
  const double mean =
      std::accumulate(exposures.begin(), exposures.end(), 0.0) / static_cast<double>(exposures.size());
  const Rasters projectors = session_.projectorRasters();
  if (projectors.count() == 0) return std::nullopt;
  return acquisition::forecast({camerasUsed(), projectors, exposures.size(), mean}, settings,
                               response_->times, {});
}

Rasters AcquirePage::camerasUsed() const {
  const auto& measured = session_.figures<calibration::Stage::acquisition>();
  if (measured && !measured->cameras.empty()) return Rasters(measured->cameras);
  const Size size = std::visit(CameraSize{}, session_.settings().rig), projector = session_.projectorSize();
  const bool isUnknown = size.empty() || size.count() > projector.count();
  return Rasters(std::vector<Size>(session_.cameras(), isUnknown ? projector : size));
}

std::vector<BlockLevel> AcquirePage::levels() const {
  const Rasters projectors = session_.projectorRasters();
  if (projectors.count() == 0) return {};
  const AcquisitionTrace::Growth growth = isTraceCurrent() ? trace_.growth() : AcquisitionTrace::Growth();
  // Of an earlier session only the sum is on record.
  if (isDone() && growth.levels.empty()) return {};
  std::vector<acquisition::PatternRange> patterns =
      acquisition::levelPatterns(projectors, session_.settings().acquisition, growth.levels);
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
  // What was photographed of finer ones was left out.
  while (isDone() && !levels.empty() && levels.back().block < stoppedAt()) levels.pop_back();
  return levels;
}

std::uint64_t AcquirePage::freeBytes() const {
  return freeBytesAt(QString::fromStdString(session_.path().string()));
}

void AcquirePage::setKeptPhotographs(pipeline::KeptPhotographs kept) {
  if (!whyLocked().isEmpty() || kept == keptPhotographs()) return tellSettings();
  changeUndoably(tr("Photographs to keep"), keptPhotographs(), kept,
                 [this](pipeline::KeptPhotographs wanted) {
                   if (!whyLocked().isEmpty()) return tellSettings();
                   try {
                     session_.keepPhotographs(wanted);
                   } catch (...) {
                     Q_EMIT failed({failureOf(std::current_exception()), tr("Nothing was changed.")});
                   }
                 });
}

bool AcquirePage::isDone() const {
  return !isMeasuring() &&
         session_.progress(calibration::Stage::acquisition) == calibration::StageProgress::done;
}

void AcquirePage::enter() {
  isLookedAt_ = true;
  recall();
}

/// Of the measurement that is used what can be shown of it, without T, which takes long to read.
void AcquirePage::recall() {
  if (isMeasuring() || session_.measurement() == wanted_) return;
  wanted_ = session_.measurement();
  recalled_ = {};
  if (wanted_.empty()) return;
  recalling_.ask([name = wanted_, stored = *session_.result(calibration::Stage::acquisition)]() -> Recalled {
    return {name, calibration::loadFlood(stored), pipeline::loadAcquisitionRecord(stored.folder)};
  });
}

int AcquirePage::floodlightNumber() const {
  if (!session_.isOpen()) return 0;
  if (camera() < recalled_.floodlights.size()) return -recalls_;
  return session_.live().floodlightNumber(camera());
}

image::Image AcquirePage::floodlight() const {
  if (floodlightNumber() > 0) return session_.live().floodlight(camera()).signal;
  return floodlightNumber() < 0 ? recalled_.floodlights[camera()] : image::Image();
}

/// Of a measurement of this session more is known than is on record.
void AcquirePage::recallTrace() {
  const bool isKnown = traced() == traced_ && !trace_.growth().levels.empty();
  if (!isDone() || isKnown || recalled_.measurement.empty() || recalled_.measurement != wanted_) return;
  recalled_.record ? trace_.recall(*recalled_.record) : trace_.clear();
  traced_ = traced();
}

void AcquirePage::setSecondsToLeave(int seconds) {
  if (std::exchange(secondsToLeave_, seconds) == seconds) return;
  Q_EMIT secondsToLeaveChosen(seconds);
  tellSettings();
}

void AcquirePage::setSound(bool sound) {
  if (std::exchange(sound_, sound) == sound) return;
  Q_EMIT soundChosen(sound);
  tellSettings();
}

}  // namespace relucent::gui
