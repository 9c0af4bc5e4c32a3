// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <vector>

#include "relucent/pipeline/rig_settings.h"

namespace relucent::gui {

/// A screen of the desktop as it is offered for projecting.
struct ScreenChoice {
  pipeline::ScreenRigSettings::Display display;
  Size size;  // its own pixels
  double frameRate = 60.0;
  QString title;         // "Screen 1", "This computer"
  QString facts;         // connector, pixels, rate
  QString refusal{};     // why it cannot be chosen; empty: it can
  QString warning{};     // what choosing it means; empty: nothing out of the ordinary
  bool primary = false;  // the operator's
};

/// All that are there, in the desktop's order. The operator's own is refused unless it is the only one.
std::vector<ScreenChoice> screenChoices();
/// The same for what was measured with a projector of so many pixels: screens of others are refused.
std::vector<ScreenChoice> screenChoicesFor(Size projector);

/// The settings with that screen in place of theirs.
pipeline::ScreenRigSettings withScreen(pipeline::ScreenRigSettings settings, const ScreenChoice& choice);
/// What it means for a measurement that its projector is now seen as another screen, a sentence; empty: it is
/// the same one. Screens that tell no serial number are told from each other by their connectors.
QString meaningOfMove(const pipeline::ScreenRigSettings::Display& measured,
                      const pipeline::ScreenRigSettings::Display& now);

}  // namespace relucent::gui
