// SPDX-License-Identifier: MIT
#pragma once

namespace relucent::platform {

/// Columns of the terminal that standard error is written to; 80 of one that does not say; 0: it is none.
int errorTerminalWidth();

}  // namespace relucent::platform
