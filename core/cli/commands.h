// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/cli/arguments.h"
#include "relucent/pipeline/json.h"

namespace relucent::cli {

/// What a command found: the document for programs and the text for people.
struct CommandResult {
  calibration::Json document;
  std::string text;
  int status = 0;  // of the program
};

/// Does what the command line asks for.
/// Throws: Error, Cancelled as the pipeline does; Error{input} for settings that cannot be.
/// `room`: who waits where the disk is full and the command says so; null: nobody.
CommandResult execute(const Command& command, Progress& progress, calibration::RoomWaiter* room = nullptr);

/// The whole program: parses, executes, prints. Returns the exit status, see the README.
int runCommandLine(const std::vector<std::string>& arguments);

}  // namespace relucent::cli
