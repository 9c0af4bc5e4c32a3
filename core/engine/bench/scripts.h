// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// The texts of the .py files beside this one, which the build compiles into the library.
namespace relucent::engine::scripts {

extern const std::string_view scipy_products;

}  // namespace relucent::engine::scripts
