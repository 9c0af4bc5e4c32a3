// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "relucent/calibration/json_fwd.h"
