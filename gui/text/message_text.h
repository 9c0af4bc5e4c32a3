// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "relucent/base/message.h"

namespace relucent::gui {

/// A message of core in the user's language: its pattern's translation, in the form that its count asks for,
/// with numbers by the locale and narrow spaces before units. What is in no language, a plain text, stays as
/// it is.
QString text(const Message& message);

/// The same from capital letter to full stop.
QString fullSentence(const Message& message);

}  // namespace relucent::gui
