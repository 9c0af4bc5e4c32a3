// SPDX-License-Identifier: MIT
#include "relucent/importing/memory.h"

#include "relucent/importing/colour.h"
#include "relucent/importing/decoding.h"
#include "relucent/importing/spread.h"

namespace relucent::importing {
namespace {

// Footprints of a sharp picture have some 12 leaves and a halo of 9; defocused ones up to three times as
// many.
constexpr std::uint64_t leavesOfRow = 40;
constexpr std::uint64_t bytesOfLeaf = 22;

}  // namespace

ImportMemory importMemory(Size projector, Size camera, int pictures) {
  const std::uint64_t nodes = projector.count() * 4 / 3, pixels = camera.count();
  const auto many = static_cast<std::uint64_t>(pictures);
  const std::uint64_t sequences = 3 * sizeof(std::uint16_t) * many * (projector.count() + pixels);
  const std::uint64_t pyramid = 3 * sizeof(float) * many * nodes, norms = 3 * sizeof(float) * nodes;
  const std::uint64_t rows = bytesOfLeaf * leavesOfRow * pixels;
  // One to one, with neighbours' mix, and of the footprint.
  const std::uint64_t colours = 3 * sizeof(PixelColour) * pixels;
  // Decoded, and again while neighbours are asked; footprints; black, flood, variances and masks.
  constexpr std::uint64_t maps = 6 * 3 * sizeof(float) + 16;
  const std::uint64_t places = (2 * sizeof(Decoded) + sizeof(Footprint) + maps) * pixels;
  const std::uint64_t mapped = sequences + pyramid + rows + colours;
  return {mapped + norms + places, mapped};
}

}  // namespace relucent::importing
