// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/linearization/linearization.h"

namespace relucent::mapping {

/// A projector's response as a colour table of `side`^3 entries: the light that is wanted, in sRGB's
/// encoding, which puts most entries where eyes see most, to the drive that emits it. The text of a .cube
/// file, red changing fastest. Contract: side >= 2.  Source: Adobe, Cube LUT Specification 1.0.
std::string cubeLut(const linearization::ProjectorResponse& response, const std::string& title,
                    int side = 33);

}  // namespace relucent::mapping
