// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace relucent::rig {

/// Of cameras by whatever tells devices apart: texts for people to read, equal ones for one device.
/// Throws: Error{input} if two are one.
void requireDistinctCameras(const std::vector<std::string>& devices);

}  // namespace relucent::rig
