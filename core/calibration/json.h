// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "calibration/json_fwd.h"
