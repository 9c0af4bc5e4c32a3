// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// What stands above every page while work waits for a device; none: no work does. The camera is connected
/// again by itself (jobs/patient_camera.h), as the screen is. `instead`: ends the wait with what there is.
std::optional<Banner> lostDeviceBanner(const Session& session, PageCommand* instead);
/// The same in the rail. Contract: Session::isDeviceLost().
QString lostDeviceText(const Session& session);

}  // namespace relucent::gui
