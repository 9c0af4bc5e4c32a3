// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "pipeline/versions.h"

namespace relucent {

/// Core's libraries and those of the desktop program.
std::vector<LibraryVersion> allLibraries();

/// The guide's last page: version, licence, the libraries with theirs. Markdown.
QString aboutText();

}  // namespace relucent
