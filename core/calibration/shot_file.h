// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "relucent/rig/shot.h"

namespace relucent::calibration {

/// A shot as a file: a line of JSON and the samples of every frame, compressed without loss. The form is in
/// README.md.
std::string shotFileOf(const rig::Shot& shot);

/// The shot in a file's content, to the last bit; none unless every byte is as it was written.
std::optional<rig::Shot> shotFrom(std::string_view content);

/// Whether it is of an earlier program, which did not compress. Says nothing about the samples.
bool isPlainShotFile(std::string_view content);

}  // namespace relucent::calibration
