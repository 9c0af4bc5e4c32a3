// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/engine/backend.h"

namespace relucent::engine {

/// Whether two back ends make the same picture of noise with one step, but for at most one value in a
/// thousand that is more than three codes of 8 bits apart: those of this program are within one, or two where
/// projectors of different colours meet, and a driver at fault is wrong nearly everywhere. Both have
/// `content`, and what was projected last is then that picture. False, too, if either is lost.
bool agree(EngineBackend& a, EngineBackend& b, const EngineVenue& engine, const EngineContent& content);

}  // namespace relucent::engine
