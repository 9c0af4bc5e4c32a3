// SPDX-License-Identifier: MIT
#include "inverse/windows.h"

namespace relucent {

PixelMatrix WindowInverse::matrix() const {
  PixelMatrix matrix;
  matrix.columns = cameras_.count();
  auto pixels = static_cast<std::size_t>(tile_ * tile_);
  for (std::size_t device = 0; device < projectors_.devices(); ++device) {
    Size size = projectors_.size(device);
    Size grid = tiles_.size(device);
    for (std::size_t local = 0; local < size.count(); ++local) {
      Pixel place = pixelAt(size, local);
      std::size_t tile = tiles_.offset(device) + indexOf(grid, {place.x / tile_, place.y / tile_});
      auto inTile = static_cast<std::size_t>((place.y % tile_) * tile_ + place.x % tile_);
      for (std::size_t k = tileStart_[tile]; k < tileStart_[tile + 1]; ++k) {
        matrix.column.push_back(row_[k]);
        const float* unmix = &unmix_[9 * static_cast<std::size_t>(row_[k])];
        for (std::size_t c = 0; c < 3; ++c) {
          float weight = scale_[3 * tile + c] * static_cast<float>(weight_[(3 * k + c) * pixels + inTile]);
          for (std::size_t from = 0; from < 3; ++from) matrix.values.push_back(weight * unmix[3 * c + from]);
        }
      }
      matrix.rowStart.push_back(matrix.column.size());
    }
  }
  return matrix;
}

}  // namespace relucent
