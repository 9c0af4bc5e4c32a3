// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "relucent/venue/surprises.h"

namespace relucent::pipeline {

inline constexpr const char* surprisesName = "surprises.json";

/// Writes what a rehearsal's surprises are and how far they have come into its folder. Throws: Error{disk}.
void saveSurprises(const venue::Surprises& surprises, const std::filesystem::path& folder);

/// nullptr where the folder holds none, or none that can be read: it is practice that is lost, nothing that
/// was measured.
std::shared_ptr<venue::Surprises> loadSurprises(const std::filesystem::path& folder);

}  // namespace relucent::pipeline
