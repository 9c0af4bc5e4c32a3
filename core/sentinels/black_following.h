// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/hdr/hdr.h"

namespace relucent::sentinels {

/// Whether two measurements of e differ by more than their noise, on average over all values:
///   (a - b)^2 / (var a + var b) > 1.4.      Shapes: alike.
bool hasChanged(const hdr::BlackLevel& a, const hdr::BlackLevel& b);

/// The mean of two measurements of the same e, weighted by their variances. Of values that are not valid in
/// `other` nothing is taken over.  Shapes: alike.
void join(hdr::BlackLevel& into, const hdr::BlackLevel& other);

}  // namespace relucent::sentinels
