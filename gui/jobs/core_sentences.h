// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <span>
#include <string>

namespace relucent {

/// What core says of a failure, a finding or a camera, in the user's language, and what it filled in as far
/// as that is core's too; quantities in it are the locale's. Sentences that core joins ("what; advice",
/// "device: what", "what (advice)") are known by their parts. What the table does not know is returned as it
/// is.
QString coreSentence(const std::string& english);

/// The same from capital letter to full stop.
QString fullSentence(const std::string& english);

/// The sentences of core that the table knows, "{}" where something is filled in.
std::span<const char* const> knownCoreSentences();

}  // namespace relucent
