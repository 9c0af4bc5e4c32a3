// SPDX-License-Identifier: MIT
#pragma once

#include "all.h"
