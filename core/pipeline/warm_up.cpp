// SPDX-License-Identifier: MIT
#include "relucent/pipeline/warm_up.h"

#include <utility>

namespace relucent::pipeline {

ProjectorWarmUp::ProjectorWarmUp(const NetworkProjectors& projectors, const RigSettings& rig,
                                 pjlink::Waiting waiting)
    : warmUp_(projectors.addresses.empty() ? WarmUp::none : projectors.warmUp), waiting_(std::move(waiting)) {
  const std::vector<std::string> labels = projectorLabels(rig);
  for (auto& [projector, address] : projectors.addresses)
    projectors_.push_back(
        {projector < labels.size() ? labels[projector] : std::to_string(projector + 1), address});
}

void ProjectorWarmUp::switchOn(Progress& progress) {
  if (warmUp_ == WarmUp::none) return;
  Progress switching =
      progress.part(0.1, RELUCENT_MESSAGE("stage.switching-projectors-on", "Switching the projectors on"));
  remarks_ = pjlink::switchOn(projectors_, {}, waiting_, switching);
}

void ProjectorWarmUp::awaitSteadyLight(rig::Rig& rig, Progress& progress) {
  if (warmUp_ != WarmUp::steady) return;
  Progress awaiting = progress.part(
      0.5, RELUCENT_MESSAGE("stage.awaiting-steady-light", "Waiting until the lamps are steady"));
  pjlink::awaitSteadyLight(rig, {}, waiting_, awaiting);
}

}  // namespace relucent::pipeline
