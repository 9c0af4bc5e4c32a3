// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "wizard/session/session.h"

namespace relucent::gui {

/// What a device is called on the pages: the name that people gave it, else its number.
QString projectorLabel(const Session& session, std::size_t projector);
QString cameraLabel(const Session& session, std::size_t camera);

}  // namespace relucent::gui
