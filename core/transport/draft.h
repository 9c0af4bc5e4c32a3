// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/transport/acquisition.h"

namespace relucent::transport {

/// A venue while it is being measured, looked at less closely so that it can be compensated in a second.
struct Draft {
  Acquisition acquisition;  // of few pixels; findings and what it cost are left out
  int level = 0;            // the finest blocks that were shown are 2^level projector pixels wide
  int coarsening = 0;  // 2^coarsening pixels of cameras and projectors, each way, are one in `acquisition`
  /// Relative error of patterns that were predicted before they were used, beyond their noise; 0: not known.
  double error = 0.0;
  double aim = 0.0;  // the one that is asked for
};

}  // namespace relucent::transport
