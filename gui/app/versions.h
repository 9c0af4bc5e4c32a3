// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "relucent/pipeline/versions.h"

namespace relucent::gui {

/// Core's libraries and those of the desktop program.
std::vector<pipeline::LibraryVersion> allLibraries();

/// The guide's last page: version, licence, the libraries with theirs. Markdown.
QString aboutText();

}  // namespace relucent::gui
