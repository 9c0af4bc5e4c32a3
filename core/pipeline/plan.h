// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/base/progress.h"
#include "relucent/importing/pattern_plan.h"
#include "relucent/pipeline/written_files.h"

namespace relucent::pipeline {

/// Writes the patterns of planPatterns() as numbered PNG files for cameras that nothing connects to the
/// projector, with plan.json (what each is) and instructions.txt (how to photograph them). The folder can be
/// given to importPictures() as it is.
/// Throws: Error{input} if `out` holds pictures already; Error{disk}; Cancelled.
WrittenFiles exportPlan(const importing::PatternPlanSettings& settings, const std::filesystem::path& out,
                        Progress& progress);

}  // namespace relucent::pipeline
