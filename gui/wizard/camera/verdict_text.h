// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "devices/check_verdict.h"

namespace relucent {

/// What was found about projector and camera, and what to do, in the user's language. In English the same as
/// core's sentence().
QString verdictText(const CheckVerdict& verdict);

}  // namespace relucent
