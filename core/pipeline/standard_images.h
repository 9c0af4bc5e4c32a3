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

/// The pictures that every method is judged on when no others are given, drawn and not photographed, so that
/// they are free of rights and the same everywhere:
///   natural   dead leaves, whose edges and scales are distributed as in photographs
///   text      lettering and line gratings from coarse to fine, dark on light and light on dark
///   colours   saturated hues, their gradients and their borders
///   line-art  thin dark strokes, hatching and circles on white paper
///   film      a wide frame between black bars: dim surroundings, soft gradients, one bright face
///   dark      night: nearly everything below a hundredth of white, and a few lamps
/// Source: Lee, Mumford & Huang, "Occlusion models for natural images", IJCV 2001.
std::vector<NamedImage> judgedImages(Size size);
/// The first three of them: what light transport and its inverse are compared by, where each picture costs.
std::vector<NamedImage> standardImages(Size size);

/// The same of 480 x 360 pixels. Drawn once, which takes a second. Safe to call from any thread.
const std::vector<NamedImage>& judgedImages();
const std::vector<NamedImage>& standardImages();

}  // namespace relucent::pipeline
