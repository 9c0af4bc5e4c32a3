// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <chrono>

#include "relucent/base/error.h"

namespace relucent::gui {

/// Nobody chose what is shown, or it may not be shown: asking again at once would be of no use.
class NotChosen : public Error {
 public:
  using Error::Error;
};

/// Whoever sat before the dialog said no.
NotChosen castRefused();
/// Nobody answered the dialog. `chosenBefore`: it appeared although there was an earlier choice.
NotChosen castUnanswered(bool chosenBefore);
/// There is no portal, or none that gives pictures.
Error castWithoutPortal();
Error castWithoutWindows();
/// Its reason, in words of D-Bus, or none.
Error castPortalFailed(const QString& reason);
Error castPortalSilent(std::chrono::milliseconds waited);
Error castWithoutPipeWire();
/// Everything was agreed on, and nobody has joined both sides.
Error castSilent(std::chrono::milliseconds waited);
Error castEnded();
Error castUnusable();

}  // namespace relucent::gui
