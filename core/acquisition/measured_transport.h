// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/photography/references.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::acquisition {

/// The images under full light, less e, all projectors and their channels summed.
struct Floods {
  CameraStack light, variance;
};

/// As the references show them.
Floods floodsOf(const photography::References& references);

/// T before it is verified.
struct MeasuredTransport {
  transport::TransportMatrix transport;
  CameraStack leafVariance;  // see Acquisition
  Floods floods;             // where more than the references' photographs tells of them; else empty
  CameraMask unknown;        // per camera pixel: some light was too bright for every exposure
  bool isStopped = false;    // dense patterns ended before they were as fine as asked for
};

}  // namespace relucent::acquisition
