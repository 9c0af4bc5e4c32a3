// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include "relucent/venue/changes.h"

namespace relucent::cli {

/// --change KIND:VALUES, may be given several times: what has become of a simulated venue since it was
/// measured, to rehearse what is done about it.
void addChanges(CLI::App* sub, venue::Changes& changes);

}  // namespace relucent::cli
