// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/devices/device_page.h"
#include "wizard/devices/perfecting.h"

namespace relucent::gui {

/// What a page says and does.
struct PerfectingActions {
  std::function<QString()> whyNot;  // why it cannot be started now, a short sentence; empty: it can
  std::function<void()> start;      // in the end Perfecting::start()
};
/// For a page's inspector: whether its picture is corrected by photographs of itself, what the last try came
/// to, and the buttons.
QWidget* perfectingPart(DevicePage& page, Perfecting& perfecting, const PerfectingActions& actions);

}  // namespace relucent::gui
