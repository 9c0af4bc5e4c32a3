// SPDX-License-Identifier: MIT
#include "relucent/calibration/patient_shot_log.h"

namespace relucent::calibration {

void PatientShotLog::keep(const rig::Shot& shot) {
  // Every shot begins by showing its patterns on all projectors: nothing has to be put back.
  const auto darken = [this] {
    for (const auto& projector : rig_.projectors) projector->show(image::Image(projector->size(), 3, 0.0f));
  };
  const auto needed = [](std::uint64_t bytesOfShot) { return spare + shotsAhead * bytesOfShot; };
  room_.write(needed(rig::plainBytes(shot)), [&] { log_.keep(shot); }, darken);
  const std::uint64_t next = needed(log_.bytesOfLast());
  room_.waitFor(next, 2 * next, darken);
}

}  // namespace relucent::calibration
