// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/acquisition/scheme.h"
#include "relucent/sentinels/observer.h"
#include "relucent/sentinels/watch.h"

namespace relucent::acquisition {

/// What a tree is measured with. Referred to, not kept: all of it outlives the tree's measurement.
struct TreeContext {
  sentinels::Watch& watch;
  const Scheme& scheme;
  sentinels::AcquisitionObserver& observer;  // is told how far the tree is

  const photography::References& references() const { return watch.references(); }
};

}  // namespace relucent::acquisition
