// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "relucent/image/image.h"

namespace relucent::image {

/// Colour maps whose brightness ascends evenly, for people with any colour vision. Errors and differences are
/// shown in cividis, light in viridis.
/// Source: viridis, van der Walt & Smith 2015; cividis, Nunez, Anderton & Renslow 2018; the tables are
/// OpenCV's.
enum class ColourMap { cividis, viridis };

using Rgb8 = std::array<std::uint8_t, 3>;  // sRGB

/// Evenly spaced from 0 to 1.
const std::array<Rgb8, 256>& coloursOf(ColourMap map);

/// The nearest one of them; beyond 0 and 1 that of the end.
Rgb8 colourAt(ColourMap map, double place);

/// One value a pixel, painted: `low` and below take the map's first colour, `high` and above its last;
/// pixels that are NaN are dark. Encoded, three channels.
Image painted(const Image& values, ColourMap map, double low, double high);

}  // namespace relucent::image
