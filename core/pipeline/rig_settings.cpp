// SPDX-License-Identifier: MIT
#include "relucent/pipeline/rig_settings.h"

#include "relucent/base/error.h"

namespace relucent::pipeline {

RigSettings changedRig(RigSettings rig, const venue::Changes& changes) {
  auto* venue = std::get_if<venue::VenueSettings>(&rig);
  if (venue == nullptr)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("venue.only-simulated-change",
                                 "only a simulated venue can be changed to rehearse with"),
        RELUCENT_ENGLISH_MESSAGE("venue.leave-out-changes", "leave out --change; a real venue is as it is"));
  venue->changes = changes;
  return rig;
}

}  // namespace relucent::pipeline
