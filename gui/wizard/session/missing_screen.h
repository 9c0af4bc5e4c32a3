// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "wizard/session/session.h"

namespace relucent::gui {

/// The connector of the first projector whose screen is not there, whether or not anybody waits for it;
/// empty: all are.
QString missingScreen(const Session& session);

}  // namespace relucent::gui
