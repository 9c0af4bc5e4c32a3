// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/acquisition/test_photographs.h"
#include "relucent/acquisition/venue_change.h"
#include "relucent/photography/references.h"
#include "relucent/transport/acquisition.h"

namespace relucent::acquisition {

/// What a T becomes by what is seen of black, full light and test patterns, without measuring a row.
struct FittedTransport {
  transport::TransportMatrix transport;
  CameraMask unknown;   // camera pixels that see what no camera saw before
  CameraMask ofItsOwn;  // whose light has become another than that of all
};

/// In this order: rows of a camera that looks elsewhere, or for which the projected picture has moved, are
/// interpolated between the former ones (moved_rows.h); T_ij is multiplied value by value by what every
/// projector's channels have become, R = median over rows (flood now / flood then), and the rows that differ
/// from that by what they alone have become; of these near and far light each by itself (near_far_fit.h).
/// `change` is told what moved, what became of the light, and the share of rows that became others.
FittedTransport fittedTransport(const transport::Acquisition& former,
                                const photography::References& references, const TestPhotographs& tests,
                                VenueChange& change, Progress& progress);

}  // namespace relucent::acquisition
