// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>
#include <optional>
#include <stdexcept>
#include <variant>

#include "output/installation.h"
#include "output/show_settings.h"

namespace relucent {

/// Arguments that mean nothing.
struct WrongArguments : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// To be written, and nothing else done: the help, or the version.
struct PrintText {
  QString text;
};
struct PlayShow {
  ShowSettings settings;
};
/// `arguments`: of the show that is to start by itself, with paths from the root.
struct InstallShow {
  Start start;
  QStringList arguments;
  ShowSettings settings;
};
struct UninstallShow {
  Start start;
};

using ShowArguments = std::variant<PrintText, PlayShow, InstallShow, UninstallShow>;

/// What `relucent ARGUMENTS` asks for; the first one is the program's name.
/// Throws: WrongArguments; as contentOf().
ShowArguments parseShowArguments(const QStringList& arguments);

}  // namespace relucent
