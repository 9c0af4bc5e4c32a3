// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <exception>

#include "relucent/base/error.h"

namespace relucent::gui {

/// A failure as shown to the user: what happened and what to do. `details` are for support.
struct Failure {
  ErrorKind kind = ErrorKind::input;
  QString what;
  QString advice;
  QString details;
  /// A title that replaces the kind's; empty: the kind's.
  QString heading{};
};

/// The failure that an exception describes.
Failure failureOf(std::exception_ptr thrown);

}  // namespace relucent::gui
