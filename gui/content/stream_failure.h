// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/error.h"

namespace relucent::gui {

/// What a code of FFmpeg's libraries means for whoever looks after a stream.
Error streamFailure(int code);

/// It came, and cannot be shown.
Error streamUnusable();

/// Nothing came for as long as was waited.
Error streamSilent(double seconds, bool hasPlayed);

Error streamHostUnknown();

/// This program listens at its address, and goes on doing so.
Error streamOpenAlready();

}  // namespace relucent::gui
