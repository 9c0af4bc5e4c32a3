// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "relucent/pjlink/projector.h"
#include "relucent/pjlink/waiting.h"

namespace relucent::pjlink {

/// A projector and what people call it.
struct Named {
  std::string label;
  Address address;
};

struct SwitchingOnSettings {
  std::chrono::seconds longest{300};  // until all are on, one that has to cool down before included
  std::chrono::milliseconds interval{2000};
  int mostMisses = 3;  // looks in a row without an answer: a network in standby needs some
  Patience patience{};
};

/// Switches projectors on and returns when each says that it is on and no longer warming up, with its shutter
/// open.  Returns sentences about settings of theirs that spoil a measurement.
/// Throws: Error{device} if one does not answer, or is not on in time, whatever it said; Cancelled.
std::vector<Message> switchOn(const std::vector<Named>& projectors, const SwitchingOnSettings& settings,
                              const Waiting& waiting, Progress& progress);

}  // namespace relucent::pjlink
