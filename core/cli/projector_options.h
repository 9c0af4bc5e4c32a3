// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "relucent/cli/arguments.h"

namespace relucent::cli {

/// --pjlink, --pjlink-password-file and --warm-up.
void addNetworkOptions(CLI::App* sub, const std::shared_ptr<NetworkOptions>& options);

}  // namespace relucent::cli
