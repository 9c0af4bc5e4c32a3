// SPDX-License-Identifier: MIT
#pragma once

#include "fuzz/fuzz_target.h"

namespace relucent::fuzz {

std::vector<FuzzTarget> pictureTargets();
std::vector<FuzzTarget> measurementTargets();
std::vector<FuzzTarget> calibrationTargets();
std::vector<FuzzTarget> wordTargets();
std::vector<FuzzTarget> networkTargets();
/// Of the desktop program: playlists, remote controls. None where Qt's part for them is missing.
std::vector<FuzzTarget> showTargets();

}  // namespace relucent::fuzz
