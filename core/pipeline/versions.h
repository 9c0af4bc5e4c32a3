// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace relucent::pipeline {

/// A library that Relucent is made with.
struct LibraryVersion {
  std::string name;  // as resources/licences.md has it
  std::string version;
};

/// Of Relucent: "0.1.0". One place says it: project() in CMakeLists.txt.
std::string relucentVersion();

/// Core's libraries. Of those that tell it the version that runs, else the one it was built with.
std::vector<LibraryVersion> coreLibraries();

/// What `--version` prints: "PROGRAM 0.1.0", then a library a line.
std::string versionText(const std::string& program, const std::vector<LibraryVersion>& libraries);

}  // namespace relucent::pipeline
