// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace relucent {

/// Text as a terminal may get it: it can hold names out of strangers' files, and terminals obey control
/// characters. Those of ASCII and Unicode (C0 but tabs and line feeds, DEL, C1) and bytes that are no UTF-8
/// become "\xNN", byte by byte.
std::string forTerminal(std::string_view text);
/// The same for a line of a log, in which line feeds would begin another one.
std::string forLogLine(std::string_view text);

}  // namespace relucent
