// SPDX-License-Identifier: MIT
#pragma once

#include "acquisition/scheme.h"
#include "sentinels/observer.h"
#include "sentinels/watch.h"

namespace relucent {

/// What a tree is measured with. Referred to, not kept: all of it outlives the tree's measurement.
struct TreeContext {
  Watch& watch;
  const Scheme& scheme;
  AcquisitionObserver& observer;  // is told how far the tree is

  const References& references() const { return watch.references(); }
};

}  // namespace relucent
