// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "relucent/base/message.h"

namespace relucent::devices {

/// What a program asks of commands before it runs them as devices. Calibrations name commands and come from
/// strangers: a command is run where somebody at this computer has agreed to it, or has named it himself.
struct ConsentSettings {
  std::filesystem::path file;  // of those that were agreed to; empty: nothing is kept
  std::function<bool(const std::string& command)> isNamed{};  // by whoever started the program; none: no
  Message remedy;                                             // how somebody agrees
};

/// From now on, for the whole program; before any device is opened. Whoever never calls it, as tests and
/// programs that use the library with commands of their own, runs every command.
void askForConsent(ConsentSettings settings);
/// Every command is run again. For tests.
void askForNoConsent();

/// $XDG_DATA_HOME/relucent/commands, or the same in .local/share of the home folder; empty where there is
/// neither.
std::filesystem::path usualConsentFile();

/// Whether an argument of a command line is the command, or ends with it behind "=" or ":".
bool isNamedBy(const std::vector<std::string>& arguments, const std::string& command);

/// Those of the commands that requireConsent() refuses, each once.
std::vector<std::string> withoutConsent(const std::vector<std::string>& commands);
/// They may be run from now on, as they are written here; those with a path of their own from this folder
/// only. Throws: Error{disk} if that cannot be kept; they may be run until the program ends.
void giveConsent(const std::vector<std::string>& commands);

/// What is named is kept as well. Throws: Error{usage} with the command.
void requireConsent(const std::string& command);

}  // namespace relucent::devices
