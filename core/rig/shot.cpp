// SPDX-License-Identifier: MIT
#include "relucent/rig/shot.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/base/fingerprint.h"

namespace relucent::rig {
namespace {

std::string fingerprintOf(const std::vector<image::Image>& patterns, const std::vector<double>& exposures) {
  Fingerprint fingerprint;
  for (const image::Image& pattern : patterns)
    fingerprint.add(pattern.width()).add(pattern.height()).add(pattern.data());
  fingerprint.add(exposures);
  return fingerprint.hex();
}

/// Logs lie in calibrations, which come from strangers: what is in them need not be of these devices.
bool fits(const Shot& shot, std::size_t exposures, const Rig& rig) {
  const auto isOfRig = [&rig](const std::vector<RawFrame>& frames) {
    return std::ranges::equal(frames, rig.cameras, [](const RawFrame& frame, const auto& camera) {
      return frame.signal.size() == camera->size() && frame.signal.channels() == 3;
    });
  };
  return shot.frames.size() == exposures && std::ranges::all_of(shot.frames, isOfRig);
}

}  // namespace

std::uint64_t plainBytes(const Shot& shot) {
  std::uint64_t bytes = 0;
  for (const std::vector<RawFrame>& exposure : shot.frames)
    for (const RawFrame& frame : exposure) {
      const std::uint64_t each = frame.bits < 1 || frame.bits > 16 ? 4 : frame.bits <= 8 ? 1 : 2;
      bytes += each * frame.signal.data().size();
    }
  return bytes;
}

double ShotTimes::shotSeconds() const {
  return shots > 0 ? (showing + keeping + between) / shots : 0.0;
}

double ShotTimes::exposureSeconds(double seconds) const {
  if (exposures == 0) return seconds;
  double mean = asked / exposures, spread = askedSquared - asked * mean;
  double slope = 1.0;
  if (spread > 1e-9 * askedSquared) slope = (askedCapturing - capturing * mean) / spread;
  // Two exposure times that are hardly apart, or a busy machine, must not make a photograph take no time.
  slope = std::clamp(slope, 0.0, 2.0);
  return std::max(0.0, capturing / exposures + slope * (seconds - mean));
}

ShotTaker::ShotTaker(Rig& rig, ShotLog& log, std::string stage, Clock clock)
    : rig_(rig), log_(log), stage_(std::move(stage)), clock_(std::move(clock)) {
  if (!clock_) clock_ = [] { return std::chrono::steady_clock::now().time_since_epoch(); };
}

Shot ShotTaker::take(const std::vector<image::Image>& encodedPatterns, const std::vector<double>& exposures,
                     const Progress& progress) {
  require(encodedPatterns.size() == rig_.projectors.size(), "{} patterns for {} projectors",
          encodedPatterns.size(), rig_.projectors.size());
  require(!exposures.empty(), "a shot needs an exposure");
  progress.checkpoint();

  Shot shot{{stage_, shots()}, fingerprintOf(encodedPatterns, exposures), {}, exposures};
  taken_.push_back({shot.fingerprint, static_cast<int>(exposures.size())});
  if (std::optional<Shot> kept = log_.find(shot.id, shot.fingerprint);
      kept && fits(*kept, exposures.size(), rig_)) {
    lastEnd_.reset();
    return *std::move(kept);
  }

  double begin = now();
  if (lastEnd_) times_.between += begin - *lastEnd_;
  for (std::size_t projector = 0; projector < rig_.projectors.size(); ++projector)
    rig_.projectors[projector]->show(encodedPatterns[projector]);
  double shown = now();
  for (std::size_t exposure = 0; exposure < exposures.size(); ++exposure) {
    std::vector<RawFrame>& frames = shot.frames.emplace_back();
    for (const auto& camera : rig_.cameras) {
      progress.checkpoint();
      double opened = now();
      frames.push_back(camera->capture({shot.id, static_cast<int>(exposure), exposures[exposure]}));
      addExposure(exposures[exposure], now() - opened);
      checkFrame(frames.back(), camera->size(), camera->name());
    }
  }
  double photographed = now();
  log_.keep(shot);
  lastEnd_ = now();
  times_.bytes += log_.bytesOfLast() > 0 ? log_.bytesOfLast() : plainBytes(shot);
  times_.showing += shown - begin;
  times_.keeping += *lastEnd_ - photographed;
  ++times_.shots;
  return shot;
}

void ShotTaker::addExposure(double asked, double took) {
  ++times_.exposures;
  times_.asked += asked;
  times_.askedSquared += asked * asked;
  times_.capturing += took;
  times_.askedCapturing += asked * took;
}

int ShotTaker::exposures() const {
  int sum = 0;
  for (const Taken& taken : taken_) sum += taken.exposures;
  return sum;
}

void ShotTaker::goBackTo(int shot) {
  require(shot >= 0 && shot <= shots(), "no shot {} among {}", shot, shots());
  taken_.resize(static_cast<std::size_t>(shot));
}

void ShotTaker::forgetFrom(int shot) {
  require(shot >= 0 && shot <= shots(), "no shot {} among {}", shot, shots());
  for (int number = shot; number < shots(); ++number)
    log_.forget({stage_, number}, taken_[static_cast<std::size_t>(number)].fingerprint);
}

}  // namespace relucent::rig
