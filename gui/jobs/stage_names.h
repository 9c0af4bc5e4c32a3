// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <span>
#include <string_view>

namespace relucent {

/// What core is doing, in the user's language. Core names its stages in English; those with a "{}" hold a
/// name or a number there. What the table does not know is returned as it is: pages name their own stages.
QString stageText(std::string_view stage);

/// The stages of core that the table knows.
std::span<const char* const> knownStages();

}  // namespace relucent
