// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/acquisition/settings.h"
#include "relucent/linearization/linearization.h"
#include "relucent/sentinels/observer.h"
#include "relucent/transport/acquisition.h"

namespace relucent::acquisition {

/// What the light transport is measured with. Referred to, not kept: all of it outlives the measurement.
struct AcquisitionRun {
  rig::ShotTaker& shots;
  const linearization::Linearization& linearization;
  const AcquisitionSettings& settings;
  /// Asked what to do about an alarm. Empty, and nobody is there: an alarm is Error{device}, and running the
  /// acquisition again goes on from what is safe.
  sentinels::AlarmHandler handler{};
  sentinels::AcquisitionObserver* observer = nullptr;  // is told of it; null: nobody
};

/// Measures the light transport by the scheme of the settings.  Source: core/acquisition/README.md; the tree
/// is Sen et al. 2005's, thresholds, scheduling and unmixing of the adaptive scheme are ours. While it
/// measures, sentinels watch the light and the view. After an alarm that was retried, the result is the same
/// bits as if it had not happened. Stop and keep: ends after the level under way with a valid, coarser T.
/// Throws: Error{device, input, disk}; Cancelled.
transport::Acquisition acquire(const AcquisitionRun& run, Progress& progress);

}  // namespace relucent::acquisition
