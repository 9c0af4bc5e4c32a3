// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>
#include <optional>
#include <stdexcept>
#include <variant>

#include "output/installation.h"
#include "output/show_settings.h"

namespace relucent::gui {

/// Invalid arguments.
struct WrongArguments : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Only a text to print: the help or the version.
struct TextToPrint {
  QString text;
};
struct PlayShow {
  ShowSettings settings;
};
/// `arguments`: of the show to start at log-in, with absolute paths.
struct InstallShow {
  Start start;
  QStringList arguments;
  ShowSettings settings;
};
struct UninstallShow {
  Start start;
};

using ShowArguments = std::variant<TextToPrint, PlayShow, InstallShow, UninstallShow>;

/// Parses `relucent ARGUMENTS`; the first one is the program's name.
/// Throws: WrongArguments; as contentOf().
ShowArguments parseShowArguments(const QStringList& arguments);

}  // namespace relucent::gui
