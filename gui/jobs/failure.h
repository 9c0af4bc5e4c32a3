// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <exception>

#include "base/error.h"

namespace relucent {

/// A failure for people: what happened and what to do. `details` is for whoever is asked for help.
struct Failure {
  ErrorKind kind = ErrorKind::input;
  QString what;
  QString advice;
  QString details;
  /// A title, where the kind alone would say something else; empty: the kind's.
  QString heading{};
};

/// Of whatever was thrown.
Failure failureOf(std::exception_ptr thrown);

}  // namespace relucent
