// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/network_projectors.h"
#include "relucent/pjlink/steady_light.h"
#include "relucent/pjlink/switching_on.h"
#include "relucent/rig/rig.h"

namespace relucent::pipeline {

/// What happens to a rig's projectors before they are measured, where they are on the network: nothing
/// otherwise.
class ProjectorWarmUp {
 public:
  ProjectorWarmUp(const NetworkProjectors& projectors, const RigSettings& rig, pjlink::Waiting waiting = {});

  /// Before the devices are opened: a screen may be gone while its projector is in standby.
  /// Throws: as pjlink::switchOn().
  void switchOn(Progress& progress);
  /// Once they are open.  Throws: as pjlink::awaitSteadyLight().
  void awaitSteadyLight(rig::Rig& rig, Progress& progress);

  /// Settings of theirs that spoil a measurement.
  const std::vector<Message>& remarks() const { return remarks_; }

 private:
  WarmUp warmUp_;
  std::vector<pjlink::Named> projectors_;
  pjlink::Waiting waiting_;
  std::vector<Message> remarks_;
};

}  // namespace relucent::pipeline
