// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// The texts of the .comp files beside this one, which the build compiles into the library.
namespace relucent::engine::shaders {

extern const std::string_view common, place, windows, means, gather, group_forward, group_light,
    group_backward, forward, backward, sum_nodes, spread, brightness, show_placed, encode, copy;

}  // namespace relucent::engine::shaders
