// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace relucent::tests {

/// What an output shows, in its own pixels, 0xffRRGGBB, line by line. Other readers scale where the desktop
/// does. Source: wlr-screencopy-unstable-v1, which compositors based on wlroots speak.
struct OutputPicture {
  int width = 0, height = 0;  // 0: there is no such output
  std::vector<std::uint32_t> pixels;
};
/// By a connection of its own, to the compositor that WAYLAND_DISPLAY names.
OutputPicture pictureOfOutput(const std::string& name);

}  // namespace relucent::tests
