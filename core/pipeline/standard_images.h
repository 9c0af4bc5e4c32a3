// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/image/image.h"

namespace relucent::pipeline {

/// Content with a name, linear RGB in [0, 1].
struct NamedImage {
  std::string name;
  image::Image linear;
};

/// The three pictures that every method is judged on when no others are given, drawn and not photographed,
/// so that they are free of rights and the same everywhere:
///   natural  dead leaves, whose edges and scales are distributed as in photographs
///   text     lettering and line gratings from coarse to fine, dark on light and light on dark
///   colours  saturated hues, their gradients and their borders
/// Source: Lee, Mumford & Huang, "Occlusion models for natural images", IJCV 2001.
std::vector<NamedImage> standardImages(Size size = {480, 360});

}  // namespace relucent::pipeline
