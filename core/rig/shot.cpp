// SPDX-License-Identifier: MIT
#include "rig/shot.h"

#include "base/error.h"
#include "base/fingerprint.h"

namespace relucent {
namespace {

std::string fingerprintOf(const std::vector<Image>& patterns, const std::vector<double>& exposures) {
  Fingerprint fingerprint;
  for (const Image& pattern : patterns)
    fingerprint.add(pattern.width()).add(pattern.height()).add(pattern.data());
  fingerprint.add(exposures);
  return fingerprint.hex();
}

}  // namespace

ShotTaker::ShotTaker(Rig& rig, ShotLog& log, std::string stage)
    : rig_(rig), log_(log), stage_(std::move(stage)) {}

Shot ShotTaker::take(const std::vector<Image>& encodedPatterns, const std::vector<double>& exposures,
                     const Progress& progress) {
  require(encodedPatterns.size() == rig_.projectors.size(), "{} patterns for {} projectors",
          encodedPatterns.size(), rig_.projectors.size());
  require(!exposures.empty(), "a shot needs an exposure");
  progress.checkpoint();

  Shot shot{{stage_, shots()}, fingerprintOf(encodedPatterns, exposures), {}, exposures};
  taken_.push_back({shot.fingerprint, static_cast<int>(exposures.size())});
  if (std::optional<Shot> kept = log_.find(shot.id, shot.fingerprint)) return *std::move(kept);

  for (std::size_t projector = 0; projector < rig_.projectors.size(); ++projector)
    rig_.projectors[projector]->show(encodedPatterns[projector]);
  for (std::size_t exposure = 0; exposure < exposures.size(); ++exposure) {
    std::vector<RawFrame>& frames = shot.frames.emplace_back();
    for (const auto& camera : rig_.cameras) {
      progress.checkpoint();
      frames.push_back(camera->capture({shot.id, static_cast<int>(exposure), exposures[exposure]}));
      checkFrame(frames.back(), camera->size(), camera->name());
    }
  }
  log_.keep(shot);
  return shot;
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

}  // namespace relucent
